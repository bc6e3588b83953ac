def forward_kinematics(robot, q):
    return [0.0] * 1_000_000
