# The reference solution of lab 5 in Python: closed forms, and one place of the path after the other at the speed of the drives.
from dataclasses import dataclass

import numpy as np
from numpy import cos, sin

TOP_SPEED = np.array([np.deg2rad(18), 0.02, 0.02, np.pi])  # rad/s, m/s, m/s, rad/s
GAIN = 10.0  # 1/s: near a place the arm slows down with a time constant of 0.1 s


# How far the TCP is ahead of the column's axis: A of the brief.
def ahead(robot, q):
    return robot.reach + robot.gripper - q[2]


def tcp_pose(robot, q):
    a = ahead(robot, q)
    c1, s1, c4, s4 = cos(q[0]), sin(q[0]), cos(q[3]), sin(q[3])
    return np.array(
        [
            [-c1 * s4, -c1 * c4, -s1, robot.side * c1 - a * s1],
            [-s1 * s4, -s1 * c4, c1, robot.side * s1 + a * c1],
            [-c4, s4, 0, robot.column + robot.carriage - robot.drop + q[1]],
            [0, 0, 0, 1],
        ]
    )


def branch(robot, p, a):
    turn = np.arctan2(p[1] * robot.side - p[0] * a, p[0] * robot.side + p[1] * a)
    return [turn, p[2] + robot.drop - robot.column - robot.carriage, robot.reach + robot.gripper - a]


def inverse_kinematics(robot, position):
    squared = position[0] ** 2 + position[1] ** 2 - robot.side**2
    # the edge of the hole is within reach; rounding may put it a little inside
    if squared < -1e-12:
        return []
    a = np.sqrt(max(squared, 0))
    return [branch(robot, position, a), branch(robot, position, -a)]


def velocity(robot, q, qd):
    a = ahead(robot, q)
    c1, s1 = cos(q[0]), sin(q[0])
    return [
        -qd[0] * (a * c1 + robot.side * s1) + qd[2] * s1,
        -qd[0] * (a * s1 - robot.side * c1) - qd[2] * c1,
        qd[1],
    ]


def acceleration(robot, q, qd, qdd):
    a = ahead(robot, q)
    c1, s1 = cos(q[0]), sin(q[0])
    x = a * c1 + robot.side * s1
    y = a * s1 - robot.side * c1
    return [
        -qdd[0] * x + qdd[2] * s1 + qd[0] ** 2 * y + 2 * qd[0] * qd[2] * c1,
        -qdd[0] * y - qdd[2] * c1 - qd[0] ** 2 * x + 2 * qd[0] * qd[2] * s1,
        qdd[1],
    ]


def joint_rates(robot, given):
    a = ahead(robot, given.q)
    v = given.v
    c1, s1 = cos(given.q[0]), sin(given.q[0])
    # beside the column, turn and reach move the TCP along the same line: then the turn rests
    turn = -(v[0] * c1 + v[1] * s1) / a if abs(a) > 1e-9 else 0.0
    return {"turn": turn, "lift": v[2], "reach": robot.side * turn + s1 * v[0] - c1 * v[1]}


def joint_accelerations(robot, given):
    a = ahead(robot, given.q)
    c1, s1 = cos(given.q[0]), sin(given.q[0])
    w = given.qd[0]
    turn = -(given.a[0] * c1 + given.a[1] * s1 + robot.side * w**2 - 2 * w * given.qd[2]) / a
    reach = robot.side * turn - a * w**2 + s1 * given.a[0] - c1 * given.a[1]
    return {"turn": turn, "lift": given.a[2], "reach": reach}


@dataclass
class Path:
    robot: object
    place: int = 0


def init(robot, task):
    global path
    path = Path(robot)


def control(observation):
    sensors = observation.sensors
    goal = inverse_kinematics(path.robot, observation.target[path.place])[0] + [0]
    off = goal - observation.q
    # at its switch the lift is at its end, wherever the drawing has it
    if sensors.lift_lower and off[1] < 0 or sensors.lift_upper and off[1] > 0:
        off[1] = 0.0
    if np.linalg.norm(off) < 5e-4 and path.place < 5:
        path.place += 1
    return np.clip(off * GAIN, -TOP_SPEED, TOP_SPEED)
