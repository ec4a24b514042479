"""The problems of `vibro-audit problems`, as far as SciPy answers them: flights by solve_ivp with an event at each wall,
periodic motions by fsolve on the map from impact to impact, derivatives by central differences.

    vibro-audit problems --without-answers | python3 examples/scipy_solver.py > answers.csv
    vibro-audit score answers.csv --summary
    vibro-audit score --exec 'python3 examples/scipy_solver.py' --summary --plot curve.svg

Reads problems from stdin, writes answers to stdout; a tolerance from VIBRO_TOLERANCE. What it cannot do it leaves out:
a motion that comes to rest makes infinitely many impacts, and an event finder stops at the first few of them.
"""

import csv
import os
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

TOLERANCE = max(float(os.environ.get("VIBRO_TOLERANCE", "1e-9")), 3e-14)  # solve_ivp takes no less
LONGEST = 200.0  # no flight is followed for longer
SIDES = {"bottom": 1, "top": -1, "B": 1, "T": -1}


class NoAnswer(Exception):
    """The means does not reach so far."""


def flight(p, phase, start, side, velocity):
    """Time, side and velocity of the impact after one at time `start` with `velocity` just before it."""
    launch = -velocity * (p["r_b"] if side > 0 else p["r_t"])
    half = p["d"] / 2
    bottom = lambda t, y: y[0] - half
    top = lambda t, y: y[0] + half
    bottom.direction, top.direction = 1, -1
    bottom.terminal = top.terminal = True
    # the first step leaves the wall, and is short of all that may happen: a slow ball comes back soon
    first = 0.01 * min(abs(launch) / 2, p["d"] / (1 + abs(launch))) + 1e-12
    found = solve_ivp(
        lambda t, y: (y[1], np.cos(np.pi * t + phase) + p["g"]),
        (start, start + LONGEST),
        (side * half, launch),
        method="DOP853",
        events=(bottom, top),
        rtol=TOLERANCE,
        atol=TOLERANCE * 1e-3,
        first_step=first,
        max_step=0.5,  # a quarter of the forcing period: a longer one may pass a wall and come back
    )
    for wall, times, states in zip((1, -1), found.t_events, found.y_events):
        if len(times) and times[0] > start and states[0][1] * wall > 0:
            return times[0], wall, states[0][1]
    raise NoAnswer


def flights(p, phase, start, side, velocity, count):
    """So many impacts, one after the other."""
    for _ in range(count):
        start, side, velocity = flight(p, phase, start, side, velocity)
        yield start, side, velocity


def derivative(function, at):
    """The Jacobian of a function of two numbers by central differences."""
    columns = []
    for index in range(2):
        step = np.zeros(2)
        step[index] = TOLERANCE ** (1 / 3) * max(abs(at[index]), 0.1)
        columns.append((function(at + step) - function(at - step)) / (2 * step[index]))
    return np.array(columns).T


def cycle(p):
    """The periodic motion near the start given: its impacts, and the derivative of the map over it."""
    word, length = p["word"], 2 * int(p["periods"])

    def after(x):  # time and velocity one cycle later, under cos(pi t)
        *_, (t, side, v) = flights(p, 0.0, x[0], SIDES[word[0]], x[1], len(word))
        return np.array([t, v])

    missed = lambda x: after(x) - x - (length, 0)
    start, info, _, _ = fsolve(missed, (p["phase"] / np.pi, p["velocity"]), xtol=TOLERANCE, full_output=True)
    if max(abs(info["fvec"])) > 1e4 * TOLERANCE:  # its own verdict is too strict where flights are noisy
        raise NoAnswer
    impacts = [(start[0], SIDES[word[0]], start[1]), *flights(p, 0.0, start[0], SIDES[word[0]], start[1], len(word))]
    if [side for _, side, _ in impacts[:-1]] != [SIDES[letter] for letter in word]:
        raise NoAnswer
    return impacts, derivative(after, start)


def voltage(p, speed):
    """(5) to (7): the energy gives the deflection, the deflection the angle of the cap, the angle the area."""
    ball, rim, more = p["ball_radius"], p["membrane_radius"], p["exponent"] + 1
    delta = (more * p["ball_mass"] * speed**2 / (2 * p["stiffness"])) ** (1 / more)
    angle = brentq(lambda a: (ball - delta) * np.cos(a) + rim * np.sin(a) - ball, 0, np.pi / 2, xtol=1e-300)
    cone = (rim**2 - (ball * np.sin(angle)) ** 2) / np.cos(angle)
    return (((2 * ball**2 * (1 - np.cos(angle)) + cone) / rim**2) ** 2 - 1) * p["input_voltage"]


def entries(matrix):
    names = ("dt_dt", "dt_dv", "dv_dt", "dv_dv")
    return dict(zip(names, matrix.ravel()), trace=np.trace(matrix), determinant=np.linalg.det(matrix))


def answers(p):
    """The quantities of a problem; more than it asks for does no harm, they are left out."""
    side = SIDES[p["side"]]
    if p["kind"] == "voltage" and not p["word"]:
        return {"voltage": voltage(p, abs(p["velocity"] * p["velocity_unit"]))}
    if p["word"]:
        impacts, matrix = cycle(p)
        found = entries(matrix)
        for k, ((t, _, v), (after, _, _)) in enumerate(zip(impacts, impacts[1:]), 1):
            found |= {f"phase_{k}": np.pi * t % (2 * np.pi), f"velocity_{k}": v, f"time_{k}": after - t}
        if p["kind"] == "voltage":
            volts = [voltage(p, abs(v * p["velocity_unit"])) for _, _, v in impacts[:-1]]
            found["mean_voltage"] = np.mean(volts)
        return found
    if p["kind"] == "jacobian":
        next_one = lambda x: np.array(flight(p, p["phase"], x[0], side, x[1]))[[0, 2]]
        return entries(derivative(next_one, np.array([0.0, p["velocity"]])))
    if not p["impacts"]:
        raise NoAnswer  # to rest
    *_, (t, _, v) = flights(p, p["phase"], 0.0, side, p["velocity"], int(p["impacts"]))
    return {"time": t, "phase": (p["phase"] + np.pi * t) % (2 * np.pi), "velocity": v}


def main():
    words = ("problem", "kind", "level", "word", "side", "quantity")
    known, out = {}, csv.writer(sys.stdout)
    out.writerow(("problem", "quantity", "answer", "seconds"))
    for row in csv.DictReader(sys.stdin):
        name = row["problem"]
        if name not in known:
            p = {key: text if key in words or not text else float(text) for key, text in row.items()}
            begin = time.perf_counter()
            try:
                found = answers(p)
            except (NoAnswer, ValueError, FloatingPointError) as error:
                print(f"{name}: no answer {error}", file=sys.stderr)
                found = {}
            known[name] = found, time.perf_counter() - begin
        found, seconds = known[name]
        if row["quantity"] in found:
            out.writerow((name, row["quantity"], repr(float(found[row["quantity"]])), f"{seconds:.6f}"))


if __name__ == "__main__":
    main()
