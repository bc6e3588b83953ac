# Misspells a field of the robot in the forward kinematics.
import math
from math import acos, atan2, cos, sin

import numpy as np

DWELL = 0.9  # s, more than is asked for: the arm settles while it stands
MOVE = 1.6  # s


def forward_kinematics(robot, q):
    l1, l2 = robot.link_length
    x = robot.base_height + l1 * cos(q[0]) + l2 * cos(q[0] + q[1])
    y = l1 * sin(q[0]) + l2 * sin(q[0] + q[1])
    return [x, y, 2 * robot.link_offset]


def inverse_kinematics(robot, position):
    l1, l2 = robot.link_lengths
    u = position[0] - robot.base_height
    y = position[1]
    c = (u * u + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2)
    # the boundary itself is in reach; what lies beyond it by more than rounding is not
    if abs(c) > 1 + 1e-9:
        return []
    bend = acos(min(max(c, -1.0), 1.0))

    def branch(bend):
        return [atan2(y, u) - atan2(l2 * sin(bend), l1 + l2 * cos(bend)), bend]

    return [branch(bend), branch(-bend)]


def quintic(s):
    s = min(max(s, 0.0), 1.0)
    return s**3 * (10 - 15 * s + 6 * s**2)


class Mover:
    """From where the arm is to the first place, then to the second."""

    def __init__(self, robot):
        self.robot = robot
        self.goals = None

    def begin(self, observation):
        # the elbow bends the same way at both places
        self.goals = [np.array(inverse_kinematics(self.robot, place)[0]) for place in observation.target]
        # the shoulder takes the short way round
        turn = self.goals[1][0] - self.goals[0][0]
        self.goals[1][0] = self.goals[0][0] + math.remainder(turn, 2 * math.pi)
        self.start, self.origin, self.leg = 0.0, observation.q, 0

    def __call__(self, observation):
        if self.goals is None:
            self.begin(observation)
        if self.leg == 0 and observation.time >= self.start + MOVE + DWELL:
            self.start, self.origin, self.leg = observation.time, self.goals[0], 1
        s = quintic((observation.time - self.start) / MOVE)
        return self.origin + s * (self.goals[self.leg] - self.origin)


def init(robot, task):
    global control
    control = Mover(robot)
