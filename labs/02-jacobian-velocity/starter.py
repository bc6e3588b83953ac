# Lab 2: how do I make the hand move?
#
# Angles are radians, joint velocities rad/s. x is up, y is sideways. q[0] is the shoulder, q[1] the elbow; the elbow's angle is
# relative to the upper arm, and both links point straight up at q = [0, 0].
# Your arm, line and speed may differ from your neighbour's, and from hidden runs: take every number from `robot` and
# `observation.target`, and never type it in.
#
#     kinemark grade
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # for your editor: kinemark.pyi says what the parameters have
    from kinemark import Observation, Robot, Vector


# Task "jacobian". How fast does the hand move when the joints turn? Return two rows, x then y, of one number per joint:
#     [[dx/dq1, dx/dq2],
#      [dy/dq1, dy/dq2]]      in m/rad
# robot.link_lengths are two lengths in m: upper arm, forearm.
def jacobian(robot: Robot, q: Vector):
    return np.zeros((2, 2))


# What you keep from call to call.
class State:
    def __init__(self, robot: Robot):
        self.robot = robot


state: State


# Called once before each run.
def init(robot: Robot, task: str):
    global state
    state = State(robot)


# Tasks "line" and "through-the-shoulder". Called every 10 ms: return the two joint velocities in rad/s.
#     observation.q          the joint angles now, [q1, q2] in rad
#     observation.qd         their velocities, in rad/s
#     observation.tcp        where the hand is now, [x, y, z] in m
#     observation.time       s since the start
#     observation.target     what is asked for:
#         ["from"], ["to"]   the two ends of the line, [x, y, z] in m; the hand starts at "from"
#         .speed             how fast the hand should go along it, in m/s
#         .max_rate          how fast a joint may turn, in rad/s
#     observation.task       the name of the task
def control(observation: Observation):
    return [0.0, 0.0]
