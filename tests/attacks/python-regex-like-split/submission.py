def forward_kinematics(robot, q):
    text = 'a ' * 1000
    while True:
        text = ' '.join(text.split())
