# The reference solution of lab 2 in Python: the Jacobian in closed form, the speed of the line fed forward, what the hand is off fed
# back, and damped least squares so that the inverse stays finite where the arm folds.
import numpy as np

RAMP = 0.3  # s, from rest to full speed, within the first 5 cm
GAIN = 5.0  # 1/s: a hand that is off comes back with a time constant of 0.2 s
DAMPING = 0.05  # m: far below the lengths of the links, far above what the hand is off
DAMPED = DAMPING**2 * np.eye(2)

robot = None
line = None


class Line:
    """What stays the same in a run: only x and y, z is the arm's own."""

    def __init__(self, target):
        self.start = target["from"][:2]
        way = target["to"][:2] - self.start
        self.length = np.linalg.norm(way)
        self.along = way / self.length
        self.speed = target.speed

    # How far along the line the hand shall be after t, and how fast: from rest to the speed, steady, and to rest again.
    def progress(self, t):
        speed = self.speed
        end = self.length / speed + RAMP
        if t < RAMP:
            return 0.5 * speed * t * t / RAMP, speed * t / RAMP
        if t < end - RAMP:
            return speed * (t - 0.5 * RAMP), speed
        left = max(end - t, 0)
        return self.length - 0.5 * speed * left * left / RAMP, speed * left / RAMP


def init(the_robot, task):
    global robot, line
    robot = the_robot
    line = None


def jacobian(robot, q):
    l1, l2 = robot.link_lengths
    upper, fore = q[0], q[0] + q[1]
    s1, c1 = l1 * np.sin(upper), l1 * np.cos(upper)
    s12, c12 = l2 * np.sin(fore), l2 * np.cos(fore)
    return np.array([[-s1 - s12, -s12], [c1 + c12, c12]])


def control(observation):
    global line
    if line is None:
        line = Line(observation.target)
    done, speed = line.progress(observation.time)
    off = line.start + line.along * done - observation.tcp[:2]
    v = line.along * speed + off * GAIN

    # qd = J^T (J J^T + d^2)^-1 v
    J = jacobian(robot, observation.q)
    rate = J.T @ np.linalg.solve(J @ J.T + DAMPED, v)
    return rate * min(1, observation.target.max_rate / max(np.abs(rate).max(), 1e-9))
