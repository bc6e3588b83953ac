def forward_kinematics(robot, q):
    raise ValueError('x' * 1_000_000)
