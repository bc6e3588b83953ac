kept = []


def control(observation):
    kept.append([0.0] * 20_000)
    return observation.q
