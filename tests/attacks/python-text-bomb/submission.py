def forward_kinematics(robot, q):
    text = 'x'
    while True:
        text += text
