from dataclasses import dataclass, asdict, field
@dataclass
class P:
    x: float
@dataclass
class Q:
    p: P
    l: list = field(default_factory=lambda: [P(1), P(2)])
    d: dict = field(default_factory=lambda: {'a': P(3)})
print(asdict(Q(P(0))))
