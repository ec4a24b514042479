"""numba: an event loop by hand, as one writes it: steps of 1/20 until the ball is beyond a wall, then bisection and
Newton's method on the flight. No law of rest: where the ball comes to rest, it falls through the wall or stops."""

import math

from numba import njit
from numba.typed import List

from problem import G, GAPS, GUESS, ONE_IMPACT, START, balance, say, seconds

PI = math.pi
balance = njit(balance)


@njit
def flight(s, side, u, sin0, cos0, phase, d):
    """z and its velocity, s after an impact."""
    sin, cos = math.sin(phase + PI * s), math.cos(phase + PI * s)
    z = side * d / 2 + s * (u + G * s / 2 - sin0 / PI) - (cos - cos0) / PI**2
    return z, u + G * s + (sin - sin0) / PI


@njit
def impact(phase, side, velocity, r_b, r_t, d):
    u = -(r_b if side > 0 else r_t) * velocity
    sin0, cos0 = math.sin(phase), math.cos(phase)
    low = 1e-9
    for _ in range(2000):
        high = low + 0.05
        z, v = flight(high, side, u, sin0, cos0, phase, d)
        if abs(z) > d / 2:
            wall = 1.0 if z > 0 else -1.0
            s = high
            for _ in range(60):
                z, v = flight(s, side, u, sin0, cos0, phase, d)
                off = (z - wall * d / 2) * wall
                if off > 0:
                    high = s
                else:
                    low = s
                better = s - off * wall / v
                if abs(better - s) < 1e-14:
                    break
                s = better if low < better < high else (low + high) / 2
            return (phase + PI * s) % (2 * PI), wall, v
        low = high
    return math.nan, side, math.nan


@njit
def impacts(count, phase, velocity, r_b, r_t, d):
    """Phase and velocity after `count` flights, and the fastest of the last 60 impacts."""
    side, fastest = 1.0, 0.0
    for i in range(count):
        phase, side, velocity = impact(phase, side, velocity, r_b, r_t, d)
        if i >= count - 60:
            fastest = max(fastest, abs(velocity))
    return phase, velocity, fastest


@njit
def orbit(phase, t1, d):
    """Newton's method with differences."""
    h = 1e-7
    for _ in range(20):
        a, b, _, _ = balance(phase, t1, d)
        a0, b0, _, _ = balance(phase + h, t1, d)
        a1, b1, _, _ = balance(phase, t1 + h, d)
        j00, j10, j01, j11 = a0 - a, b0 - b, a1 - a, b1 - b
        det = j00 * j11 - j01 * j10
        x, y = h * (j11 * a - j01 * b) / det, h * (j00 * b - j10 * a) / det
        phase, t1 = phase - x, t1 - y
        if abs(x) + abs(y) < 1e-9:
            break
    _, _, v, w = balance(phase, t1, d)
    return phase, t1, v, w


for task, (r_b, r_t, d) in ONE_IMPACT.items():
    spent = seconds(lambda: impacts(10_000, *START, r_b, r_t, d)) / 10_000
    say(task, "numba, scan", spent, impacts(100, *START, r_b, r_t, d)[:2])


@njit
def sweep(gaps):
    return [impacts(499, 6.18, 0.5293, 0.6, 0.3, d)[2] for d in gaps]


gaps = List(GAPS)  # a list that numba knows
say("sweep", "numba, scan", seconds(lambda: sweep(gaps), batches=3), sweep(gaps))


@njit
def orbits(count, phase, t1, d):
    """Many times the same, so that the call from Python does not count."""
    total = 0.0
    for i in range(count):
        total += orbit(phase + i * 1e-18, t1, d)[1]
    return total


say("orbit", "numba", seconds(lambda: orbits(1000, *GUESS, 0.4)) / 1000, orbit(*GUESS, 0.4)[1:])
