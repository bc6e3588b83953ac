def forward_kinematics(robot, q):
    return forward_kinematics(robot, q)
