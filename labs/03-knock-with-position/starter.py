# Lab 3: why is the hand too low?
#
# Angles are radians, lengths metres, efforts N m. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the
# elbow, relative to the upper arm.
#
# The lengths of the arm, the height of the shelf and the points may differ from student to student, and do in the course's hidden
# runs: take them from `robot` and `observation.target`, never type them in.
#
#     kinemark grade
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # for your editor: kinemark.pyi says what the parameters have
    from kinemark import Observation, Robot, Vector

KP = 100.0  # N m/rad: what the servo gives for 1 rad between command and angle


# Task 1, first half: which angles bring the hand to position = [x, y, z]? Bring your answer from lab 1; of its two branches take
# the one whose elbow angle is positive, as at the start.
def inverse_kinematics(robot: Robot, position: Vector):
    return np.array([0.775397496610753, 1.5907976603682872])


# Task 1, second half: which angles must be commanded so that the arm comes to rest at q? Until you say, the arm sags.
# robot.gravity(q) are the efforts that hold the arm still at the angles q, one per joint.
def command_for(robot: Robot, q: Vector):
    return q


# What you keep from call to call.
class State:
    def __init__(self, robot: Robot):
        self.robot = robot  # robot.base_height, robot.link_lengths


state: State


# Called once before each run.
def init(robot: Robot, task: str):
    global state
    state = State(robot)


# Called every 10 ms. Return the two angles that the servo should go to.
# observation.time (s), .q, .qd (rad, rad/s), .tcp (the hand: [x, y, z] in m), .task, .target
def control(observation: Observation):
    target = observation.target
    if observation.task == "hold":
        # Task 1: observation.target is two positions. Stand at the first for at least half
        # a second, then at the second, within 8 s.
        return command_for(state.robot, inverse_kinematics(state.robot, target[0]))
    # Task 2: target.points are four positions to go through, one after the other; target.can is the middle of the can,
    # target.shelf_top the height of the shelf. Do not jump from one to the next: `a + quintic(s) * (b - a)` leads the hand.
    return command_for(state.robot, inverse_kinematics(state.robot, target.points[0]))
