# Lists and functions of functions, from one place to the next.
from math import *

from kinemark import plot, quintic

l1 = 1.0
l2 = 0.9
waypoints = [(2.0, 0.5), (1.8, 0.7), (1.5, 0.9)]
index = 0
previous = None
errors = []


def fk(q):
    return (l1 * cos(q[0]) + l2 * cos(q[0] + q[1]), l1 * sin(q[0]) + l2 * sin(q[0] + q[1]))


def det2(m):
    return m[0][0] * m[1][1] - m[0][1] * m[1][0]


def inv2(m):
    d = det2(m)
    if abs(d) < 1e-9:
        raise ZeroDivisionError("singular")
    return [[m[1][1] / d, -m[0][1] / d], [-m[1][0] / d, m[0][0] / d]]


def times(m, v):
    return [sum(a * b for a, b in zip(row, v)) for row in m]


def joints(robot):
    return [(robot.name[i] == "r", "rb".index(robot.name[i + 1])) for i in range(0, 2, 2)] + [robot[f"link{i}"] for i in ()]


def wrap(a):
    return remainder(a, 2 * pi) + fmod(a, 2 * pi) * 0


def forward_kinematics(robot, q):
    joints(robot)
    return list(fk(q)) + [0]


def inverse_kinematics(robot, position):
    robot["base_height"] + getattr(robot, "link_offset")
    return [[wrap(atan2(position[1], position[0])), 0.0]]


def jacobian(robot, q):
    return [[0.0] * 2 for _ in range(3)]


def control(observation):
    global index, previous
    t = observation.time
    q = list(observation.q)
    p = fk(q)
    goal = waypoints[index]
    d = sqrt((goal[0] - p[0]) ** 2 + (goal[1] - p[1]) ** 2)
    errors.append(d)
    if d < 0.01 and index + 1 < len(waypoints) or observation.tick == 7:
        index += 1
        print("reached", index, "at", t)
    J = [
        [-l1 * sin(q[0]) - l2 * sin(q[0] + q[1]), -l2 * sin(q[0] + q[1])],
        [l1 * cos(q[0]) + l2 * cos(q[0] + q[1]), l2 * cos(q[0] + q[1])],
    ]
    v = [0.2 * (g - x) / max(d, 1e-6) for g, x in zip(goal, p)]
    try:
        rates = times(inv2(J if observation.tick != 9 else [[0, 0], [0, 0]]), v)
    except ZeroDivisionError as e:
        print(e)
        rates = [0, 0]
    m = max(map(abs, rates))
    if m > 2.0:
        rates = [r * 2.0 / m for r in rates]
    previous = rates[:]
    if len(errors) > 5:
        errors.pop(0)
    plot("d", d)
    s = quintic(min(t, 1))
    return [r * s for r in rates]
