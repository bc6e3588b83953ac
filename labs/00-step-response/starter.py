# Lab 0: what does a motor do when the command jumps?
#
# Angles are radians: x is up, y is sideways, and both links point straight up at q = [0, 0]. A positive torque turns a joint
# the way its angle grows.
#
# Your neighbour's arm may have other lengths, steps and gains. Read yours from `robot` and `observation.target`; do not type
# them in.
#
#     kinemark grade
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # for your editor: kinemark.pyi says what the parameters have
    from kinemark import Given, Observation, Robot


# Task 2, "position-loop". `given` has
#     mass (kg), length, width (m)   of the forearm, a box that turns about one of its ends
#     damping (N m s/rad)            of the joint
#     kp, ki, kd                     the gains, in N m/rad, N m/(rad s), N m s/rad
#     load_torque (N m)              a constant load at the joint
# Replace each -1.
def position_loop(given: Given):
    return {
        "inertia": -1.0,  # about the joint, kg m²
        "natural_frequency": -1.0,  # rad/s
        "damping_ratio": -1.0,
        "steady_state_error": -1.0,  # what the load leaves at rest, rad
    }


# Task 4, "velocity-loop". `given` has inertia (kg m²), damping (N m s/rad), kp (N m s/rad), period (s).
def velocity_loop(given: Given):
    return {
        "final_speed": -1.0,  # with kp alone, as a share of the setpoint
        "time_constant": -1.0,  # with kp alone, s
        "largest_kp": -1.0,  # above it the sampled loop diverges, N m s/rad
        "largest_kd": -1.0,  # above it a derivative in this loop diverges, kg m²
    }


# What you keep from call to call.
class State:
    def __init__(self, robot: Robot):
        self.robot = robot
        self.sum = np.zeros(2)  # room for the integrals of two errors


state: State


# Called once before each run.
def init(robot: Robot, task: str):
    global state
    state = State(robot)


# observation.q and observation.qd are the angles and speeds of both joints, observation.dt is the time between two calls,
# observation.target what the task wants.
def control(observation: Observation):
    target = observation.target
    if observation.task == "warm-up":
        # Task 1: a servo turns the joints to the angles that you return, [shoulder, elbow] in rad
        return [0.5, 0.0]
    # From here on there is no servo: you return the motors' torques, [shoulder, elbow] in N m, every millisecond
    if observation.task == "pid":
        # Task 3: the elbow to target.elbow_rad, the shoulder at 0, with target.kp, target.ki, target.kd
        return [0.0, 0.0]
    if observation.task == "speed":
        # Task 5: the elbow at target.elbow_rad_s, the shoulder held, with target.kp and target.ki
        return [0.0, 0.0]
    # Task 6, "hold": the elbow to target.elbow_rad exactly. Here state.robot.gravity(q) gives the torques that hold the arm still.
    return [0.0, 0.0]
