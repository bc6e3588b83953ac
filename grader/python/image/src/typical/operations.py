# Operators and functions of Python's own types, one after the other: what other programs use of them differs.
import math
from collections import deque, namedtuple
from enum import Enum
from functools import partial, reduce
from itertools import product

Point = namedtuple("Point", ["x", "y"])


class Phase(Enum):
    APPROACH = 1
    DONE = 2


def forward_kinematics(robot, q):
    i, j, x, y = 7, 3, 2.5, -0.5
    ints = [i + j, i - j, i * j, i / j, i // j, i % j, i**j, -i, +i, ~i, i & j, i | j, i ^ j, i << 1, i >> 1, abs(-i)]
    floats = [x + y, x - y, x * y, x / y, x // y, x % y, x**2, x**0.5, x**y, -x, +x, abs(y), i + x, x + i, i - x, x - i]
    floats += [i * x, x * i, i / x, x / i, x**i, i**2, i % x, x % i, divmod(i, j)[0], divmod(x, y)[1], 2**-1, 1e-3]
    i += 1
    i -= 1
    i *= 1
    i /= 1
    i = int(i)
    i //= 1
    i %= 5
    x += 1
    x -= 1
    x *= 2
    x /= 2
    compared = [i < j, i <= j, i > j, i >= j, i == j, i != j, x < y, x <= y, x > y, x >= y, x == y, x != y, i < x, x == 1]
    compared += [i is None, i is not None, not i, x < 1 < i, 0 <= x <= 1, "a" < "b", "a" == "b", [1] == [1], (1,) != (2,)]
    compared += [1 in [1, 2], 3 not in (1, 2), "a" in "abc", "a" in {"a": 1}, None == 1, True and False, i or j, bool(x)]
    numbers = [int(2.7), int("3"), float(3), float("2.5"), round(2.567, 1), round(2.5), round(x), sum([1, 2.5]), sum(ints)]
    numbers += [min(ints), max(floats), min(1, 2), max(1.0, 2, 3), max([3, 1], default=0), min(ints, key=abs), len(ints)]
    numbers += [math.sin(x), math.cos(x), math.tan(x), math.asin(0.5), math.acos(0.5), math.atan(x), math.atan2(y, x)]
    numbers += [math.sqrt(2), math.hypot(x, y), math.exp(y), math.log(2), math.pow(2, 3), math.floor(x), math.ceil(x)]
    numbers += [math.fabs(y), math.degrees(x), math.radians(90), math.pi, math.tau, math.inf, math.copysign(1, y)]
    numbers += [math.fmod(x, 2), math.isclose(x, 1), math.isnan(x), math.isinf(x), math.dist([0, 1], [1, 0])]
    return [float(sum(ints)), sum(floats), len(compared) + numbers[0]]


def inverse_kinematics(robot, position):
    first = [1.0, 2.0]
    first.append(3.0)
    first.extend([4, 5])
    first.insert(0, 0.5)
    first.remove(4)
    last = first.pop()
    first += [last]
    first[0] = 1
    first[1:3] = [2, 3]
    del first[0]
    first.sort()
    first.sort(key=lambda a: -a, reverse=True)
    first.reverse()
    parts = [first[0], first[-1], first[1:], first[:-1], first[::2], first[::-1], first.index(2), first.count(3), first.copy()]
    parts += [first * 2, 2 * first, first + [1], [0] * 3, [[0.0] * 2 for _ in range(2)], list(reversed(first)), sorted(first)]
    pair = (1, 2)
    a, b = pair
    a, b = b, a
    a, (b, c) = 1, (2, 3)
    head, *tail = first
    parts += [pair + (3,), pair[0], pair[1:], tuple(first), list(pair), len(pair), pair * 2]
    table = {"a": 1, "b": [1, 2]}
    table["c"] = 3
    table.update({"d": 4}, e=5)
    table.setdefault("f", []).append(1)
    del table["a"]
    parts += [table.get("a"), table.get("a", 0), list(table), list(table.keys()), list(table.values()), list(table.items())]
    parts += [table.pop("c"), "b" in table, len(table), dict(a=1), {**table, "g": 1}, {k: v for k, v in table.items()}]
    several = {1, 2, 3}
    several.add(4)
    several.discard(1)
    parts += [several | {5}, several & {2}, several - {2}, 2 in several, len(several), sorted(several), set([1, 1]), {x for x in pair}]
    text = "knock"
    parts += [text + "!", text * 2, text[0], text[1:3], text.upper(), text.lower(), text.replace("k", "c"), text.split("o")]
    parts += ["-".join(["a", "b"]), " a ".strip(), text.startswith("kn"), text.endswith("k"), text.find("o"), str(1), str(1.5)]
    parts += [f"{1}", f"{1.5:.3f}", f"{1:5d}", f"{'a':>5}", f"{1.5:8.2f}{text!r}", "%.2f %d %s" % (1.5, 1, "a"), "{} {:.1f}".format(1, 2)]
    parts += [repr(1.5), repr(first), str(table), str(pair), str(None), str(True), repr("a"), "a,b".split(","), text == "knock"]
    parts += [list(range(3)), list(range(1, 10, 2)), list(enumerate(first)), list(zip(first, pair)), list(map(str, pair))]
    parts += [list(filter(None, first)), any(first), all(first), isinstance(1, int), isinstance(1.0, (int, float)), type(1), callable(len)]
    parts += [hasattr(robot, "name"), getattr(robot, "name"), getattr(robot, "nothing", 0), reduce(lambda u, v: u + v, first)]
    parts += [partial(max, 1)(2), Point(1, 2).x, Phase.DONE, Phase.DONE == Phase.APPROACH, Phase.DONE.name, list(product([1], [2]))]
    queue = deque([1, 2], maxlen=3)
    queue.append(3)
    queue.popleft()
    parts += [list(queue), queue[0], len(queue)]
    print(parts, table, several, queue)
    return [[float(i) for i in range(2)], [j * 0.5 for j in (1, 2) if j > 0]]


def counted(most, *rest, step=1, **named):
    """Yields."""
    i = 0
    while True:
        if i >= most:
            return
        yield i
        i += step


class Base:
    count = 0

    def __init__(self, name="base"):
        self.name = name
        self._value = None
        Base.count += 1

    @property
    def value(self):
        return self._value

    @value.setter
    def value(self, value):
        self._value = value

    @classmethod
    def made(cls):
        return cls()

    @staticmethod
    def twice(x):
        return 2 * x

    def __repr__(self):
        return f"{type(self).__name__}({self.name})"

    def __add__(self, other):
        return self.name + other.name

    def __getitem__(self, i):
        return self.name[i]

    def __len__(self):
        return len(self.name)

    def __eq__(self, other):
        return self.name == other.name

    def step(self):
        raise NotImplementedError


class Derived(Base):
    def __init__(self, **named):
        super().__init__("derived")
        self.__dict__.update(named)

    def step(self):
        try:
            super().step()
        except NotImplementedError as error:
            self.error = str(error)
        finally:
            self.done = True
        return self


def jacobian(robot, q):
    one, other = Base(), Derived(gain=2.0)
    one.value = 3
    made = [one.value, Base.made(), Base.twice(2), repr(one), str(other), one + other, one[0], len(one), one == other]
    made += [other.step().done, other.gain, Base.count, list(counted(3)), sum(i for i in counted(4, step=2)), next(counted(2))]
    total = 0
    for i, (a, b) in enumerate(zip([1, 2], [3, 4])):
        if i == 0:
            continue
        total += a * b
    for i in range(5, 0, -1):
        total += i
        if total > 10 and i != 3 or not total:
            break
    else:
        total = 0
    while total > 0:
        total -= 5
    nested = [[i * j for j in range(2)] for i in range(3)]
    for row in nested:
        for value in row:
            total += value
    kind = "large" if total > 100 else "small"
    try:
        try:
            1 / 0
        except (ZeroDivisionError, ValueError) as error:
            kind = str(error)
            raise ValueError("again") from error
    except Exception as error:
        kind = f"{type(error).__name__}: {error}"
    for broken in (lambda: [][0], lambda: {}["a"], lambda: int("a"), lambda: None.x, lambda: math.sqrt(-1), lambda: "a" - 1.0):
        try:
            broken()
        except (IndexError, KeyError, ValueError, AttributeError, TypeError) as error:
            kind = f"{error}"

    def inner(x, y=1, *more):
        nonlocal total
        total = x + y
        return total

    inner(1)
    inner(1, y=2)
    inner(*[1, 2])
    inner(**{"x": 1, "y": 2})
    assert total == 3, "no"
    del nested
    match kind:
        case "small":
            kind = "s"
        case _:
            kind = None
    if (n := len(made)) > 3:
        made = made[:n]
    lambda_ = lambda *a, **k: (a, k)
    lambda_(1, b=2)
    print(made, kind, sep=", ", end="\n")
    return [[0, 0], [0, 0.0], [0, total]]


def init(robot, task):
    assert robot.name and task


def control(observation):
    o = observation
    if o.tick == 39:
        return o.missing
    values = [o.time, o.dt, o.q[0], o.qd[1], o.effort[0], o.tcp[2], len(o.q), o.target.speed, o.target["speed"], o.tick]
    values += [o.sensors.touch, o.sensors.distance, o.sensors.force[0], o.tcp_rotation[0, 0]]
    x, y, z = o.tcp
    q1, q2 = o.q
    return [x, y, z, q1 + q2][:2]
