# Lab 4: two straight lines.
#
# Angles are radians, lengths metres. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the elbow,
# relative to the upper arm.
#
# The lengths of the arm, the points and the speed may differ from student to student, and the course's hidden run has another
# line and another speed: take them from `robot` and `observation.target`, never type them in.
#
#     kinemark grade
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # for your editor: kinemark.pyi says what the parameters have
    from kinemark import Observation, Robot, Vector


# Task "jacobian": how fast does the hand move when the joints turn? Rows x and y, one column per joint, in m/rad:
#     [[dx/dq1, dx/dq2],
#      [dy/dq1, dy/dq2]]
# Bring your answer from lab 2. It is judged for arms of other lengths too, and `control` below uses it.
def jacobian(robot: Robot, q: Vector):
    return np.array([[1.0, 0.0], [0.0, 1.0]])


# What you keep from call to call.
class State:
    def __init__(self, robot: Robot):
        self.robot = robot  # robot.link_lengths: upper arm and forearm
        self.segment = 0  # which line the hand is on: 0 or 1


state: State


# Called once before the run.
def init(robot: Robot, task: str):
    global state
    state = State(robot)


# Task "knock". Called every 10 ms. Return the two speeds, rad/s, that the joints should have.
# observation.time (s), .q, .qd (rad, rad/s), .tcp (the hand: [x, y, z] in m), .target:
#   .points   three positions: go straight from the first to the second, and straight on to the third
#   .speed    how fast, m/s
#   .can      the middle of the can
#   .shelf_top the height of the shelf
def control(observation: Observation):
    # First: the velocity [vx, vy] that takes the hand along the line it is on. A direction is a difference of two points divided
    # by its `np.linalg.norm`.
    v = np.array([0.0, 0.0])

    # Then: steer back to the line, and go over to the second line when the first is done.

    return np.linalg.solve(jacobian(state.robot, observation.q), v)
