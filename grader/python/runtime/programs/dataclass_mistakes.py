from dataclasses import dataclass
try:
    @dataclass
    class A:
        a: int = 1
        b: int
except TypeError as e: print(e)
try:
    @dataclass
    class B:
        a: list = []
except ValueError as e: print(e)
