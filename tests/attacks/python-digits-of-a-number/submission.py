def forward_kinematics(robot, q):
    return str(7**20_000)
