from functools import *
@lru_cache(maxsize=None)
def f(a, b=2): return a + b
print(f(1), f(1, b=3), f(1), f.cache_info())
@cache
def fib(n): return n if n < 2 else fib(n-1) + fib(n-2)
print(fib(30))
class A:
    @cached_property
    def v(self): print('once'); return 3
a = A(); print(a.v, a.v)
@total_ordering
class T:
    def __init__(self, x): self.x = x
    def __eq__(self, o): return self.x == o.x
    def __lt__(self, o): return self.x < o.x
print(T(1) >= T(0), T(1) <= T(1), T(2) > T(1))
print(reduce(lambda a, b: a*b, [1,2,3]), partial(pow, 2)(3))
@wraps(f)
def g(): pass
print(g.__name__)
