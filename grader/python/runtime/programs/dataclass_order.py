from dataclasses import dataclass
@dataclass(order=True)
class V:
    a: int
    b: int = 0
print(sorted([V(3), V(1,2), V(1,1)]), V(1) < V(2), V(1) >= V(1))
@dataclass
class W(V):
    c: int = 9
print(W(1), W(1) == V(1), isinstance(W(1), V))
@dataclass(kw_only=True)
class K:
    a: int
    b: int = 1
print(K(a=3))
try: K(3)
except TypeError as e: print(e)
