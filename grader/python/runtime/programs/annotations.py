from typing import Generic, TypeVar, Protocol, Callable, Optional, Union, TypedDict
from collections.abc import Sequence, Callable as C2
T = TypeVar('T')
class A(Generic[T]):
    def f(self, x: Optional[T]) -> Union[T, None]: return x
a: A[int] = A[int](); print(a.f(3))
class P(Protocol):
    def f(self) -> int: ...
class D(TypedDict):
    x: int
print(D(x=3), isinstance([1], Sequence), isinstance(len, C2), isinstance({}, Sequence))
