# What Python says of mistakes.
import math
from collections import deque, namedtuple, defaultdict
from dataclasses import dataclass
from enum import Enum
P = namedtuple("P", "x y")
class K(Enum):
    A = 1
class C:
    def __init__(self, a, b=1): self.a = a
    def m(self, x): return x
    @property
    def p(self): return 1
def f(a, b, *, c=1): return a
def g(a, b=2): return a
lst = [1, 2, 3]; tup = (1, 2); d = {"a": 1}; s = "text"; x = 1.5
def u():
    if False: y = 1
    return y
def unpack7(): a, b = 1, 2, 3
def unpack8(): a, b = "xyz"
def unpack9(): a, b = {1: 2, 3: 4, 5: 6}
def unpack10(): (a, b), c = (i for i in [[1, 2, 3], 4])
def unpack2(): a, b, c = 1, 2
def unpack3(): a, b = 1
def unpack4(): a, *b, c = [1]
def unpack5(): a, b = None
def unpack6(): a, b = {}
def assign1(): tup[0] = 1
def assign2(): s[0] = "a"
def assign3(): lst[9] = 1
def assign4(): lst["a"] = 1
def assign7(): x = 1; x[0] = 1
def assign8(): f.x.y = 1
def del1(): del lst[9]
def del2(): del d["q"]
def del3(): del zz
def aug3(): count += 1
def aug1(): k = None; k += 1
def aug2(): k = [1]; k += 1
def loop1():
    for i in 3: pass
def loop2():
    for a, b in [1, 2]: pass
def raise2(): raise ValueError
def raise3(): raise
def raise4(): raise NotImplementedError("later")
def assert1(): assert 1 > 2
def assert2(): assert 1 > 2, "no"
def gen():
    def h():
        yield 1
    h()[0]
def gen2():
    def h():
        yield 1
    len(h())
def dc3():
    @dataclass(frozen=True)
    class D:
        x: float
    D(1).x = 2
MISTAKES = [
    u,
    del3,
    aug3,
    lambda: lst + 1,
    lambda: lst + tup,
    lambda: [1] + (1,),
    lambda: (1, 2) + [1],
    lambda: lst.index(9),
    lambda: ["a"].index("q"),
    lambda: lst.remove(9),
    lambda: lst[5],
    lambda: lst["a"],
    lambda: lst[1.0],
    lambda: tup[9],
    lambda: d["b"],
    lambda: d[[1]],
    lambda: s[9],
    lambda: s["a"],
    lambda: x[0],
    lambda: (1)[0],
    lambda: None[0],
    lambda: f[0],
    lambda: lst.foo,
    lambda: None.foo,
    lambda: x.foo,
    lambda: s.foo,
    lambda: C(1).foo,
    lambda: math.foo,
    lambda: 1 + lst,
    lambda: lst - lst,
    lambda: lst * 1.5,
    lambda: lst / 2,
    lambda: -lst,
    lambda: lst ** 2,
    lambda: s + 1,
    lambda: 1 + s,
    lambda: s - s,
    lambda: s * 1.5,
    lambda: None + 1,
    lambda: 1 < "a",
    lambda: [1] < 1,
    lambda: None < 1,
    lambda: abs("a"),
    lambda: abs([1]),
    lambda: len(1),
    lambda: len(x),
    lambda: sum(1),
    lambda: sum(["a"]),
    lambda: max(1),
    lambda: min(),
    lambda: max("a", 1),
    lambda: float("abc"),
    lambda: float([1]),
    lambda: float(None),
    lambda: int("1.5"),
    lambda: int("a"),
    lambda: int(None),
    lambda: int([1]),
    lambda: round("a"),
    lambda: range(1.5),
    lambda: range("a"),
    lambda: list(1),
    lambda: tuple(1),
    lambda: dict(1),
    lambda: set(1),
    lambda: zip(1),
    lambda: enumerate(1),
    lambda: sorted(1),
    lambda: sorted([1, "a"]),
    lambda: iter(1),
    lambda: next([1]),
    lambda: next(iter([])),
    lambda: list(map(1, [1])),
    lambda: f(),
    lambda: f(1),
    lambda: f(1, 2, 3),
    lambda: f(1, 2, d=3),
    lambda: f(1, 2, 3, 4),
    lambda: f(1, a=2),
    lambda: g(),
    lambda: g(1, 2, 3),
    lambda: C(),
    lambda: C(1, 2, 3),
    lambda: C(1).m(),
    lambda: C(1).m(1, 2),
    lambda: C.m(),
    lambda: C(1)(),
    lambda: x(),
    lambda: None(),
    lambda: lst(),
    lambda: d(),
    lambda: s(),
    lambda: math.pi(),
    lambda: math.sqrt(-1),
    lambda: math.sqrt("a"),
    lambda: math.sqrt([1]),
    lambda: math.acos(2),
    lambda: math.log(0),
    lambda: math.log(-1),
    lambda: math.exp(1000),
    lambda: math.sin(None),
    lambda: math.factorial(-1),
    lambda: math.factorial(1.5),
    lambda: math.hypot("a"),
    lambda: math.floor("a"),
    lambda: math.pow(0, -1),
    lambda: math.fmod(1, 0),
    lambda: math.cos(math.inf),
    lambda: 1 / 0,
    lambda: (-8) ** 0.5 + None,
    lambda: [].pop(),
    lambda: lst.pop(9),
    lambda: lst.insert(1),
    lambda: tup.append(1),
    lambda: s.index("q"),
    lambda: d.foo,
    lambda: d.pop("q"),
    lambda: {}.popitem(),
    lambda: set().pop(),
    lambda: {1}.remove(2),
    lambda: deque().pop(),
    lambda: deque()[0],
    lambda: s.join([1]),
    lambda: "%d" % "a",
    lambda: "%s %s" % 1,
    lambda: "{}".format(),
    lambda: f"{x:d}",
    lambda: f"{s:.2f}",
    lambda: f"{None:.2f}",
    lambda: f"{lst:.2f}",
    lambda: f"{x:q}",
    lambda: P(1),
    lambda: P(1, 2, 3),
    lambda: P(1, 2).z,
    lambda: K(2),
    lambda: K["B"],
    lambda: K.A + 1,
    lambda: K.A < K.A,
    lambda: undefined,
    lambda: (lambda: lenght)(),
    lambda: prnt,
    lambda: isinstance(1, 1),
    lambda: issubclass(1, int),
    lambda: super().x,
    lambda: {**1},
    lambda: [*1],
    lambda: f(**{"z": 1, "a": 2}),
    lambda: hash([1]),
    lambda: {[1]: 2},
    lambda: ord("ab"),
    lambda: type(1, 2),
    lambda: pow(2, -1, 0),
    lambda: complex("a"),
    lambda: 1j < 2j,
    lambda: int(math.nan),
    lambda: int(math.inf),
    lambda: round(math.nan),
    lambda: [1, 2][None],
    lambda: lst[1:2.0],
    lambda: lst["a":],
    lambda: slice(),
    lambda: C(1).p(),
    lambda: setattr(C(1), "p", 2),
    lambda: delattr(C(1), "q"),
    lambda: getattr(C(1), "q"),
    lambda: {1} + {2},
    lambda: d + d,
    lambda: d < d,
    lambda: sum([[1], [2]]),
    lambda: sum("ab"),
    lambda: max([1, None]),
    lambda: all(1),
    lambda: any(None),
    lambda: 1 in "a",
    lambda: lst.foo(),
    lambda: not_a_name.x,
    lambda: bytes("a"),
    lambda: range(1, 2, 0),
    lambda: range(),
    lambda: 1.0 / 0,
    lambda: 1 / 0.0,
    lambda: 1.0 // 0,
    lambda: 1.0 % 0,
    lambda: divmod(1.0, 0),
    lambda: 1 // 0,
    lambda: 1 % 0,
    lambda: divmod(1, 0),
    lambda: x / 0.0,
    lambda: 1j / 0,
    lambda: max([]),
    lambda: min(()),
    lambda: max(iter([])),
    lambda: setattr(None, "x", 1),
    lambda: setattr(1, "x", 1),
    lambda: setattr([], "gain", 1),
    lambda: setattr("a", "gain", 1),
    unpack7, unpack8, unpack9, unpack10, unpack2, unpack3, unpack4, unpack5, unpack6, assign1, assign2, assign3, assign4, assign7, assign8, del1, del2, aug1, aug2, loop1, loop2, raise2, raise3, raise4, assert1, assert2, gen, gen2, dc3,
]
for mistake in MISTAKES:
    try:
        print(mistake())
    except Exception as error:
        print(f"{type(error).__name__}: {error}")
