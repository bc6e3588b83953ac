from abc import ABC, abstractmethod
class A: pass
class B(ABC, A):
    @abstractmethod
    def f(self): ...
    def g(self): return 1
class C(B):
    def f(self): return 2
print(C().f(), C().g())
