# The same with numpy.
from __future__ import annotations

import numpy as np
from numpy.linalg import norm

START = np.zeros(2)
GOAL = np.array([1.2, -0.8])
KP = np.array([100, 60])
KD = np.array([[10, 0], [0, 6.0]])
DAMPING = 0.05
robot = None
segment = 0
points = [np.array([2.0, 0.5]), np.array([1.5, 0.7])]


def rotation(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def forward_kinematics(robot, q):
    l1, l2 = robot.link_lengths
    T = np.eye(4)
    T[:3, :3] = rotation(q[0]) @ rotation(q[1])
    T[0, 3] = l1 * np.cos(q[0]) + l2 * np.cos(q[0] + q[1])
    T[1, 3] = l1 * np.sin(q[0]) + l2 * np.sin(np.sum(q))
    return T[:3, 3] + np.array([robot.base_height, 0, 2 * robot.link_offset])


def inverse_kinematics(robot, position):
    l1, l2 = robot.link_lengths
    p = np.asarray(position)[:2] - np.array([robot.base_height, 0])
    c = (np.dot(p, p) - l1**2 - l2**2) / (2 * l1 * l2)
    if np.abs(c) > 1:
        return []
    bend = np.arccos(np.clip(c, -1, 1))
    return [
        np.array([np.arctan2(p[1], p[0]) - np.arctan2(l2 * np.sin(b), l1 + l2 * np.cos(b)), b]) for b in (bend, -bend)
    ]


def jacobian(robot, q):
    l1, l2 = robot.link_lengths
    J = np.zeros((3, 2))
    J[0, 0] = -l1 * np.sin(q[0]) - l2 * np.sin(q[0] + q[1])
    J[0, 1] = -l2 * np.sin(q[0] + q[1])
    J[1] = [l1 * np.cos(q[0]) + l2 * np.cos(q[0] + q[1]), l2 * np.cos(q[0] + q[1])]
    return J


def init(the_robot, task):
    global robot
    robot = the_robot


def control(observation):
    global segment
    target = observation.target
    q, qd, tcp = observation.q, observation.qd, observation.tcp
    s = min(observation.time / 2.0, 1.0)
    wanted = START + s * (GOAL - START)
    e = wanted - q
    u = KP * e - KD @ qd
    way = points[1] - points[0]
    along = way / np.linalg.norm(way)
    off = tcp[:2] - points[segment]
    beside = off - np.dot(off, along) * along
    if norm(beside) < 1e-3 and segment < len(points) - 1:
        segment += 1
    J = jacobian(robot, q)[:2]
    rate = J.T @ np.linalg.solve(J @ J.T + DAMPING**2 * np.eye(2), along * 0.1 - 6.0 * beside)
    rate = np.linalg.pinv(J) @ along + np.linalg.inv(J + np.eye(2)) @ along + rate
    if abs(np.linalg.det(J)) < 1e-6 or np.any(np.abs(rate) > 100) or (q < -6.3).all():
        return np.zeros_like(q)
    if observation.tick == 20:
        print("rate", rate, np.round(q, 3), J)
    plot("error", norm(e))
    plot("rate", rate)
    v = np.concatenate([rate, [0.0]])
    k = np.argmax(v)
    n = np.cross(v, np.array([0, 0, 1.0]))[0] + np.max(np.abs(v)) + v.mean() + k + np.sqrt(v @ v) + np.hypot(1, 2)
    places = np.linspace(0, 1, 3)
    _ = np.where(places > 0.5, places, 0.0)[1:].copy() + np.deg2rad(n) * np.pi
    _ = np.maximum(-1, np.minimum(u, 1)) + -u**2 + np.sign(u) + np.array(target["p"] if isinstance(target, dict) else u)
    u[0] = np.clip(u[0], -30, 30)
    u *= 0.5
    return np.clip(u + robot.gravity(q), -np.array([30, 15]), np.array([30, 15]))
