# Lab 6: one program for every robot.
#
# robot.name is the row, such as "RzTxRy": two letters for a joint. R turns (q in rad), T and P slide (q in m); then the axis.
#     robot.name[0]          the first letter, "R"
#     robot.joints           how many joints there are
#     robot.base_height      height of the first joint, in m
#     robot.link1, .link2    [x, y, z] in m from a joint to the next, and from the last one to the tip; robot["link1"] is robot.link1
# All frames are aligned with the base at q = 0: x forward, y to the left, z up. Rows, sizes and the number of joints differ from case
# to case: take all of them from `robot`.
#
#     kinemark grade
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # for your editor: kinemark.pyi says what the parameters have
    from kinemark import Observation, Robot, Vector


# Task "last-joint". The pose of the last joint: after its own motion, before the last link. Return 4 rows of 4 numbers.
def last_joint(robot: Robot, q: Vector):
    return np.eye(4)


# Task "tip". The pose of the tip, where the last link ends. Return 4 rows of 4 numbers.
def tip(robot: Robot, q: Vector):
    return np.eye(4)


# Task "jacobian". How does the tip move when the joints do? Return 6 rows of one number per joint: the velocity x, y, z of the tip, then
# its angular velocity about x, y, z.
def jacobian(robot: Robot, q: Vector):
    return np.zeros((6, robot.joints))


# What you keep from call to call.
class State:
    def __init__(self, robot: Robot):
        self.robot = robot


state: State


# Called once before each run.
def init(robot: Robot, task: str):
    global state
    state = State(robot)


# Task "move". Called every 10 ms: return the velocities of the three joints, in rad/s, or in m/s where a joint slides.
#     observation.q          the joints now, in rad or m
#     observation.tcp        where the tip is now, [x, y, z] in m
#     observation.time       s since the start
#     observation.target     what is asked for:
#         ["from"], ["to"]   the two ends of the line, [x, y, z] in m; the tip starts at "from"
#         .speed             how fast the tip should go along it, in m/s
def control(observation: Observation):
    return [0.0, 0.0, 0.0]
