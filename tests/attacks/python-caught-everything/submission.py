def forward_kinematics(robot, q):
    while True:
        try:
            raise KeyError
        except BaseException:
            pass
