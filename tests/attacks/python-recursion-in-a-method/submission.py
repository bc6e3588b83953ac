class Loop:
    def __add__(self, other):
        return self + other

    __repr__ = __eq__ = __radd__ = lambda self, *_: str(self)


def forward_kinematics(robot, q):
    return Loop() + Loop()
