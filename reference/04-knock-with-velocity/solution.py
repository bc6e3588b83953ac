# The reference solution of lab 4 in Python: the hand goes along each line at the speed asked for and is steered back to the line beside
# it; the inverse of the Jacobian turns the hand's velocity into those of the joints.
import numpy as np

BACK = 6.0  # 1/s: how quickly the hand goes back to the line

state = {}


def init(robot, task):
    state["robot"] = robot
    state["segment"] = 0


# Rows x and y of the hand's velocity by the speeds of the two joints.
def jacobian(robot, q):
    l1, l2 = robot.link_lengths
    s1, c1 = l1 * np.sin(q[0]), l1 * np.cos(q[0])
    s12, c12 = l2 * np.sin(q.sum()), l2 * np.cos(q.sum())
    return np.array([[-s1 - s12, -s12], [c1 + c12, c12]])


def control(observation):
    target = observation.target
    hand = observation.tcp[:2]
    last = len(target.points) - 2
    start, end = target.points[state["segment"], :2], target.points[state["segment"] + 1, :2]
    along = (end - start) / np.linalg.norm(end - start)

    left = np.dot(end - hand, along)  # how much of the line lies ahead
    if left <= 0 and state["segment"] < last:
        state["segment"] += 1
    beside = (end - hand) - left * along  # from the hand to the line, straight across

    # at the very end the hand comes to rest on the last point
    speed = min(target.speed, BACK * left) if state["segment"] == last else target.speed
    return np.linalg.solve(jacobian(state["robot"], observation.q), speed * along + BACK * beside)
