"""mpmath: the 50-digit orbit by findroot, from ten digits. No bound, no stability, no clearance."""

from mpmath import cos, findroot, mp, mpf, nstr, pi, sin

from problem import ORBIT, balance, say, seconds

mp.dps = 55
D, G, R = mpf("0.4"), mpf("0.12201"), mpf("0.5")


def at(phase, t1):
    return balance(phase, t1, D, sin, cos, +pi, G, R)


def orbit():
    found = findroot(lambda phase, t1: at(phase, t1)[:2], ORBIT, tol=mpf("1e-52") ** 2)
    return found[1], *at(*found)[2:]


say("orbit-50", f"mpmath ({'gmpy2' if mp.mpf('1')._mpf_[1].__class__.__name__ == 'mpz' else 'pure Python'})",
    seconds(orbit), [nstr(value, 52) for value in orbit()])
