from __future__ import annotations
from dataclasses import dataclass, field, InitVar
from typing import ClassVar
@dataclass(frozen=True)
class S:
    N: ClassVar[int] = 3
    a: float = 1.0
    k: InitVar[int] = 2
    def __post_init__(self, k): object.__setattr__(self, 'm', k)
s = S(5.0, 7); print(s, s.m, {s: 1}[S(5.0)])
try: s.a = 3
except AttributeError as e: print(type(e).__name__, e)
