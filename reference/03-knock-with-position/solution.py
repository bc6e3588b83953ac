# The reference solution of lab 3 in Python: straight lines from point to point, and at each moment the command that makes the arm
# stand where it is meant to stand.
from math import acos, atan2, cos, sin

import numpy as np

KP = 100.0  # N m/rad: the servo's stiffness
SPEED = 0.4  # m/s, on the average of a line
BRISK = 1.0  # m/s: the same in task "hold", where nothing is in the way
DWELL = 2.0  # s: for the stays of task "hold", so that the arm comes to rest


# The angles that bring the hand to `position`, with the elbow bent as it is at the start.
def inverse_kinematics(robot, position):
    l1, l2 = robot.link_lengths
    u = position[0] - robot.base_height
    y = position[1]
    c = np.clip((u * u + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2), -1, 1)
    bend = acos(c)
    return np.array([atan2(y, u) - atan2(l2 * sin(bend), l1 + l2 * cos(bend)), bend])


def quintic(s):
    s = np.clip(s, 0, 1)
    return s**3 * (10 - 15 * s + 6 * s**2)


class Walk:
    def __init__(self, robot):
        self.robot = robot
        self.points = []
        self.leg = 1
        self.began = 0.0


def init(robot, task):
    global walk
    walk = Walk(robot)


def control(observation):
    hold = observation.task == "hold"
    if not walk.points:
        walk.points = [observation.tcp, *(observation.target if hold else observation.target.points)]
    start, end = walk.points[walk.leg - 1], walk.points[walk.leg]
    duration = np.linalg.norm(end - start) / (BRISK if hold else SPEED)
    since = observation.time - walk.began
    if since >= duration + (DWELL if hold else 0) and walk.leg + 1 < len(walk.points):
        walk.leg += 1
        walk.began = observation.time
    q = inverse_kinematics(walk.robot, start + quintic(since / duration) * (end - start))
    # at rest the servo gives KP (command - q), and the arm needs gravity(q)
    return q + walk.robot.gravity(q) / KP
