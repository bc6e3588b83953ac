# The reference solution of lab 0 in Python: one PID law, one PI law, and gravity taken out of the loop where it stands in the way.
from math import sqrt

import numpy as np


# The loop J a + (b + kd) v + kp x of a joint with a PD controller: how it answers, and what a constant load leaves over.
def position_loop(given):
    # a box that turns about one end: about its own middle, then moved by half its length
    m = given.mass
    inertia = m * (given.length**2 + given.width**2) / 12 + m * (given.length / 2) ** 2
    return {
        "inertia": inertia,
        "natural_frequency": sqrt(given.kp / inertia),
        "damping_ratio": (given.damping + given.kd) / (2 * sqrt(given.kp * inertia)),
        "steady_state_error": 0.0 if given.ki > 0 else given.load_torque / given.kp,
    }


# The loop J a + (b + kp) v of a joint under velocity control, and how far its gains may go at this control period.
def velocity_loop(given):
    return {
        "final_speed": given.kp / (given.damping + given.kp),
        "time_constant": given.inertia / (given.damping + given.kp),
        "largest_kp": 2 * given.inertia / given.period,
        "largest_kd": given.inertia,
    }


class Controller:
    def __init__(self, robot):
        self.robot = robot
        self.sum = np.zeros(2)  # the integral of the error, by joint


controller = None


def init(robot, task):
    global controller
    controller = Controller(robot)


def control(observation):
    target = observation.target
    if observation.task == "warm-up":
        return [target.shoulder_rad, 0.0]
    if observation.task == "speed":
        error = np.array([0.0, target.elbow_rad_s]) - observation.qd
        controller.sum += error * observation.dt
        return target.kp * error + target.ki * controller.sum
    error = [0.0, target.elbow_rad] - observation.q
    plot("error", error)
    if observation.task == "hold":
        return target.kp * error - target.kd * observation.qd + controller.robot.gravity(observation.q)
    # the derivative is taken of the measurement: the error's jumps with the command
    controller.sum += error * observation.dt
    return target.kp * error + target.ki * controller.sum - target.kd * observation.qd
