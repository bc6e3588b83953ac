# what programs in Python do beside numbers
import math, operator, itertools
from collections import defaultdict, deque
print([x * x for x in range(5) if x % 2], {k: v for k, v in zip("abc", range(3))}, {n % 3 for n in range(9)})
print(f"{3.14159:8.3f}|{7:>5}|{-1e-7:.3g}|{'ab':^6}|{1234567.891:,.1f}|{0.25:%}|{255:#x}|{3!r:>4}")
print("%.3f %5d %s %r" % (2.5, 42, "x", "y"), "{:+.2e} {n}".format(12345.678, n=1))
a, *rest, b = range(6)
print(a, rest, b, (n := 10) + n, 7 // -2, -7 % 3, divmod(-7, 2), 2 ** 100, round(2.5), round(2.675, 2), int(-3.7))
print(sorted([3, 1, 2], reverse=True), max([1, 5, 3], key=lambda x: -x), min("b", "a"), any([]), all([]))


class Angle:
    def __init__(self, x): self.x = x
    def __add__(self, o): return Angle(self.x + o.x)
    def __eq__(self, o): return self.x == o.x
    def __lt__(self, o): return self.x < o.x
    def __repr__(self): return f"Angle({self.x})"
    @property
    def deg(self): return math.degrees(self.x)
    @classmethod
    def zero(cls): return cls(0.0)
    @staticmethod
    def wrap(x): return math.atan2(math.sin(x), math.cos(x))


print(Angle(1) + Angle(2), Angle(math.pi).deg, Angle.zero(), Angle.wrap(4.0), sorted([Angle(2), Angle(1)]))


def steps(n):
    try:
        for i in range(n):
            got = yield i
            if got: print("got", got)
    finally:
        print("closed")


g = steps(3)
print(next(g), g.send("x"), next(g), next(g, "end"))


class Context:
    def __enter__(self): print("in"); return 1
    def __exit__(self, kind, error, trace): print("out", kind and kind.__name__); return True


with Context() as c:
    print(c)
    raise ValueError("lost")


def match(command):
    match command:
        case [x, y]: return f"two {x} {y}"
        case {"go": where}: return f"go {where}"
        case int() | float() as n if n > 0: return f"positive {n}"
        case str(): return "text"
        case _: return "else"


print(match([1, 2]), match({"go": 3}), match(2.5), match("s"), match(None))
try:
    try:
        {}["x"]
    except KeyError as e:
        raise RuntimeError("again") from e
except RuntimeError as e:
    print(e, repr(e.__cause__))
else:
    print("no")
finally:
    print("finally")
d = defaultdict(list); d["a"].append(1); print(dict(d))
q = deque([1, 2, 3], maxlen=3); q.append(4); q.rotate(1); print(q, q[0], list(reversed(q)))
print(list(itertools.accumulate([1, 2, 3])), list(itertools.pairwise("abc")), list(itertools.product([0, 1], repeat=2))[-1], operator.itemgetter(1)([5, 6]))


def counter():
    n = 0
    def step():
        nonlocal n
        n += 1
        return n
    return step


s = counter(); s(); print(s(), (lambda *a, k=1, **kw: (a, k, kw))(1, 2, k=3, z=4))
print("a,b".split(","), " x ".strip(), "abc"[::-1], "Abc".lower(), "-".join(["1", "2"]), "x" in "xyz", "ab".replace("a", "c"), "7".zfill(3))
print(math.hypot(3, 4), math.isclose(0.1 + 0.2, 0.3), math.floor(-1.5), math.gcd(12, 18), math.inf > 1e308, math.comb(5, 2))


class Noisy:
    def __del__(self): print("gone")


Noisy(); print(isinstance(True, int), type(1).__name__, callable(len), hasattr([], "append"), getattr(1, "no", "default"))
