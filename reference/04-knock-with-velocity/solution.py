# The reference solution of lab 4 in Python: the hand goes along each line at the speed asked for and is steered back to the line beside
# it; the inverse of the Jacobian turns the hand's velocity into those of the joints.
import numpy as np

BACK = 6.0  # 1/s: how quickly the hand goes back to the line

robot = None
lines = []  # the end and the direction of each, x and y; the hand is on the first


def init(the_robot, task):
    global robot
    robot = the_robot
    lines.clear()


# Rows x and y of the hand's velocity by the speeds of the two joints.
def jacobian(robot, q):
    l1, l2 = robot.link_lengths
    upper, fore = q[0], q[0] + q[1]
    s1, c1 = l1 * np.sin(upper), l1 * np.cos(upper)
    s12, c12 = l2 * np.sin(fore), l2 * np.cos(fore)
    return np.array([[-s1 - s12, -s12], [c1 + c12, c12]])


def control(observation):
    target = observation.target
    if not lines:
        points = target.points[:, :2]
        for start, end in zip(points, points[1:]):
            lines.append((end, (end - start) / np.linalg.norm(end - start)))

    end, along = lines[0]
    ahead = end - observation.tcp[:2]
    left = np.dot(ahead, along)  # how much of the line lies ahead
    if left <= 0 and len(lines) > 1:
        lines.pop(0)
    beside = ahead - left * along  # from the hand to the line, straight across

    # at the very end the hand comes to rest on the last point
    speed = target.speed if len(lines) > 1 else min(target.speed, BACK * left)
    return np.linalg.solve(jacobian(robot, observation.q), speed * along + BACK * beside)
