# Classes, and what goes with them.
import math
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Segment:
    start: np.ndarray
    end: np.ndarray
    speed: float = 0.1
    names: list = field(default_factory=list)

    @property
    def length(self):
        return np.linalg.norm(self.end - self.start)


class Pid:
    """One joint."""

    LIMIT = 30.0

    def __init__(self, kp, kd=1.0, *, ki=0.0):
        self.kp, self.kd, self.ki = kp, kd, ki
        self.sum = 0.0

    def step(self, error, rate, dt):
        self.sum += error * dt
        u = self.kp * error - self.kd * rate + self.ki * self.sum
        return np.clip(u, -self.LIMIT, self.LIMIT)


class Arm(Pid):
    def __init__(self, robot, gains):
        super().__init__(1.0, kd=0.5)
        self.robot = robot
        self.joints = [Pid(kp, kd) for kp, kd in gains]
        self.segments = []
        self.phase = "approach"

    @staticmethod
    def hold(observation):
        return [float(q) for q in observation.q]

    def __call__(self, observation):
        if not self.segments:
            self.segments = [Segment(observation.tcp, observation.tcp + np.array([0, 0.1, 0]))]
        segment = self.segments[-1]
        if self.phase == "approach" and segment.length >= 0.1:
            self.phase = "done"
        elif self.phase not in ("approach", "done"):
            raise ValueError("no phase " + self.phase)
        goal = [0.5, -0.5]
        try:
            extra = self.robot.nothing
        except AttributeError:
            extra = 0.0
        command = []
        for i, (joint, q, qd) in enumerate(zip(self.joints, observation.q, observation.qd)):
            command.append(joint.step(goal[i] - q, qd, observation.dt) + extra)
        order = sorted(range(2), key=lambda i: -abs(command[i]))
        worst, *rest = order
        names = {name: value for name, value in zip(self.robot.joint_names, command)}
        if any(math.isnan(c) for c in names.values()) or all(c == 0 for c in command):
            return self.hold(observation)
        for name, value in names.items():
            if value > 1e6:
                break
        else:
            worst = None if rest else worst
        return tuple(command)


arm = None


def init(robot, task):
    global arm
    arm = Arm(robot, [(100, 10), (60, 6)])


def control(observation):
    return arm(observation)


def forward_kinematics(robot, q):
    return q[2]


def inverse_kinematics(robot, position):
    return postion


def jacobian(robot, q):
    return q @ np.ones((3, 3))
