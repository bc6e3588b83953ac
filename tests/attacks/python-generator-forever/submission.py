import itertools


def forward_kinematics(robot, q):
    return sum(itertools.count())
