def forward_kinematics(robot, q):
    x = 3
    while True:
        x = x * x
