import copy
from enum import Enum
from collections import deque, defaultdict, namedtuple
class P(Enum):
    A = 1
d = copy.deepcopy({'p': P.A}); print(d['p'] is P.A)
N = namedtuple('N', 'a b'); n = N([1], 2); m = copy.deepcopy(n); print(m, m is n, m.a is n.a)
q = deque([[1],[2]], maxlen=3); r = copy.deepcopy(q); r[0].append(5); print(q, r, r.maxlen)
dd = defaultdict(list); dd['a'].append(1); e = copy.deepcopy(dd); e['b'].append(2); print(dict(dd), dict(e))
class O:
    def __init__(self): self.f = print; self.me = self; self.l = [1]
o = O(); c = copy.deepcopy(o); print(c.me is c, c.l, c.l is o.l); c2 = copy.copy(o); print(c2.l is o.l)
class S:
    __slots__ = ('x', 'y')
s = S(); s.x = [1]; t = copy.deepcopy(s); print(t.x, t.x is s.x)
class C:
    def __copy__(self): return 'c'
    def __deepcopy__(self, memo): return 'd'
print(copy.copy(C()), copy.deepcopy(C()), copy.deepcopy([C()]))
l = [1]; l.append(l); k = copy.deepcopy(l); print(k[1] is k)
a = [1]; two = copy.deepcopy([a, a]); print(two[0] is two[1])
