# As somebody writes who comes from robotics: trajectories, gains in matrices, transforms, and the Jacobian by differences.
import math

import numpy as np

KP = np.diag([120.0, 80.0])
KD = np.diag([12, 8])
LIMIT = np.array([30, 15])


class Trajectory:
    def __init__(self, q0, q1, duration):
        self.q0 = np.array(q0, dtype=float)
        self.q1 = np.asarray(q1, dtype=np.float64)
        self.duration = duration

    def __call__(self, t):
        s = np.clip(t / self.duration, 0, 1)
        return self.q0 + quintic(s) * (self.q1 - self.q0), quintic_rate(s) / self.duration * (self.q1 - self.q0)


trajectory = None
integral = np.zeros(2)


def transform(l, a):
    c, s = math.cos(a), math.sin(a)
    return np.array([[c, -s, 0, l * c], [s, c, 0, l * s], [0, 0, 1, 0], [0, 0, 0, 1]])


def forward_kinematics(robot, q):
    T = np.eye(4)
    for l, a in zip(robot.link_lengths, q):
        T = T @ transform(l, a)
    return T[:3, 3]


def inverse_kinematics(robot, position):
    x, y = position[:2]
    l1, l2 = robot.link_lengths
    D = (x * x + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2)
    if D > 1 or D < -1:
        return np.array([])
    solutions = []
    for sign in [-1, 1]:
        t2 = np.arctan2(sign * np.sqrt(1 - D**2), D)
        t1 = np.arctan2(y, x) - np.arctan2(l2 * np.sin(t2), l1 + l2 * np.cos(t2))
        solutions.append(np.array([(t1 + np.pi) % (2 * np.pi) - np.pi, t2]))
    return np.array(solutions)


def jacobian(robot, q):
    eps = 1e-6
    J = np.zeros((3, 2))
    f0 = forward_kinematics(robot, q)
    for i in range(2):
        dq = np.array(q, dtype=float)
        dq[i] += eps
        J[:, i] = (forward_kinematics(robot, dq) - f0) / eps
    return J


def init(robot, task):
    global trajectory, integral
    trajectory = None
    integral = np.zeros(2)


def control(obs):
    global trajectory, integral
    if trajectory is None:
        trajectory = Trajectory(obs.q, [1.0, -0.5], 3.0)
    q_ref, qd_ref = trajectory(obs.time)
    e = q_ref - obs.q
    integral += e * obs.dt
    tau = KP @ e + KD @ (qd_ref - obs.qd) + 0.5 * integral
    plot("e", e)
    if obs.tick % 10 == 0:
        print(f"t={obs.time:.2f} e={e}", np.linalg.norm(e), 1e-6 * e, np.rad2deg(obs.q))
    return np.minimum(np.maximum(tau, -LIMIT), LIMIT).tolist()
