import numpy as np


def forward_kinematics(robot, q):
    return np.zeros((100_000, 100_000))
