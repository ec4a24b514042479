"""SciPy: solve_ivp with terminal events for impacts, fsolve for orbits, brentq for the period doubling."""

import math

from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

from problem import (BRACKET, G, GUESS, NEAR_DOUBLING, ONE_IMPACT, START, above_doubling, balance, say, seconds)


def flow(t, x):
    return (x[1], math.cos(math.pi * t) + G)


def impacts(count, r_b, r_t, d):
    """Phase and velocity of the impact after `count` flights. DOP853, rtol 1e-12, atol 1e-14."""

    def bottom(t, x):
        return x[0] - d / 2

    def top(t, x):
        return x[0] + d / 2

    bottom.terminal = top.terminal = True
    bottom.direction, top.direction = 1, -1
    t, side, velocity = START[0] / math.pi, 1, START[1]
    for _ in range(count):
        x = (side * d / 2, -(r_b if side > 0 else r_t) * velocity)
        run = solve_ivp(flow, (t, t + 20), x, method="DOP853", events=(bottom, top), rtol=1e-12, atol=1e-14)
        t, velocity, side = run.t[-1], run.y[1, -1], 1 if len(run.t_events[0]) else -1
    return math.fmod(math.pi * t, 2 * math.pi), velocity


def orbit(guess, d):
    return fsolve(lambda x: balance(x[0], x[1], d)[:2], guess, xtol=1e-12)


def whole():
    phase, t1 = orbit(GUESS, 0.4)
    return t1, *balance(phase, t1, 0.4)[2:]


def doubling():
    near = orbit(NEAR_DOUBLING, 0.26)
    return brentq(lambda d: above_doubling(*orbit(near, d), d), *BRACKET, xtol=1e-11)


def all_orbits():
    """1-1 motions found from 8 x 8 starts; nothing says that these are all."""
    found = set()
    for i in range(8):
        for j in range(8):
            x, _, flag, _ = fsolve(lambda x: balance(x[0], x[1], 0.4)[:2], (0.785 * i, 0.25 * j + 0.125), full_output=True)
            v, w = balance(*x, 0.4)[2:]
            if flag == 1 and 0 < x[1] < 2 and v > 0 > w:
                found.add((round(x[0] % (2 * math.pi), 6), round(x[1], 6)))
    return len(found)


for task, (r_b, r_t, d) in ONE_IMPACT.items():
    spent = seconds(lambda: impacts(100, r_b, r_t, d), batches=2) / 100
    say(task, "SciPy solve_ivp", spent, impacts(100, r_b, r_t, d))
say("orbit", "SciPy fsolve", seconds(whole), whole())
say("doubling", "SciPy brentq + fsolve", seconds(doubling), [doubling()])
say("all-orbits", "SciPy fsolve, 64 starts", seconds(all_orbits), [all_orbits()])
