from typing import NamedTuple
class V(NamedTuple):
    x: float
    y: float = 0.0
    def __add__(self, o): return V(self.x+o.x, self.y+o.y)
    def norm(self): return (self.x**2 + self.y**2) ** 0.5
    @property
    def s(self): return self.x + self.y
print(V(1,2)+V(3,4), V(1), V(3,4).norm(), V(1,2).s, V(1)._replace(y=5), V(1)._asdict(), V._fields, V._make([1,2]))
x, y = V(1, 2); print(x, y, V(1,2) == (1,2), hash(V(1,2)) == hash((1,2)))
match V(1, 2):
    case V(x, y): print('m', x, y)
try: V()
except TypeError as e: print(e)
P = NamedTuple('P', [('a', int), ('b', int)]); print(P(1, 2))
