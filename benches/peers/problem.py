"""What the Python peers share: the parameters, the paper's equations, the clock. Standard library only."""

import math
import time

G = 0.12201  # 0.1245 kg · 9.8 m/s² · sin(pi/6) / 5 N
START = (6.18, 0.5293)  # phase and velocity of an impact at the bottom
ONE_IMPACT = {"impact-focus": (0.5, 0.5, 0.4), "impact-three": (0.6, 0.3, 0.26)}  # r_B, r_T, d
GAPS = [0.1 + 0.001 * i for i in range(401)]  # Fig. 3
ORBIT = (0.4893951147, 1.1165006593)  # phase and T_1 of the stable 1-1 motion of Fig. 2 at d = 0.4, ten digits
GUESS = (0.95 * ORBIT[0], 1.05 * ORBIT[1])
NEAR_DOUBLING = (0.14811268, 1.31700614)  # the same at d = 0.26
BRACKET = (0.245, 0.26)  # of the period doubling


def balance(phase, t1, d, sin=math.sin, cos=math.cos, pi=math.pi, g=G, r=0.5):
    """Residuals of (10) and (12) at a 1-1 motion of r_B = r_T = r, and its velocities by (14) and (9)."""
    t2 = 2 - t1
    s0, c0, s1, c1 = sin(phase), cos(phase), sin(phase + pi * t1), cos(phase + pi * t1)
    rise = g * t1 + (s1 - s0) / pi
    v = (2 * g - (1 + r) * rise) / (1 - r * r)
    w = rise - r * v
    down = t1 * (g * t1 / 2 - r * v - s0 / pi) - (c1 - c0) / pi**2 + d
    up = t2 * (g * t2 / 2 - r * w - s1 / pi) - (c0 - c1) / pi**2 - d
    return down, up, v, w


def above_doubling(phase, t1, d, r=0.5):
    """Tr(DP) + 1 + Det(DP): 0 where the period doubles. (18) with (20) and (21)."""
    _, _, v, w = balance(phase, t1, d)
    t2, a, b = 2 - t1, G + math.cos(phase), G + math.cos(phase + math.pi * t1)
    p, q = (a * t1 - r * v) / w, r * t1 / w
    x, y = (b * t2 - r * w) / v, r * t2 / v
    trace = x * p + y * (b * p - a) + (a * x - b) * q + (a * y - r) * (b * q - r)
    return trace + 1 + r**4


def seconds(job, batches=5, least=0.02):
    """The least mean time of one job, of this thread, over some batches: what else the machine does only adds. First
    a warm run."""
    job()
    repeats = 1
    while True:
        start = time.thread_time()
        for _ in range(repeats):
            job()
        spent = time.thread_time() - start
        if spent >= least:
            break
        repeats *= 2
    times = [spent / repeats]
    for _ in range(batches - 1):
        start = time.thread_time()
        for _ in range(repeats):
            job()
        times.append((time.thread_time() - start) / repeats)
    return min(times)


def say(task, tool, spent, answers):
    """A line for `run`: task, tool, seconds, answers."""
    print(task, tool, f"{spent:.6e}", ";".join(str(answer) for answer in answers), sep="\t", flush=True)
