"""python-flint (Arb): the 50-digit orbit in ball arithmetic, by Newton's method with differences. The balls
bound the rounding; that there is an orbit within them is not proved."""

from flint import arb, arb_mat, ctx

from problem import ORBIT, balance, say, seconds

ctx.prec = 190
G, D, R, PI = arb("0.12201"), arb("0.4"), arb("0.5"), arb.pi()


def at(phase, t1):
    return balance(phase, t1, D, arb.sin, arb.cos, PI, G, R)


def orbit():
    phase, t1 = (arb(value) for value in ORBIT)
    h = arb("1e-20")
    for _ in range(3):
        (a, b), (a0, b0), (a1, b1) = (at(*point)[:2] for point in ((phase, t1), (phase + h, t1), (phase, t1 + h)))
        step = arb_mat([[a0 - a, a1 - a], [b0 - b, b1 - b]]).solve(arb_mat([[a * h], [b * h]]))
        phase, t1 = (phase - step[0, 0]).mid(), (t1 - step[1, 0]).mid()
    return t1, *at(phase, t1)[2:]


say("orbit-50", "python-flint (Arb)", seconds(orbit), [value.mid().str(52, radius=False) for value in orbit()])
