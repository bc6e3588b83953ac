def forward_kinematics(robot, q):
    return 9**9**9**9
