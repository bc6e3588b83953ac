# The reference solution of lab 6 in Python: one walk along the row, from joint to joint, gives the poses; the axes and places of the
# joints that it passes give the Jacobian.
import numpy as np

GAIN = 5.0  # 1/s: a tip that is off comes back with a time constant of 0.2 s


# The joints of the row: whether each turns, and its axis, 0, 1 or 2 for x, y or z.
def joints(robot):
    return [(robot.name[i] == "R", "xyz".index(robot.name[i + 1])) for i in range(0, len(robot.name), 2)]


def shift(p):
    h = np.eye(4)
    h[:3, 3] = p
    return h


# What a joint does when it moves by q: a turn takes the axis after its own towards the one after that.
def motion(turns, axis, q):
    if not turns:
        return shift(q * np.eye(3)[axis])
    second, third = (axis + 1) % 3, (axis + 2) % 3
    h = np.eye(4)
    h[second, second] = h[third, third] = np.cos(q)
    h[third, second] = np.sin(q)
    h[second, third] = -np.sin(q)
    return h


# The frames in which the joints move, one for each, then the last joint after its motion, then the tip.
def frames(robot, q):
    h = shift([0, 0, robot.base_height])
    every = []
    for i, (turns, axis) in enumerate(joints(robot)):
        every.append(h)
        moved = h @ motion(turns, axis, q[i])
        h = moved @ shift(robot[f"link{i + 1}"])
    return every + [moved, h]


def last_joint(robot, q):
    return frames(robot, q)[-2]


def tip(robot, q):
    return frames(robot, q)[-1]


def jacobian(robot, q):
    every = frames(robot, q)
    end = every[-1][:3, 3]
    columns = []
    for (turns, axis), h in zip(joints(robot), every):
        a = h[:3, axis]
        if turns:
            columns.append(np.concatenate([np.cross(a, end - h[:3, 3]), a]))
        else:
            columns.append(np.concatenate([a, np.zeros(3)]))
    return np.array(columns).T


robot = None


def init(the_robot, task):
    global robot
    robot = the_robot


def control(observation):
    target = observation.target
    start = np.array(target["from"])
    line = target.to - start
    length = np.linalg.norm(line)
    along = line / length
    done = min(target.speed * observation.time, length)
    v = (start + along * done - observation.tcp) * GAIN
    if done < length:
        v += along * target.speed
    return np.linalg.solve(jacobian(robot, observation.q)[:3], v)
