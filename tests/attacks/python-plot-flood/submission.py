def forward_kinematics(robot, q):
    while True:
        plot('x', 1.0)
