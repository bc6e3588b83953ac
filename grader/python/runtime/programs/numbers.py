import itertools

nan, inf = float("nan"), float("inf")
big = 2**53

# min and max of two: the first of equals, and whatever a NaN is beside
some = [0, 1, -1, True, 0.0, -0.0, 1.0, 2.5, -2.5, inf, -inf, nan, big, big + 1, float(big), -big - 1, 10**30, 1e30]
for a, b in itertools.product(some, repeat=2):
    print(a, b, repr(min(a, b)), repr(max(a, b)), a < b, a <= b, a == b, a != b, a > b, a >= b)
print(min(3, 1, 2), max([1, 5, 2]), min(2, 1, key=lambda x: -x), max([], default=7))
for wrong in [lambda: min(1), lambda: max(), lambda: min(1, "a"), lambda: max(1, 2, default=3)]:
    try:
        wrong()
    except (TypeError, ValueError) as error:
        print(type(error).__name__)

# in a loop, so that the interpreter looks for shorter ways
for a, b in [(1.0, 4.0), (1, 4.0), (1.0, 4), (-0.0, 3.0), (inf, 2.0), (1e308, 1e-308), (5, 2)]:
    last = None
    for _ in range(100):
        last = a / b
    print(repr(last))
for zero in [0.0, -0.0, 0]:
    for _ in range(100):
        try:
            1.5 / zero
        except ZeroDivisionError:
            pass
    print("divided by", zero)


class Metres(float):
    def __truediv__(self, other):
        return "metres"

    def __lt__(self, other):
        return True


print(Metres(3) / 2.0, Metres(3) < 1.0, min(1.0, Metres(3)), max(Metres(3), 1.0), 3.0 / Metres(2))
