# Numbers, lists and dicts, as people write who do not use numpy.
from __future__ import annotations

import math
from math import acos, atan2, cos, pi, sin, sqrt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kinemark import Observation, Robot, Vector

GOAL = [1.2, -0.8]
LIMITS = (30.0, 15)
LIMIT_DEG = 90
state = {"segment": 0, "last": None, "sum": [0.0, 0.0]}
robot = None


def forward_kinematics(robot: Robot, q: Vector):
    l1, l2 = robot.link_lengths
    x = robot.base_height + l1 * cos(q[0]) + l2 * cos(q[0] + q[1])
    y = l1 * sin(q[0]) + l2 * sin(q[0] + q[1])
    return [x, y, 2 * robot.link_offset]


def inverse_kinematics(robot: Robot, position: Vector):
    l1, l2 = robot.link_lengths[0], robot.link_lengths[1]
    x, y, _ = position
    x -= robot.base_height
    c = (x**2 + y**2 - l1**2 - l2**2) / (2 * l1 * l2)
    if abs(c) > 1 + 1e-9 or not math.isfinite(c):
        return []
    c = max(-1.0, min(1.0, c))
    solutions = []
    for sign in (1, -1):
        q2 = sign * acos(c)
        q1 = atan2(y, x) - atan2(l2 * sin(q2), l1 + l2 * c)
        solutions.append([q1, q2])
    return solutions


def jacobian(robot, q):
    l1, l2 = robot.link_lengths
    return [
        [-l1 * sin(q[0]) - l2 * sin(q[0] + q[1]), -l2 * sin(q[0] + q[1])],
        [l1 * cos(q[0]) + l2 * cos(q[0] + q[1]), l2 * cos(q[0] + q[1])],
        [0, 0],
    ]


def quintic(s):
    s = min(max(s, 0.0), 1.0)
    return s**3 * (10 - 15 * s + 6 * s**2)


def wrapped(angle):
    while angle > pi:
        angle -= 2 * pi
    return (angle + pi) % (2 * pi) - pi


def init(the_robot, task):
    global robot
    robot = the_robot
    state["segment"] = 0
    state["gains"] = {"p": [100, 60], "d": [10, 6]}
    print("task", task, f"of {robot.joints} joints", robot.joint_names[0])


def control(observation: Observation):
    q, qd = observation.q, observation.qd
    s = quintic(observation.time / 2.0)
    if observation.tick % 10 == 0 and state["segment"] < 2:
        state["segment"] += 1
    command = []
    total = 0
    for i in range(len(q)):
        error = GOAL[i] * s - q[i]
        state["sum"][i] += error * observation.dt
        u = state["gains"]["p"][i] * error - state["gains"]["d"][i] * qd[i]
        command.append(max(-LIMITS[i], min(LIMITS[i], u)))
        total += error * error
    if observation.tick == 20:
        print("error", round(sqrt(total), 4), observation.time)
        print(f"{total:.3f} {command} {state['segment']}")
    plot("error", total)
    wrapped(math.radians(LIMIT_DEG) + q[0])
    distance = sum((a - b) ** 2 for a, b in zip(q, GOAL))
    largest = max(abs(x) for x in command)
    if largest > 1000 or distance is None or not command:
        return [0.0] * 2
    state["last"] = [c for c in command if c != 0][:1]
    return command
