def forward_kinematics(robot, q):
    kept = {}
    while True:
        kept[len(kept)] = len(kept)
