from dataclasses import dataclass, field
from typing import ClassVar
@dataclass
class S:
    N: ClassVar[int] = 3
    a: float = field(default=1.0)
    b: float = field(default=2.0, repr=False)
print(S(5), S.N, S.a, S(5).b)
