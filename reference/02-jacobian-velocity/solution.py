# The reference solution of lab 2 in Python: the Jacobian in closed form, the speed of the line fed forward, what the hand is off fed
# back, and damped least squares so that the inverse stays finite where the arm folds.
import numpy as np

RAMP = 0.3  # s, from rest to full speed, within the first 5 cm
GAIN = 5.0  # 1/s: a hand that is off comes back with a time constant of 0.2 s
DAMPING = 0.05  # m: far below the lengths of the links, far above what the hand is off

robot = None


def init(the_robot, task):
    global robot
    robot = the_robot


def jacobian(robot, q):
    l1, l2 = robot.link_lengths
    s1, c1 = l1 * np.sin(q[0]), l1 * np.cos(q[0])
    s12, c12 = l2 * np.sin(q[0] + q[1]), l2 * np.cos(q[0] + q[1])
    return np.array([[-s1 - s12, -s12], [c1 + c12, c12]])


# How far along the line the hand shall be after t, and how fast: from rest to the speed, steady, and to rest again.
def progress(length, speed, t):
    end = length / speed + RAMP
    if t < RAMP:
        return 0.5 * speed * t * t / RAMP, speed * t / RAMP
    if t < end - RAMP:
        return speed * (t - 0.5 * RAMP), speed
    left = max(end - t, 0)
    return length - 0.5 * speed * left * left / RAMP, speed * left / RAMP


def control(observation):
    target = observation.target
    start = np.array(target["from"])
    way = target["to"] - start
    length = np.linalg.norm(way)
    along = way / length
    done, speed = progress(length, target.speed, observation.time)
    off = start + along * done - observation.tcp
    v = (along * speed + off * GAIN)[:2]  # only x and y: z is the arm's own

    # qd = J^T (J J^T + d^2)^-1 v
    J = jacobian(robot, observation.q)
    rate = J.T @ np.linalg.solve(J @ J.T + DAMPING**2 * np.eye(2), v)
    return rate * min(1, target.max_rate / max(np.abs(rate).max(), 1e-9))
