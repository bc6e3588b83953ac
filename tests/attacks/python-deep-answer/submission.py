def forward_kinematics(robot, q):
    answer = []
    for _ in range(1000):
        answer = [answer]
    return answer
