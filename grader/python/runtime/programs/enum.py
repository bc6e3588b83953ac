from enum import Enum, auto, IntEnum, unique
class A(Enum):
    X = 10
    Y = auto()
    Z = 10
    def nxt(self): return A.Y
    @property
    def up(self): return self.name.upper()
print(A.X, A.Y.value, A.Z, list(A), A(11), A['X'], repr(A.X), A.X is A.Z, A.X.nxt(), A.X.up, len(A), A.X in A, f"{A.X}", f"{A.X:>8}")
print(list(A.__members__), A.X == 10, A.X != A.Y, {A.X: 1}[A.Z], A.X.name)
try: A(5)
except ValueError as e: print(e)
try: A.X = 4
except AttributeError as e: print('attr')
try: A.X.value = 4
except AttributeError as e: print('attr')
try: A['Q']
except KeyError as e: print(e)
