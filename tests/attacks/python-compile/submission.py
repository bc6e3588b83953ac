def forward_kinematics(robot, q):
    return compile('x = 1', 'f', 'exec')
