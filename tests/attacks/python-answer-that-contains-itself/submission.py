def forward_kinematics(robot, q):
    answer = []
    answer.append(answer)
    return answer
