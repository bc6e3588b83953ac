# What Kinemark gives a submission in Python, for editors and type checkers. It is never run; python.md is the page for people.
from __future__ import annotations

from typing import Any, ItemsView, Iterator, KeysView, Union, ValuesView, overload

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]
Number = Union[float, np.floating[Any], np.integer[Any]]

def plot(name: str, value: Union[Number, Vector, list[float]]) -> None:
    """Adds a value to a signal of the report; a vector becomes one signal per element."""

@overload
def quintic(s: Number) -> float: ...
@overload
def quintic(s: Union[Vector, list[float]]) -> Vector:
    """From 0 to 1 while s does, at rest at both ends, and still beyond them."""

@overload
def quintic_rate(s: Number) -> float: ...
@overload
def quintic_rate(s: Union[Vector, list[float]]) -> Vector:
    """The derivative of quintic."""

class Record:
    """Fields that are also entries: robot.name is robot["name"]."""

    def __getitem__(self, name: str) -> Any: ...
    def __contains__(self, name: object) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def keys(self) -> KeysView[str]: ...
    def values(self) -> ValuesView[Any]: ...
    def items(self) -> ItemsView[str, Any]: ...
    def get(self, name: str, default: Any = None) -> Any: ...

class Robot(Record):
    name: str
    joints: int
    """How many joints move."""
    joint_names: list[str]
    lower: Vector
    """Lower limits of the joints, rad or m; -inf without one."""
    upper: Vector
    """Upper limits of the joints, rad or m; inf without one."""
    effort: Vector
    """Effort limits of the joints, N m or N; inf without one."""

    def fk(self, q: Union[Vector, list[float]]) -> Vector:
        """Position of the TCP in the lab's frame, m, where the task grants it."""
    def jacobian(self, q: Union[Vector, list[float]]) -> Matrix:
        """Rows x, y, z by one column per joint, where the task grants it."""
    def gravity(self, q: Union[Vector, list[float]]) -> Vector:
        """Efforts that hold the arm still at q, where the task grants it."""
    def mass_matrix(self, q: Union[Vector, list[float]]) -> Matrix:
        """Joint-space inertia, where the task grants it."""
    def __getattr__(self, name: str) -> Any:
        """The robot's dimensions by their names, such as robot.link_lengths."""

class Sensors(Record):
    def __getattr__(self, name: str) -> Any: ...

class Given(Record):
    """What a case gives, by the names in the brief."""

    def __getattr__(self, name: str) -> Any: ...

class Observation(Record):
    task: str
    tick: int
    time: float
    """s"""
    dt: float
    """The control period, s."""
    q: Vector
    """Joint positions, rad or m."""
    qd: Vector
    """Joint velocities, rad/s or m/s."""
    effort: Vector
    """Joint efforts, N m or N."""
    tcp: Vector
    """Position of the TCP in the lab's frame, m."""
    tcp_rotation: Matrix
    """3 by 3: its columns are the axes of the TCP in the lab's frame."""
    target: Any
    """What the task sets."""
    sensors: Sensors
