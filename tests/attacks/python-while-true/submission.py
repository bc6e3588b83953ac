def forward_kinematics(robot, q):
    x = 0.0
    while True:
        x += 1.0
