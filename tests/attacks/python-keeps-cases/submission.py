seen = [0]


def forward_kinematics(robot, q):
    seen[0] += 1
    assert seen[0] == 1, 'a case knows of another'
    return [0.0, 0.0, 0.0]
