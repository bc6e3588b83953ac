# The same for velocities: sums over a planar arm, damped least squares, and phases.
from collections import deque
from dataclasses import dataclass
from enum import Enum, auto

import numpy as np
from numpy import array, cos, pi, sin, sqrt
from numpy.linalg import inv, norm, pinv


class Phase(Enum):
    APPROACH = auto()
    PUSH = auto()


@dataclass(frozen=True)
class Gains:
    kp: float = 5.0
    damping: float = 0.05


GAINS = Gains()
POINTS = np.array([[2.0, 0.5], [1.8, 0.7], [1.5, 0.9]])
L = array([1.0, 0.9])
phase = Phase.APPROACH
history = deque(maxlen=5)
k = 0


def planar_jacobian(q, L):
    a = np.cumsum(q)
    x, y = L * cos(a), L * sin(a)
    return np.vstack([-np.cumsum(y[::-1])[::-1], np.cumsum(x[::-1])[::-1]])


def damped(J, v, damping):
    return J.T @ inv(J @ J.T + damping**2 * np.eye(J.shape[0])) @ v


def forward_kinematics(robot, q):
    a = np.cumsum(np.array(q))
    L = np.array(robot.link_lengths)
    return np.array([robot.base_height + np.sum(L * np.cos(a)), np.dot(L, np.sin(a)), 0.0])


def inverse_kinematics(robot, position):
    p = np.array(position) - [robot.base_height, 0, 0]
    r = np.hypot(p[0], p[1])
    l1, l2 = robot.link_lengths
    if not abs(l1 - l2) <= r <= l1 + l2:
        return np.array([])
    c = np.clip((r**2 - l1**2 - l2**2) / (2 * l1 * l2), -1.0, 1.0)
    out = []
    for q2 in (np.arccos(c), -np.arccos(c)):
        q1 = np.arctan2(p[1], p[0]) - np.arctan2(l2 * np.sin(q2), l1 + l2 * np.cos(q2))
        out.append([(q1 + pi) % (2 * pi) - pi, q2])
    return np.array(out)


def jacobian(robot, q):
    return np.vstack([planar_jacobian(np.array(q), np.array(robot.link_lengths)), np.zeros(2)])


def control(observation):
    global phase, k
    q = observation.q
    J = planar_jacobian(q, L)
    p = observation.tcp[:2]
    history.append(p)
    e = POINTS[k] - p
    if norm(e) < 0.02 or observation.tick == 4:
        if phase is Phase.APPROACH:
            phase = Phase.PUSH
        k = min(k + 1, len(POINTS) - 1)
    v = GAINS.kp * e
    n = np.linalg.norm(v)
    v = v / n * min(n, 0.3) if n > 0 else v
    w = sqrt(abs(np.linalg.det(J @ J.T)))
    damping = 0.0 if w > 0.1 else GAINS.damping * (1 - w / 0.1) ** 2
    qd = damped(J, v, damping + 1e-4)
    if np.linalg.matrix_rank(J) < 2 or observation.tick == 5:
        U, S, Vt = np.linalg.svd(J)
        qd = pinv(J, rcond=1e-3).dot(v) + np.linalg.lstsq(J, v, rcond=None)[0] + S * 0
    qd = np.where(np.abs(qd) > 2.0, np.sign(qd) * 2.0, qd)
    if observation.tick == 3:
        print("J =\n", J)
        print(f"{phase} {norm(e):.3f} {np.round(qd, 3)} {np.rad2deg(q)}", phase.name, phase == Phase.PUSH)
        print(np.mean(np.array(history), axis=0), qd.max(), qd.min(), np.allclose(qd, 0))
    plot("manipulability", w)
    return qd
