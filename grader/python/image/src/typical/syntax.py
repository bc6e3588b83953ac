"""Forms of the language that controllers use, one after the other; most of them are in a lab's first file, which the others begin with."""

from __future__ import annotations

import math as m
import typing as t
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Optional, Union

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from kinemark import Given, Observation, Robot, Vector

Floats = npt.NDArray[np.float64]
KP: Final = 100.0  # N m/rad
GAINS: dict[str, float] = {"p": 100.0, "d": -1.0, **{"i": 0.5}}
HOME = (0.775397496610753, 1.5907976603682872, -3.141592653589793, 0.1234567890123456789, 6.02214076e23, 1.7976931348623157e308)
NUMBERS = [0, 1, -1, 2.5, -0.5, 1e-3, 5e-324, 1.0e10, 0.1, 0.2, 0.3, 1 / 3, 1_000, 0x1F, 0b11, 0o17, 123456789012345678901234567890, 2**64]
TEXT = "a\tb\n" 'c\'d' "\u00e9\x41\N{DEGREE SIGN}" r"\d" f"{KP:.1f} {HOME[0]!r:>10} {{}}" """long
one""" f"{'nested'} {GAINS['p']}"
TABLE = [
    # a, alpha, d, theta
    [0.0, m.pi / 2, 0.1519, 0.0],
    [-0.24365, 0.0, 0.0, 0.0],
]
LONG = 1 + 2 \
    + 3
bounds: tuple[float, float]
count: int = 0
state: State


@dataclass
class Waypoint:
    """A place."""

    x: float
    y: float = 0.0
    name: Optional[str] = None

    def distance(self, other: Waypoint) -> float:
        return m.hypot(self.x - other.x, self.y - other.y)


class State:
    limit: float = 2.0
    names: list[str]

    def __init__(self, robot: Robot, *, gain: float = 1.0, **others: Any) -> None:
        self.robot = robot  # what is kept
        self.gain: float = gain
        self.others = others
        self.path = [Waypoint(1.0, 2.0), Waypoint(x=0.5)]
        self.angle = self.rate = None
        (self.a, self.b), self.c = (1, 2), [3]

    def __repr__(self) -> str:
        return f"{self.__class__.__name__}(gain={self.gain:g})"

    @property
    def next(self) -> Union[Waypoint, None]:
        return self.path[0] if self.path else None

    @staticmethod
    def clamp(x: float, low=-1.0, high=1.0, /) -> float:
        return low if x < low else high if x > high else x

    @classmethod
    def of(cls, robot):
        return cls(robot, gain=2.0, extra=None)


def position_loop(given: Given):
    return {
        "inertia": -1.0,  # kg m²
        "rate": -1.0 if given else +1.0,
        "list": [-1.0, -1.0],
        "matrix": [[1, 0], [0, 1]],
    }


def forward_kinematics(robot: Robot, q: Vector) -> list[float]:
    x: float
    x, y, *rest = *q, 0.0
    l1, l2 = robot.link_lengths

    def turned(angle: float, /, scale=1.0, *more: float, last: bool = False) -> tuple[float, float]:
        nonlocal x
        x += angle * scale
        return x, angle if not last else -angle

    turned(1.0, 2.0, 3.0, last=True)
    total = sum((i + 1) * j for i, j in enumerate(q) if j is not None and i >= 0)
    pairs = {k: v for k, v in zip("ab", q)}
    squares = {i * i for i in range(3)}
    table = [[i * j for j in range(3) if j % 2 == 0] for i in range(2)]
    keys = [*pairs, *squares]
    both = {**pairs, "c": [*rest]}
    if (n := len(keys)) > 2 and not both.get("zz"):
        total -= n
    elif total < -1 or n == 0:
        total **= 2
    else:
        pass
    for i in range(3):
        if i == 1:
            continue
        for j in (1, 2):
            if j == 2:
                break
        else:
            total += 1
    while n > 0:
        n -= 1
        if n == 1:
            break
    else:
        n = -1
    try:
        try:
            value = pairs["zz"]
        except KeyError as error:
            value = len(str(error))
        except (TypeError, ValueError):
            raise
        else:
            value = 0
        finally:
            total += 1
        assert value >= 0, f"negative: {value}"
        if value < 0:
            raise ValueError("never") from None
    except Exception as error:
        print(type(error), error)
    match n:
        case 0 | 1:
            value = 1
        case [a, b]:
            value = a + b
        case {"x": a}:
            value = a
        case Waypoint(x=a):
            value = a
        case str() as a if a:
            value = 2
        case _:
            value = 3
    del keys[0], both
    first, second = second, first = 1, 2
    value = first if first < second <= 3 != 4 else second
    value += 1 if "a" in pairs else 2
    value //= 1
    value %= 100
    value <<= 1
    value |= 1
    value &= 0xFF
    value ^= 0
    value >>= 1
    sort = lambda p, k=1, *, r=False: (p[k], r)
    table.sort(key=sort, reverse=True)
    s = table[0][1:], table[-1][::-1], table[0][-2:], table[:1], TEXT[2:5], HOME[0:3:2]
    ...
    return [float(total), value + len(s), m.fabs(x)]


def inverse_kinematics(robot, position):
    q1 = q2 = 0.0
    if not position.any():
        return []
    return [(q1, q2), (-q1, q2)]


def jacobian(robot, q):
    # TODO
    return np.zeros((3, 2))


def steps(n: int) -> t.Iterator[float]:
    for i in range(n):
        yield i / n
    yield from (1.0, 1.0)


def init(robot: Robot, task: str) -> None:
    global state, count, bounds
    state = State.of(robot)
    state.first = list(steps(2))
    count = 0
    bounds = (-1.0, 1.0)


# Called every period.
def control(observation: Observation) -> Vector:
    global count
    count += 1
    task, target = observation.task, observation.target
    if task == "hold":
        return [0.0, 0.0]
    if count == 2:
        print("tick", observation.tick, state, sep=": ", end="\n")
        print()
        print("%s %.3f" % (task, observation.time), observation.q, target.p, [round(x, 3) for x in observation.q])
    low, high = bounds
    u = [State.clamp(KP * (0.0 - x) / 1e3, low, high) for x in observation.q]
    return np.array(u) if state.next is not None and count % 2 else u


if __name__ == "__main__":
    print(forward_kinematics(None, [0.0, 0.0]))
