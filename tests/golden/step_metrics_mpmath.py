"""Writes step_metrics_mpmath.json: exact step metrics of PID loops with seeded gains, in 50 digits.

Brackets come from a grid in doubles that is dense for every mode; each is refined by bisection in 50 digits.
"""

import cmath
import json
import random

import mpmath

mpmath.mp.dps = 50
GAINS = [
    # the gains of the virtual-robotics lab, whose peak is too flat for doubles to place
    {"J_kgm2": 1 / 6, "b": 0.7, "Kp": 100.0, "Ki": 0.01, "Kd": 10.0},
    {"J_kgm2": 1 / 6, "b": 0.7, "Kp": 100.0, "Ki": 50.0, "Kd": 10.0},
    # slow and small integral, weak damping, no derivative
    {"J_kgm2": 0.5, "b": 0.1, "Kp": 30.0, "Ki": 0.001, "Kd": 0.0},
    {"J_kgm2": 0.02, "b": 0.001, "Kp": 900.0, "Ki": 0.0005, "Kd": 0.4},
]
random.seed(20)
while len(GAINS) < 24:
    digits = lambda low, high: float(f"{10 ** random.uniform(low, high):.4g}")
    gains = {"J_kgm2": digits(-2, 1), "b": digits(-2, 0.5), "Kp": digits(0, 3), "Ki": digits(-3, 2.5), "Kd": digits(-1, 1.5)}
    if (gains["b"] + gains["Kd"]) * gains["Kp"] > 1.02 * gains["J_kgm2"] * gains["Ki"]:  # Hurwitz
        GAINS.append(gains)


def loops(g):
    j, b, kp, ki, kd = (mpmath.mpf(g[k]) for k in ("J_kgm2", "b", "Kp", "Ki", "Kd"))
    yield "position_pid_D_on_error", [kd, kp, ki], [j, b + kd, kp, ki]
    yield "position_pid_D_on_measurement", [kp, ki], [j, b + kd, kp, ki]
    yield "velocity_pid_D_on_error", [kd, kp, ki], [j + kd, b + kp, ki]
    yield "velocity_pid_D_on_measurement", [kp, ki], [j + kd, b + kp, ki]


def metrics(numerator, denominator):
    poles = mpmath.polyroots(denominator, maxsteps=2000, extraprec=2000)
    slope = [a * (len(denominator) - 1 - k) for k, a in enumerate(denominator[:-1])]
    residues = [mpmath.polyval(numerator, p) / (p * mpmath.polyval(slope, p)) for p in poles]
    sum_of = lambda c, t: sum(a * mpmath.exp(p * t) for a, p in zip(c, poles)).real
    y1 = lambda t: sum_of(residues, t)  # y - 1
    rates = [a * p for a, p in zip(residues, poles)]
    dy = lambda t: sum_of(rates, t)

    grid = {0.0}
    for p in poles:
        last = float(-45 / p.real)
        grid.update(last * 10 ** (-7 * (1 - k / 4000)) for k in range(4001))
        if p.imag > 0:
            grid.update(0.05 * k / float(p.imag) for k in range(min(40000, int(20 * last * p.imag))))
    grid = sorted(grid)

    def fast(c):
        terms = [(complex(a), complex(p)) for a, p in zip(c, poles)]
        return [sum((a * cmath.exp(p * t)).real for a, p in terms) for t in grid]

    def refined(f, k):
        low, high = mpmath.mpf(grid[k]), mpmath.mpf(grid[k + 1])
        sign = f(low) > 0
        if (f(high) > 0) == sign:
            return None  # round-off of the doubles
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if (f(middle) > 0) == sign else (low, middle)
        return low

    def crossings(f, values, level=0.0, last_first=False):
        changes = [k for k in range(len(grid) - 1) if (values[k] > level) != (values[k + 1] > level)]
        times = (refined(f, k) for k in (reversed(changes) if last_first else changes))
        return (t for t in times if t is not None)

    at_start = y1(mpmath.mpf(0)) + 1
    values = fast(residues)

    def first(level):
        if at_start >= level:
            return 0.0
        return next(crossings(lambda t: y1(t) + 1 - level, values, float(level - 1)))

    def settling(band):
        sides = (crossings(lambda t, s=s: y1(t) - s, values, float(s), last_first=True) for s in (band, -band))
        return max(next(side, 0.0) for side in sides)

    tenth = mpmath.mpf(1) / 10
    result = {
        "t10_s": first(tenth),
        "t90_s": first(9 * tenth),
        "settling_time_2pct_s": settling(tenth / 5),
        "settling_time_5pct_s": settling(tenth / 2),
        "value_at_0plus": at_start,
    }
    extrema = [mpmath.mpf(0)]
    for count, t in enumerate(crossings(dy, fast(rates))):
        extrema.append(t)
        if count == 12:
            break
    top = max(extrema, key=y1)
    result["overshoot_pct"] = max(100 * y1(top), mpmath.mpf(0))
    result["peak_time_s"] = top if y1(top) > 0 else None
    result["undershoot_pct"] = max(-100 * min(1 + y1(t) for t in extrema), mpmath.mpf(0))
    return {k: v if v is None else float(v) for k, v in result.items()}


cases = []
for gains in GAINS:
    responses = [{"name": name, **metrics(n, d)} for name, n, d in loops(gains)]
    cases.append({**gains, "responses": responses})
made = {
    "made_by": "step_metrics_mpmath.py",
    "tool": f"mpmath {mpmath.__version__}, 50 digits",
    "units": "s, rad, kg, N m",
    "conventions": "those of B_linear_step.json; gains are the doubles printed here",
    "rel_tolerance": 1e-10,
    "cases": cases,
}
with open("step_metrics_mpmath.json", "w") as file:
    json.dump(made, file, indent=1)
    file.write("\n")
