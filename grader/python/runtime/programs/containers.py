from collections import *
c = Counter('abca'); print(c['a'], c['z'], c.most_common(1), c.total()); c.update('aa'); c.update({'b': 3}); print(c); print(Counter(a=2) + Counter({'a': 1, 'b': 2}))
P = namedtuple('P', 'x y', defaults=[5]); print(P(1), P(y=2, x=1), P._make([1,2]), P(1)._replace(x=3))
try: P(1,2,3)
except TypeError as e: print(e)
try: P(1, z=2)
except TypeError as e: print(e)
try: P(1)._replace(q=2)
except ValueError as e: print(e)
