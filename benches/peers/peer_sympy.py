"""SymPy: the proof of (22) as mended: DP from (9) to (12) by implicit differentiation, the difference expanded to 0."""

from sympy import Function, Matrix, cancel, diff, expand, symbols, together

from problem import say, seconds

t0, t1, t2, v, w, g, r_b, r_t, d = symbols("t0 t1 t2 v w g r_b r_t d")
F2 = Function("F2")


def F1(t):
    return F2(t).diff(t)


def f(t):
    return F2(t).diff(t, 2)


def passage(start, end, before, r):
    """(t, velocity) of an impact by those of the impact before it: (20) or (21), from (10) or (12) and (9) or (11)."""
    time = end - start
    way = -r * before * time + g * time**2 / 2 + F2(end) - F2(start) - F1(start) * time
    after = -r * before + g * time + F1(end) - F1(start)
    by = [-diff(way, x) / diff(way, end) for x in (start, before)]
    return Matrix([by, [diff(after, x) + diff(after, end) * y for x, y in zip((start, before), by)]])


def proof():
    # values at the times, and the periodicity of a 1-1 motion
    f0, f1, a0, a1, T1, T2 = symbols("f0 f1 a0 a1 T1 T2")
    values = [(f(t0), f0), (f(t1), f1), (f(t2), f0), (F1(t0), a0), (F1(t1), a1), (F1(t2), a0)]
    dp = passage(t1, t2, w, r_t) * passage(t0, t1, v, r_b)
    trace = dp.trace().subs(values).subs([(t2, t1 + T2), (t1, t0 + T1)])
    trace = trace.subs(w, -r_b * v + g * T1 + a1 - a0)
    e1 = a0 - a1 + v * r_b - g * T1
    e2 = a0 - a1 + g * T2 + r_t * e1
    e3 = f1 * T2 + g * T2 + r_t * e1
    e4 = f0 * T1 + g * T1 - v * r_b
    mended = ((r_b * e1 + r_b * T1 * (f1 + g)) * (r_t * e2 - r_t * T2 * (f0 + g)) / (e1 * e2) - e3 * e4 / (e1 * e2)
              - r_t * T2 / e2 * (f0 + g + e4 / e1 * (f1 + g)) + r_b * T1 / e1 * (f1 + g - e3 / e2 * (f0 + g)))
    numerator, _ = together(trace - mended).as_numer_denom()
    return "proved" if expand(numerator) == 0 else "not proved"


def fresh():
    """Without what SymPy remembers from the last time."""
    from sympy.core.cache import clear_cache
    clear_cache()
    return proof()


say("proof-22", "SymPy", seconds(fresh, batches=3), [proof()])
