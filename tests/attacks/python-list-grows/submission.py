kept = []


def control(observation):
    kept.append([0.0] * 200_000)
    return observation.q
