def forward_kinematics(robot, q):
    return f'{1.0:1000000000}'
