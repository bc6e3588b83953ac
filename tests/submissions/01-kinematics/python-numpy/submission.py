# As somebody writes who thinks in matrices: homogeneous transforms, numpy throughout, a class whose method is the controller.
import numpy as np


def transform(angle, length):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, length * c], [s, c, length * s], [0, 0, 1]])


def forward_kinematics(robot, q):
    chain = np.eye(3)
    chain[0, 2] = robot.base_height
    for angle, length in zip(q, robot.link_lengths):
        chain = chain @ transform(angle, length)
    return np.append(chain[:2, 2], 2 * robot.link_offset)


def inverse_kinematics(robot, position):
    a, b = robot.link_lengths
    p = position[:2] - np.array([robot.base_height, 0])
    c = (p @ p - a**2 - b**2) / (2 * a * b)
    if not np.isclose(np.clip(c, -1, 1), c, atol=1e-9):
        return []
    elbow = np.arccos(np.clip(c, -1, 1)) * np.array([1, -1])
    shoulder = np.arctan2(p[1], p[0]) - np.arctan2(b * np.sin(elbow), a + b * np.cos(elbow))
    return np.column_stack((shoulder, elbow))


class Arm:
    def __init__(self, robot):
        self.robot = robot
        self.plan = None

    def control(self, observation):
        if self.plan is None:
            first, second = (inverse_kinematics(self.robot, p)[0] for p in observation.target)
            second[0] = first[0] + (second[0] - first[0] + np.pi) % (2 * np.pi) - np.pi
            self.plan = [(0.0, observation.q.copy(), first), (2.5, first, second)]
        began, start, end = self.plan[observation.time >= 2.5]
        return start + quintic((observation.time - began) / 1.6) * (end - start)


def init(robot, task):
    global control
    control = Arm(robot).control
