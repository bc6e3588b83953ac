from enum import *
class B(IntEnum):
    GO = 0
    STOP = 1
print(B.GO, f"{B.GO}", repr(B.STOP), B.STOP + 1, B(1), [10, 20][B.STOP], B.GO == 0, B.STOP > B.GO, sorted([B.STOP, B.GO]), '%d' % B.STOP)
class C(str, Enum):
    A = 'a'
print(C.A == 'a', C('a'), C.A.value, C.A.upper(), repr(C.A))
class D(float, Enum):
    A = 1.5
print(D.A * 2, D.A)
class E(Enum):
    GO = (1, 2)
    BACK = (3, 4)
    def __init__(self, a, b): self.a = a; self.b = b
print(E.GO.a, E.BACK.b, E.GO.value, E((1,2)))
F = Enum("F", "A B"); print(list(F), F.B.value)
G = Enum("G", ["A", "B"]); print(G.A)
H = Enum("H", {"A": 5}); print(H.A.value)
class Sx(StrEnum):
    UP = auto()
    D = 'dd'
print(Sx.UP, Sx.D, f"{Sx.UP}", Sx.UP == 'up')
try:
    @unique
    class U(Enum):
        A = 1
        B = 1
except ValueError as e: print(e)
