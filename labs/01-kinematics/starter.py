# Lab 1: where is the hand, and how do I get it there?
#
# Angles are radians. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the elbow; the elbow's angle
# is relative to the upper arm, and both links point straight up at q = [0, 0].
#
#     kinemark grade
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # for your editor: kinemark.pyi says what the parameters have
    from kinemark import Observation, Robot, Vector


# Where is the hand? Return [x, y, z] in metres.
# robot.base_height and robot.link_offset are numbers, robot.link_lengths are two.
def forward_kinematics(robot: Robot, q: Vector):
    return [0.0, 0.0, 0.0]


# Which angles bring the hand to position = [x, y, z]? Return every way to get there, [[q1, q2], [q1, q2]],
# and [] where there is none.
def inverse_kinematics(robot: Robot, position: Vector):
    return []


# Task "move", called every 10 ms: return the two joint angles that the motors should go to.
def control(observation: Observation):
    # observation.target holds the two places to go to, observation.time the time in seconds
    return observation.q
