import math


def forward_kinematics(robot, q):
    return math.factorial(10**6)
