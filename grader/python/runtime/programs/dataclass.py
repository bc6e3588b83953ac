from dataclasses import *
@dataclass
class A:
    x: int
    y: float = 2.0
    z: list = field(default_factory=list)
    err: float = field(init=False)
    def __post_init__(self): self.err = self.x * 2
a = A(1); print(a, a == A(1), a != A(2), asdict(a), astuple(a), [f.name for f in fields(a)], replace(a, x=5), A.__match_args__)
try: A()
except TypeError as e: print(e)
try: A(1,2,3,4)
except TypeError as e: print(e)
try: A(1,q=3)
except TypeError as e: print(e)
try: A(1,x=3)
except TypeError as e: print(e)
try: hash(a)
except TypeError as e: print('unhashable')
match a:
    case A(1, y): print('matched', y)
