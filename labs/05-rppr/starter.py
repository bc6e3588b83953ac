# Lab 5: an industrial arm. brief.html says what is asked for.
#
# Angles are radians, lengths are metres. q = [turn, lift, reach, gripper turn]; q[2] counts backwards: where it grows, the arm is
# drawn in. The lengths are robot.column, robot.carriage, robot.side, robot.reach, robot.drop and robot.gripper.
#
#     kinemark grade
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # for your editor: kinemark.pyi says what the parameters have
    from kinemark import Given, Observation, Robot, Vector


# Task "fk": the pose of the TCP, a matrix of 4 by 4: the axes of the gripper and the position in the frame of the base.
def tcp_pose(robot: Robot, q: Vector):
    return np.eye(4)


# Task "ik": every [q1, q2, q3] that brings the TCP to position = [x, y, z], and [] where there is none.
def inverse_kinematics(robot: Robot, position: Vector):
    return []


# Task "velocity": [vx, vy, vz] of the TCP, m/s.
def velocity(robot: Robot, q: Vector, qd: Vector):
    return [0.0, 0.0, 0.0]


# Task "acceleration": [ax, ay, az] of the TCP, m/s².
def acceleration(robot: Robot, q: Vector, qd: Vector, qdd: Vector):
    return [0.0, 0.0, 0.0]


# Task "rates": the rates of the joints for the velocity given.v of the TCP at given.q.
def joint_rates(robot: Robot, given: Given):
    return {"turn": 0.0, "lift": 0.0, "reach": 0.0}


# Task "accelerations": the accelerations of the joints for the acceleration given.a of the TCP, at given.q with the rates given.qd.
def joint_accelerations(robot: Robot, given: Given):
    return {"turn": 0.0, "lift": 0.0, "reach": 0.0}


# What you keep from call to call.
class State:
    def __init__(self, robot: Robot):
        self.robot = robot


state: State


# Called once before the run.
def init(robot: Robot, task: str):
    global state
    state = State(robot)


# Task "pick", called every 10 ms: the rates of the four joints, rad/s, m/s, m/s, rad/s.
def control(observation: Observation):
    # observation.target holds six places for the TCP, observation.sensors.lift_lower and .lift_upper are True or False
    return [0.0, 0.0, 0.0, 0.0]
