def forward_kinematics(robot, q):
    while True:
        print('x' * 100)
