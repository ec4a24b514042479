#!/usr/bin/env python3
"""Re-checks the stated truth of the attack sheets at 50 digits. Needs mpmath (and Python 3.11 for tomllib).

A sheet stands in CLASS.sheets behind a line `=== NAME`: `# truth: true | false | contradictory | ambiguous | unread` and `# because: ...` (with several claims one
of each for every label: `# truth c2: ...`), then an audit sheet. Truth is that of DESIGN.md. `contradictory`: the premises
have no common solution, so the claim may be neither proved nor refuted. `ambiguous`: of the meanings that
a reader would think of one is true and one false, so that it may be neither too. `unread`: the claim, or a premise that it rests
on, must be refused by the reader. `# points c2: none`: no side has a value anywhere, so that the claim is false. A wrong sheet NAME-wrong is the misprinted or weakened twin of NAME.

    python3 tests/attacks/verify.py            checks all, one line per failure, then a table of counts
    python3 tests/attacks/verify.py -v         also prints the point at which each wrong claim fails
    python3 tests/attacks/verify.py WORD ...   only sheets whose name contains a word

Nothing here parses TeX: each recipe in TABLE was written from the mathematics of its sheet, with the premises solved by
hand. The truth that is tested stands in the sheet (`# truth: ...`). A recipe is a list of steps parted by `;`:

    x y                     draw real numbers, of both signs, some of them small integers (0 among them)
    x y > 0, x >= 0         draw positive numbers, numbers that are not negative
    x in (a, b)             draw from an open interval; a and b are expressions
    n int, s sign           draw an integer of -6..6, a sign
    z complex               draw a complex number; the recipe is then read with principal branches
    w := expression         a premise solved for w, or a coordinate of a counterexample
    f(t) := expression      a function; D(f, t) is its derivative, D2(f, t) its second
    if condition            otherwise drawn anew (`assume`, or where everything is defined)
    given a = b             a premise as it stands, asserted at the point
    claim a = b             the claim; also <, <=, >, >=

A claim is `true` here when it holds at POINTS random points (points where something is not defined over the reals are
drawn anew), `false` when some point is found at which every `given` holds and the claim is defined and fails, or, with
`nowhere`, when none of the drawn points has the claim defined. Sheets without a recipe rest on their `# because:`.
"""

import random
import re
import sys
import tomllib
from collections import Counter
from pathlib import Path

import mpmath
from mpmath import mp, mpc, mpf

mp.dps = 70
TOLERANCE = mpf(10) ** -45  # relative to the size of the sides; 50 digits of 70, less what cancels
POINTS = 25
HERE = Path(__file__).resolve().parent


class Undefined(Exception):
    """Something written is not defined at this point."""


def real_only(function, admits):
    def wrapped(x):
        if isinstance(x, mpc) or not admits(x):
            raise Undefined
        return function(x)

    return wrapped


def quotient(numerator, denominator):
    if abs(denominator) < mpf(10) ** -60:
        raise Undefined
    return numerator / denominator


BOTH = {
    "sin": mp.sin, "cos": mp.cos, "exp": mp.exp, "sinh": mp.sinh, "cosh": mp.cosh, "tanh": mp.tanh,
    "tan": lambda x: quotient(mp.sin(x), mp.cos(x)), "cot": lambda x: quotient(mp.cos(x), mp.sin(x)),
    "sec": lambda x: quotient(mpf(1), mp.cos(x)), "csc": lambda x: quotient(mpf(1), mp.sin(x)),
    "pi": mp.pi, "abs": abs, "mpf": mpf, "D": lambda f, x: mp.diff(f, x), "D2": lambda f, x: mp.diff(f, x, 2),
    "integral": lambda f, a, b: mp.quad(f, mp.linspace(a, b, 9)), "erf": mp.erf, "floor": mp.floor,
}
REAL = {
    "sqrt": real_only(mp.sqrt, lambda x: x >= 0), "ln": real_only(mp.log, lambda x: x > 0),
    "cbrt": lambda x: mp.cbrt(x) if x >= 0 else -mp.cbrt(-x),
    "root": lambda n, x: mp.root(x, int(n)) if x >= 0 else (-mp.root(-x, int(n)) if int(n) % 2 else undefined()),
    "asin": real_only(mp.asin, lambda x: abs(x) <= 1), "acos": real_only(mp.acos, lambda x: abs(x) <= 1),
    "atan": mp.atan, "power": lambda x, a: mp.power(x, a) if x > 0 or (x == 0 and a > 0) else undefined(),
}
COMPLEX = {
    "sqrt": mp.sqrt, "ln": mp.log, "I": mpc(0, 1), "conj": mp.conj, "re": mp.re, "im": mp.im, "asin": mp.asin,
    "acos": mp.acos, "atan": mp.atan, "power": mp.power,
}


def undefined():
    raise Undefined


def exact(expression):
    """The expression with its numbers as mpf, so that 1/3 has all digits."""
    return re.sub(r"(?<![\w.])(\d+(?:\.\d+)?)", r"mpf('\1')", expression)


def drawn(low=-4, high=4):
    if random.random() < 0.2:
        return mpf(random.randint(int(low) + 0, int(high)))
    return low + (high - low) * mpf(random.getrandbits(200)) / mpf(2) ** 200


def compare(text, point):
    """Whether a comparison holds, with the difference of its sides."""
    left, relation, right = re.split(r"\s(<=|>=|=|<|>)\s", text)
    a, b = (eval(exact(side), point) for side in (left, right))
    if "I" not in point and (isinstance(a, mpc) or isinstance(b, mpc)):
        raise Undefined
    near = abs(a - b) <= TOLERANCE * (1 + abs(a) + abs(b))
    if relation == "=":
        return near, a - b
    less = (a < b) and not near
    return {"<": less, "<=": less or near, ">": not less and not near, ">=": not less or near}[relation], a - b


def step(text, point):
    """One step of a recipe; the result is None, or what the claim came to."""
    if text.startswith("if "):
        if not eval(exact(text[3:]), point):
            raise Undefined
    elif text.startswith("given "):
        holds, difference = compare(text[6:], point)
        assert holds, f"the premise {text[6:]} fails by {mp.nstr(difference, 5)}"
    elif text.startswith("claim "):
        return compare(text[6:], point)
    elif found := re.fullmatch(r"(\w+)\((\w+(?:, ?\w+)*)\) := (.*)", text):
        name, argument, body = found.groups()
        point[name] = eval(f"lambda {argument}: {exact(body)}", point)
    elif ":=" in text:
        name, body = text.split(":=")
        point[name.strip()] = +eval(exact(body.strip()), point)
    elif found := re.fullmatch(r"(\w+) in \((.*), (.*)\)", text):
        name, low, high = found.groups()
        low, high = eval(exact(low), point), eval(exact(high), point)
        point[name] = low + (high - low) * mpf(random.getrandbits(200) + 1) / (mpf(2) ** 200 + 2)
    else:
        names, kind = re.fullmatch(r"([\w ]+?)((?: int| sign| complex| > 0| >= 0)?)", text).groups()
        for name in names.split():
            point[name] = {
                "": drawn,
                " int": lambda: mpf(random.randint(-6, 6)),
                " sign": lambda: mpf(random.choice([-1, 1])),
                " complex": lambda: mpc(drawn(), drawn()),
                " > 0": lambda: abs(drawn()) + mpf(1) / 64,
                " >= 0": lambda: abs(drawn()),
            }[kind]()
    return None


def one_point(recipe):
    """The recipe at one drawn point: the names with their values, whether the claim holds, and the difference."""
    complex_numbers = re.search(r" complex\b|\bI\b", recipe)
    tools = BOTH | REAL | (COMPLEX if complex_numbers else {})
    point = dict(tools)
    outcome = None
    for text in (part.strip() for part in recipe.split(";")):
        outcome = step(text, point) or outcome
    values = {n: v for n, v in point.items() if n not in tools and n != "__builtins__" and not callable(v)}
    return values, outcome


def check(recipe, truth):
    """An error message, or the counterexample found (for a wrong claim), or nothing."""
    nowhere = recipe.startswith("nowhere;")
    recipe = recipe.removeprefix("nowhere;").strip()
    fixed = not re.search(r"(^|;)\s*[\w ]+( > 0| >= 0)?\s*(;|$)| in \(", recipe)
    defined = 0
    for _ in range(3000 if not fixed else 1):
        try:
            values, (holds, difference) = one_point(recipe)
        except (Undefined, ZeroDivisionError):
            continue
        defined += 1
        shown = ", ".join(f"{n} = {mp.nstr(v, 8)}" for n, v in values.items())
        if nowhere:
            return f"is defined at {shown}", None
        if truth == "false" and not holds:
            return None, f"{shown}: the sides differ by {mp.nstr(difference, 8)}"
        if truth == "true" and not holds:
            return f"fails at {shown} by {mp.nstr(difference, 8)}", None
        if truth == "true" and (fixed or defined >= POINTS):
            return None, None
    if nowhere:
        return None, "defined nowhere"
    return ("no counterexample found" if truth == "false" else f"only {defined} points"), None


TABLE = {
    # false-proofs
    "false-proofs/root-in-law":
        "a b; f(t) := sqrt(1+t**2); claim f(b)**2-f(a)**2 = b**2-a**2",
    "false-proofs/root-in-law-wrong":
        "a := 0; b := 1; f(t) := sqrt(1+t**2); claim f(a) = f(b)",
    "false-proofs/cosine-of-root-in-law":
        "a >= 0; f(t) := cos(sqrt(t)); claim f(a)**2+sin(sqrt(a))**2 = 1",
    "false-proofs/cosine-of-root-in-law-wrong":
        "a := 0; b := 1; f(t) := cos(sqrt(t)); claim f(a) = f(b)",
    "false-proofs/root-law-derivative":
        "a; F(t) := sqrt(1+t**2); claim D(F,a)*F(a) = a",
    "false-proofs/root-law-derivative-wrong":
        "a := 1; F(t) := sqrt(1+t**2); claim D(F,a) = 0",
    "false-proofs/product-of-roots":
        "a b >= 0; claim sqrt(a)*sqrt(b) = sqrt(a*b)",
    "false-proofs/product-of-roots-wrong":
        "a := -1; b := 1; claim sqrt(a**2*b) = a*sqrt(b)",
    "false-proofs/roots-of-negatives-by-square":
        "u v; a := u**2; b := v**2; claim (u*v)**2 = a*b",
    "false-proofs/roots-of-negatives-by-square-wrong":
        "u := 1; v := -1; a := 1; b := 1; given u**2 = a; claim u*v = sqrt(a*b)",
    "false-proofs/quotient-of-roots":
        "a >= 0; b > 0; claim sqrt(a/b)*sqrt(b) = sqrt(a)",
    "false-proofs/quotient-of-roots-wrong":
        "a := -1; b := -1; claim sqrt(a/b) = sqrt(a*b)/b",
    "false-proofs/vanishing-square-factor":
        "x u; y := x; v := u + 1; given (x-y)**2*u = (x-y)**2*v; claim (x-y)*u = (x-y)*v",
    "false-proofs/vanishing-square-factor-wrong":
        "x := 0; y := 0; u := 0; v := 1; given (x-y)**2*u = (x-y)**2*v; claim u = v",
    "false-proofs/vanishing-factor-generic":
        "x y u; if x != y; v := u; claim u = v",
    "false-proofs/vanishing-factor-half-generic":
        "x := 1; u := 0; v := 1; w := 2; given u*v = u*w; claim v = w",
    "false-proofs/vanishing-factor-nonzero":
        "a u; if a != 0; v := u; claim u = v",
    "false-proofs/vanishing-factor-plain":
        "a := 0; u := 0; v := 1; given a*u = a*v; claim u = v",
    "false-proofs/factor-in-denominator":
        "u a; v := u; if a != 0; given u/a = v/a; claim u = v",
    "false-proofs/vanishing-cosine":
        "t u; v := u; claim (u-v)**2*cos(t) = 0",
    "false-proofs/vanishing-cosine-wrong":
        "t := pi/2; u := 0; v := 1; given u*cos(t) = v*cos(t); claim u = v",
    "false-proofs/vanishing-exponential":
        "x u; v := u; given u*exp(x) = v*exp(x); claim u = v",
    "false-proofs/vanishing-exponential-wrong":
        "x := 0; u := 0; v := 1; given u*(exp(x)-1) = v*(exp(x)-1); claim u = v",
    "false-proofs/sum-of-squares-factor":
        "x y u; v := u; claim u = v",
    "false-proofs/sum-of-squares-factor-wrong":
        "x := 0; y := 0; u := 0; v := 1; given (x**2+y**2)*u = (x**2+y**2)*v; claim u = v",
    "false-proofs/square-then-root":
        "x >= 0; y := x; given x**2 = y**2; claim x = y",
    "false-proofs/square-then-root-wrong":
        "x := 1; y := -1; given x**2 = y**2; claim x = y",
    "false-proofs/cube-then-root":
        "x; y := x; claim x = y",
    "false-proofs/cube-then-root-wrong":
        "x := 1; y := -1; given x**4 = y**4; claim x = y",
    "false-proofs/sines-equal":
        "y; n int; x := y + 2*pi*n; given sin(x) = sin(y); given cos(x) = cos(y); claim sin(2*x) = sin(2*y)",
    "false-proofs/sines-equal-wrong":
        "x := 2*pi; y := 0; given sin(x) = sin(y); given cos(x) = cos(y); claim x = y",
    "false-proofs/zero-product":
        "a; b := 0; c := 0; claim a*b*c = 0",
    "false-proofs/zero-product-wrong":
        "a := 1; b := 0; c := 0; given a*b = 0; given b*c = 0; claim a + b = 0",
    "false-proofs/solved-for-twice":
        "a; x := 0; y := 0; claim (a**2-1)*x = 0",
    "false-proofs/solved-for-twice-wrong":
        "a := 2; x := 0; y := 0; given a*x = y; given a*y = x; claim a**2 = 1",
    "false-proofs/divided-by-its-own-claim":
        "x; y := x; claim x**3 = x*y**2",
    "false-proofs/divided-by-its-own-claim-wrong":
        "x := 0; y := 1; given x**2 = x*y; claim x = y",
    "false-proofs/integer-root":
        "n int; s sign; m := s*n; claim n**4 = m**4",
    "false-proofs/integer-root-wrong":
        "n := 1; m := -1; given n**2 = m**2; claim n = m",
    # roots
    "roots/denest-two":
        "claim sqrt(3+2*sqrt(2)) = 1+sqrt(2)",
    "roots/denest-two-wrong":
        "claim sqrt(3+sqrt(2)) = 1+4/5*sqrt(2)",
    "roots/denest-minus":
        "claim sqrt(3-2*sqrt(2)) = sqrt(2)-1",
    "roots/denest-minus-wrong":
        "claim sqrt(3-2*sqrt(2)) = 1-sqrt(2)",
    "roots/denest-five":
        "claim sqrt(5+2*sqrt(6)) = sqrt(2)+sqrt(3)",
    "roots/denest-five-wrong":
        "claim sqrt(5+2*sqrt(5)) = sqrt(2)+sqrt(3)",
    "roots/golden-cube-roots":
        "claim cbrt(2+sqrt(5))+cbrt(2-sqrt(5)) = 1",
    "roots/golden-cube-roots-wrong":
        "claim cbrt(2+sqrt(5))-cbrt(2-sqrt(5)) = 1",
    "roots/cube-root-odd":
        "x; claim cbrt(-x) = -cbrt(x)",
    "roots/cube-root-odd-wrong":
        "x := 8; claim cbrt(x**2) = x",
    "roots/cube-root-of-cube":
        "x; claim cbrt(x**3) = x",
    "roots/cube-root-of-cube-wrong":
        "x := -1; claim root(4,x**4) = x",
    "roots/cube-root-product":
        "x y; claim cbrt(x*y) = cbrt(x)*cbrt(y)",
    "roots/cube-root-product-wrong":
        "x := 1; y := 1; claim cbrt(x+y) = cbrt(x)+cbrt(y)",
    "roots/third-power":
        "x >= 0; claim power(x,1/3)*power(x,2/3) = x",
    "roots/third-power-wrong":
        "x := 8; claim power(x,1/3)*power(x,1/3) = x",
    "roots/third-power-is-cube-root":
        "x >= 0; claim power(x,1/3) = cbrt(x)",
    "roots/cube-root-abs":
        "x := -1; claim abs(x)*cbrt(x) = x*cbrt(abs(x))+1",
    "roots/cube-root-abs-true":
        "x; claim abs(x)*cbrt(x) = x*cbrt(abs(x))",
    "roots/root-of-square":
        "x >= 0; claim sqrt(x**2) = x",
    "roots/root-of-square-wrong":
        "x := -1; claim sqrt(x**2) = x",
    "roots/root-of-square-abs":
        "x y; claim sqrt(x**2*y**2) = abs(x*y)",
    "roots/root-of-square-abs-wrong":
        "x := -1; y := 1; claim sqrt(x**2*y**2) = x*abs(y)",
    "roots/sum-of-roots-squared":
        "a b >= 0; claim (sqrt(a)+sqrt(b))**2 = a+b+2*sqrt(a*b)",
    "roots/sum-of-roots-squared-wrong":
        "a := 1; b := 1; claim sqrt(a)+sqrt(b) = sqrt(a+b)",
    "roots/rationalised":
        "x y >= 0; if x != y; claim 1/(sqrt(x)-sqrt(y)) = (sqrt(x)+sqrt(y))/(x-y)",
    "roots/rationalised-wrong":
        "x := 4; y := 1; claim 1/(sqrt(x)-sqrt(y)) = (sqrt(x)+sqrt(y))/(x+y)",
    "roots/nested-parameter":
        "b d > 0; a := b + d; claim sqrt(a+b+2*sqrt(a*b)) = sqrt(a)+sqrt(b)",
    "roots/nested-parameter-wrong":
        "b := 1; a := 4; given a > b; claim sqrt(a+b-2*sqrt(a*b)) = sqrt(b)-sqrt(a)",
    "roots/nested-minus-abs":
        "a b >= 0; claim sqrt(a+b-2*sqrt(a*b)) = abs(sqrt(a)-sqrt(b))",
    "roots/nested-minus-abs-wrong":
        "a := 1; b := 4; claim sqrt(a+b-2*sqrt(a*b)) = sqrt(a)-sqrt(b)",
    "roots/nested-minus-negatives":
        "a := -1; b := -4; claim sqrt(a+b+2*sqrt(a*b)+2) = sqrt(abs(a))+sqrt(abs(b))-1",
    "roots/fourth-root":
        "x >= 0; claim sqrt(sqrt(x)) = root(4,x)",
    "roots/fourth-root-wrong":
        "x := 64; claim sqrt(sqrt(x)) = cbrt(x)",
    "roots/cos-pi-over-five-root":
        "claim sqrt(6-2*sqrt(5)) = sqrt(5)-1",
    "roots/cos-pi-over-five-root-wrong":
        "claim sqrt(6+2*sqrt(5)) = sqrt(5)-1",
    "roots/near-integer":
        "claim sqrt(10)+sqrt(17) < sqrt(5)+sqrt(29)",
    "roots/near-integer-wrong":
        "claim sqrt(11)+sqrt(5)+1/2000 = sqrt(2964567/96123)",
    "roots/shanks":
        "claim sqrt(5)+sqrt(22+2*sqrt(5)) = sqrt(11+2*sqrt(29))+sqrt(16-2*sqrt(29)+2*sqrt(55-10*sqrt(29)))",
    "roots/shanks-wrong":
        "claim sqrt(5)+sqrt(22+2*sqrt(5)) = sqrt(11+2*sqrt(29))+sqrt(16-2*sqrt(29)+2*sqrt(55-9*sqrt(29)))",
    "roots/premise-root-solved":
        "x >= 0; y := sqrt(x); claim x = y**2",
    "roots/premise-square-solved":
        "y := -1; x := 1; given x = y**2; claim y = sqrt(x)",
    "roots/depressed-cubic":
        "p > 0; q; R := sqrt(q**2/4+p**3/27); x := cbrt(q/2+R)+cbrt(q/2-R); claim x**3+p*x = q",
    "roots/depressed-cubic-where":
        "p > 0; q; R := sqrt(q**2/4+p**3/27); x := cbrt(q/2+R)+cbrt(q/2-R); claim x**3+p*x = q",
    "roots/depressed-cubic-where-wrong":
        "p := 1; q := 1; R := sqrt(q**2/4+p**3/9); x := cbrt(q/2+R)+cbrt(q/2-R); claim x**3+p*x = q",
    # angles
    "angles/cos-pi-3":
        "claim cos(pi/3) = 1/2",
    "angles/cos-pi-3-wrong":
        "claim cos(pi/3) = sqrt(3)/2",
    "angles/cos-pi-5":
        "claim cos(pi/5) = (1+sqrt(5))/4",
    "angles/cos-pi-5-wrong":
        "claim cos(2*pi/5) = (1+sqrt(5))/4",
    "angles/sin-pi-12":
        "claim sin(pi/12) = (sqrt(6)-sqrt(2))/4",
    "angles/sin-pi-12-wrong":
        "claim sin(pi/12) = (sqrt(6)+sqrt(2))/4",
    "angles/tan-pi-8":
        "claim tan(pi/8) = sqrt(2)-1",
    "angles/tan-pi-8-wrong":
        "claim tan(pi/8) = sqrt(2)+1",
    "angles/heptagon":
        "claim cos(pi/7)-cos(2*pi/7)+cos(3*pi/7) = 1/2",
    "angles/heptagon-wrong":
        "claim cos(pi/7)+cos(2*pi/7)-cos(3*pi/7) = 1/2",
    "angles/morrie":
        "claim cos(pi/9)*cos(2*pi/9)*cos(4*pi/9) = 1/8",
    "angles/morrie-wrong":
        "claim cos(pi/9)*cos(2*pi/9)*cos(3*pi/9) = 1/8",
    "angles/tan-product":
        "claim tan(pi/7)*tan(2*pi/7)*tan(3*pi/7) = sqrt(7)",
    "angles/tan-product-wrong":
        "claim tan(pi/7)*tan(2*pi/7)*tan(3*pi/7) = 37/14",
    "angles/sin-seventeen":
        "claim sin(17*pi/6) = 1/2",
    "angles/sin-seventeen-wrong":
        "claim sin(-17*pi/6) = 1/2",
    "angles/half-cosine":
        "x; claim 2*cos(x/2)**2 = 1+cos(x)",
    "angles/half-cosine-wrong":
        "x := 2*pi; claim cos(x/2) = sqrt((1+cos(x))/2)",
    "angles/half-sine":
        "x; claim abs(sin(x/2)) = sqrt((1-cos(x))/2)",
    "angles/half-sine-wrong":
        "x := -pi; claim sin(x/2) = sqrt((1-cos(x))/2)",
    "angles/half-tangent":
        "x; claim tan(x/2) = sin(x)/(1+cos(x))",
    "angles/half-tangent-wrong":
        "x := pi/3; claim tan(x/2) = (1+cos(x))/sin(x)",
    "angles/half-tangent-substitution":
        "x; claim sin(x) = 2*tan(x/2)/(1+tan(x/2)**2)",
    "angles/half-tangent-substitution-wrong":
        "x := pi/3; claim sin(x) = 2*tan(x/2)/(1-tan(x/2)**2)",
    "angles/triple":
        "x; claim sin(3*x) = 3*sin(x)-4*sin(x)**3",
    "angles/triple-wrong":
        "x := pi/6; claim sin(3*x) = 4*sin(x)-3*sin(x)**3",
    "angles/quintuple":
        "x; claim cos(5*x) = 16*cos(x)**5-20*cos(x)**3+5*cos(x)",
    "angles/quintuple-wrong":
        "x := 0; claim cos(5*x) = 16*cos(x)**5-20*cos(x)**3-5*cos(x)",
    "angles/half-and-triple":
        "x; claim sin(3*x/2) = sin(x/2)*(1+2*cos(x))",
    "angles/half-and-triple-wrong":
        "x := pi/3; claim sin(3*x/2) = sin(x/2)*(1-2*cos(x))",
    "angles/sum-to-product":
        "x y; claim sin(x)+sin(y) = 2*sin((x+y)/2)*cos((x-y)/2)",
    "angles/sum-to-product-wrong":
        "x := 0; y := pi/2; claim sin(x)+sin(y) = 2*cos((x+y)/2)*sin((x-y)/2)",
    "angles/product-to-sum":
        "x y; claim 2*sin(x)*sin(y) = cos(x-y)-cos(x+y)",
    "angles/product-to-sum-wrong":
        "x := pi/2; y := pi/2; claim 2*sin(x)*sin(y) = cos(x+y)-cos(x-y)",
    "angles/tan-addition":
        "x y; claim tan(x+y) = (tan(x)+tan(y))/(1-tan(x)*tan(y))",
    "angles/tan-addition-wrong":
        "x := pi/6; y := pi/6; claim tan(x+y) = (tan(x)+tan(y))/(1+tan(x)*tan(y))",
    "angles/plus-minus":
        "x y; claim cos(x+y) = cos(x)*cos(y)-sin(x)*sin(y)",
    "angles/plus-minus-wrong":
        "x := pi/2; y := pi/2; claim cos(x+y) = cos(x)*cos(y)+sin(x)*sin(y)",
    "angles/shift-by-thirds":
        "x; claim cos(x)+cos(x+2*pi/3)+cos(x-2*pi/3) = 0",
    "angles/shift-by-thirds-wrong":
        "x := 0; claim cos(x)+cos(x+pi/3)+cos(x-pi/3) = 0",
    "angles/quarter-shift":
        "x; claim sin(x)+cos(x) = sqrt(2)*sin(x+pi/4)",
    "angles/quarter-shift-wrong":
        "x := 0; claim sin(x)+cos(x) = 2*sin(x+pi/4)",
    "angles/integer-shift":
        "x; n int; claim cos(x+pi*n) = (-1)**n*cos(x)",
    "angles/integer-shift-wrong":
        "x := 0; n := 1; claim cos(x+pi*n) = cos(x)",
    "angles/commensurable":
        "x; claim cos(x/3)**3 = 3/4*cos(x/3)+1/4*cos(x)",
    "angles/commensurable-wrong":
        "x := pi; claim cos(x/3)**3 = 1/4*cos(x/3)+3/4*cos(x)",
    "angles/secant":
        "x; claim sec(x)**2 = 1+tan(x)**2",
    "angles/secant-wrong":
        "x := pi/3; claim csc(x)**2 = 1+tan(x)**2",
    "angles/cot-double":
        "x; claim cot(2*x) = (cot(x)**2-1)/(2*cot(x))",
    "angles/cot-double-wrong":
        "x := pi/6; claim cot(2*x) = (cot(x)**2+1)/(2*cot(x))",
    "angles/double-premise":
        "p; t := 2*p; claim sin(t) = 2*sin(p)*cos(p)",
    "angles/double-premise-wrong":
        "p := 0; t := 0; given t = 2*p; claim cos(t) = 2*cos(p)",
    "angles/triangle-sum":
        "A B; C := pi-A-B; claim tan(A)+tan(B)+tan(C) = tan(A)*tan(B)*tan(C)",
    "angles/triangle-sum-wrong":
        "A := pi/2; B := pi/2; C := 0; given A+B+C = pi; claim sin(A)+sin(B)+sin(C) = 4*sin(A/2)*sin(B/2)*sin(C/2)",
    "angles/triangle-half":
        "A B; C := pi-A-B; claim sin(A)+sin(B)+sin(C) = 4*cos(A/2)*cos(B/2)*cos(C/2)",
    "angles/triangle-half-wrong":
        "A := pi/3; B := pi/3; C := pi/3; given A+B+C = pi; claim cos(A)+cos(B)+cos(C) = 1-4*sin(A/2)*sin(B/2)*sin(C/2)",
    "angles/complement-premise":
        "t; p := pi/2-t; claim sin(t)**2+sin(p)**2 = 1",
    "angles/complement-premise-wrong":
        "t := 0; p := pi/2; given t+p = pi/2; claim sin(t) = sin(p)",
    "angles/value-premise":
        "n int; x := asin(3/5)+2*pi*n; claim cos(2*x) = 7/25",
    "angles/value-premise-wrong":
        "x := pi-asin(3/5); given sin(x) = 3/5; claim cos(x) = 4/5",
    "angles/power-after-bracket":
        "x; claim sin(pi*x)**2+cos(pi*x)**2 = 1",
    # exp-log
    "exp-log/exp-sum":
        "x y; claim exp(x+y) = exp(x)*exp(y)",
    "exp-log/exp-sum-wrong":
        "x := 0; y := 0; claim exp(x+y) = exp(x)+exp(y)",
    "exp-log/ln-product":
        "x y > 0; claim ln(x)+ln(y) = ln(x*y)",
    "exp-log/ln-product-wrong":
        "x := 1; y := 1; claim ln(x)*ln(y) = ln(x+y)",
    "exp-log/ln-square":
        "x; if x != 0; claim ln(x**2) = 2*ln(abs(x))",
    "exp-log/ln-square-wrong":
        "x := 1; claim ln(x**2+1) = 2*ln(abs(x))",
    "exp-log/ln-square-plain":
        "x > 0; claim ln(x**2) = 2*ln(x)",
    "exp-log/ln-of-exp":
        "x; claim ln(exp(x)) = x",
    "exp-log/exp-of-ln":
        "x > 0; claim exp(ln(x)) = x",
    "exp-log/exp-of-half-ln-square":
        "x := -1; claim exp(ln(x**2)/2) = x",
    "exp-log/real-power":
        "x > 0; a b; claim power(x,a)*power(x,b) = power(x,a+b)",
    "exp-log/real-power-wrong":
        "x := 1; a := 0; b := 0; claim power(x,a)+power(x,b) = power(x,a+b)",
    "exp-log/power-of-power":
        "x > 0; a b; claim power(power(x,a),b) = power(x,a*b)",
    "exp-log/power-of-power-wrong":
        "x := 2; a := 1; b := 1; claim power(power(x,a),b) = power(x,a+b)",
    "exp-log/power-is-exp-ln":
        "x > 0; a; claim power(x,a) = exp(a*ln(x))",
    "exp-log/power-is-exp-ln-wrong":
        "x := 1; a := 2; claim power(x,a) = exp(x*ln(a))",
    "exp-log/cosh-sinh":
        "x; claim cosh(x)**2-sinh(x)**2 = 1",
    "exp-log/cosh-sinh-wrong":
        "x := 1; claim cosh(x)**2+sinh(x)**2 = 1",
    "exp-log/sinh-exp":
        "x; claim sinh(x) = (exp(x)-exp(-x))/2",
    "exp-log/sinh-exp-wrong":
        "x := 0; claim sinh(x) = (exp(x)+exp(-x))/2",
    "exp-log/tanh-addition":
        "x y; claim tanh(x+y) = (tanh(x)+tanh(y))/(1+tanh(x)*tanh(y))",
    "exp-log/tanh-addition-wrong":
        "x := 1; y := 1; claim tanh(x+y) = (tanh(x)+tanh(y))/(1-tanh(x)*tanh(y))",
    "exp-log/half-cosh":
        "x; claim cosh(x/2) = sqrt((cosh(x)+1)/2)",
    "exp-log/half-cosh-wrong":
        "x := -2; claim sinh(x/2) = sqrt((cosh(x)-1)/2)",
    "exp-log/tanh-exp":
        "x; claim tanh(x) = (exp(2*x)-1)/(exp(2*x)+1)",
    "exp-log/tanh-exp-wrong":
        "x := 1; claim tanh(x) = (exp(x)-1)/(exp(x)+1)",
    "exp-log/logistic":
        "x; claim 1/(1+exp(-x))+1/(1+exp(x)) = 1",
    "exp-log/logistic-wrong":
        "x := 0; claim 1/(1+exp(-x))-1/(1+exp(x)) = 1",
    "exp-log/decay-premise":
        "x > 0; a; y := x*exp(-a); claim a = ln(x)-ln(y)",
    "exp-log/decay-premise-wrong":
        "x := 1; a := 1; y := exp(-1); given y = x*exp(-a); claim a = ln(y)-ln(x)",
    "exp-log/exp-injective":
        "x; y := x; claim x = y",
    "exp-log/exp-injective-wrong":
        "x := 1; y := 1; given exp(x) = exp(y); claim x = -y",
    "exp-log/cosh-not-injective":
        "x; s sign; y := s*x; given cosh(x) = cosh(y); claim x**2 = y**2",
    "exp-log/cosh-not-injective-wrong":
        "x := 1; y := -1; given cosh(x) = cosh(y); claim x = y",
    "exp-log/integer-power-of-zero":
        "x y; n int; if n >= 0; claim (x*y)**n = x**n*y**n",
    "exp-log/ln-negative-product":
        "x := -1; y := -1; claim ln(x*y) = ln(abs(x))+ln(abs(y))+1",
    "exp-log/ln-absolute-product":
        "x y; if x*y > 0; claim ln(x*y) = ln(abs(x))+ln(abs(y))",
    "exp-log/exp-inequality":
        "x; claim exp(x) >= 1+x",
    "exp-log/exp-inequality-wrong":
        "x := 0; claim exp(x) > 1+x",
    "exp-log/number-e":
        "claim exp(1) = 2.718281828459045",
    "exp-log/number-exp-pi":
        "claim exp(pi) > power(pi,exp(1))",
    "exp-log/number-ramanujan":
        "claim exp(pi*sqrt(163)) = 262537412640768744",
    # inverse
    "inverse/arctan-below-its-angle":
        "x >= 0; claim atan(x) <= x",
    "inverse/arctan-below-its-angle-wrong":
        "x := 1; claim atan(x) <= x-x**3/4",
    "inverse/arctan-reciprocal":
        "x > 0; claim atan(x)+atan(1/x) = pi/2",
    "inverse/arctan-reciprocal-wrong":
        "x := -1; claim atan(x)+atan(1/x) = pi/2",
    "inverse/arcsin-arccos":
        "x in (-1, 1); claim asin(x)+acos(x) = pi/2",
    "inverse/arcsin-arccos-wrong":
        "x := 0; claim asin(x)-acos(x) = pi/2",
    "inverse/sin-arcsin":
        "x in (-1, 1); claim sin(asin(x)) = x",
    "inverse/sin-arcsin-wrong":
        "x := pi; claim asin(sin(x)) = x",
    "inverse/arcsin-sin-range":
        "x in (-pi/2, pi/2); claim asin(sin(x)) = x",
    "inverse/arcsin-sin-range-wrong":
        "x := pi; claim asin(sin(x)) = x",
    "inverse/arccos-cos-range":
        "x in (0, pi); claim acos(cos(x)) = x",
    "inverse/cos-arcsin":
        "x in (-1, 1); claim cos(asin(x)) = sqrt(1-x**2)",
    "inverse/cos-arcsin-wrong":
        "x := 3/5; claim cos(asin(x)) = 1-x**2",
    "inverse/tan-arcsin":
        "x in (-1, 1); claim tan(asin(x)) = x/sqrt(1-x**2)",
    "inverse/tan-arcsin-wrong":
        "x := 3/5; claim tan(acos(x)) = x/sqrt(1-x**2)",
    "inverse/arctan-addition":
        "x y; if x*y < 1; claim atan(x)+atan(y) = atan((x+y)/(1-x*y))",
    "inverse/arctan-addition-wrong":
        "x := 2; y := 2; claim atan(x)+atan(y) = atan((x+y)/(1-x*y))",
    "inverse/machin":
        "claim 4*atan(1/5)-atan(1/239) = pi/4",
    "inverse/machin-wrong":
        "claim 4*atan(1/5)-atan(1/238) = pi/4",
    "inverse/arctan-one-two-three":
        "claim atan(1)+atan(2)+atan(3) = pi",
    "inverse/arctan-one-two-three-wrong":
        "claim atan(1)+atan(2)+atan(3) = 0",
    "inverse/arcsin-value":
        "claim asin(sqrt(3)/2) = pi/3",
    "inverse/arcsin-value-wrong":
        "claim asin(sqrt(3)/2) = 2*pi/3",
    "inverse/arccos-odd":
        "x in (-1, 1); claim acos(-x) = pi-acos(x)",
    "inverse/arccos-odd-wrong":
        "x := 0; claim acos(-x) = -acos(x)",
    "inverse/double-arcsin":
        "x in (0, 1); claim 2*asin(x) = acos(1-2*x**2)",
    "inverse/double-arcsin-wrong":
        "x := -1; claim 2*asin(x) = acos(1-2*x**2)",
    "inverse/angle-premise":
        "x; t := atan(x); claim sin(t) = x/sqrt(1+x**2)",
    "inverse/angle-premise-wrong":
        "x := 1; t := 5*pi/4; given tan(t) = x; claim sin(t) = x/sqrt(1+x**2)",
    "inverse/nowhere-defined":
        "nowhere; x; claim asin(2+x**2) = asin(2+x**2)",
    # forcing
    "forcing/product":
        "a p c; h > 0; b := a+h; F(t) := sin(pi*t+p)/pi+c; claim F(b)-F(a) = 2/pi*sin(pi*h/2)*cos(pi*(a+b)/2+p)",
    "forcing/product-wrong":
        "a p c; h > 0; b := a+h; F(t) := sin(pi*t+p)/pi+c; claim F(b)-F(a) = 2/pi*cos(pi*h/2)*sin(pi*(a+b)/2+p)",
    "forcing/difference":
        "a p c; h > 0; b := a+h; F(t) := sin(pi*t+p)/pi+c; claim F(b)-F(a) = (sin(pi*b+p)-sin(pi*a+p))/pi",
    "forcing/difference-wrong":
        "a := 0; p := 0; F(t) := sin(pi*t+p)/pi+1; claim F(a) = sin(pi*a+p)/pi",
    "forcing/second-integral":
        "a p c d; h > 0; b := a+h; F(t) := sin(pi*t+p)/pi+c; G(t) := -cos(pi*t+p)/pi**2+c*t+d; claim G(b)-G(a)-F(a)*h = (cos(pi*a+p)-cos(pi*b+p))/pi**2-h/pi*sin(pi*a+p)",
    "forcing/second-integral-wrong":
        "a p c d; h > 0; b := a+h; F(t) := sin(pi*t+p)/pi+c; G(t) := -cos(pi*t+p)/pi**2+c*t+d; claim G(b)-G(a) = (cos(pi*a+p)-cos(pi*b+p))/pi**2",
    "forcing/half-period":
        "t p; claim cos(pi*(t+1)+p) = -cos(pi*t+p)",
    "forcing/half-period-wrong":
        "t := 0; p := 0; claim cos(pi*(t+1)+p) = cos(pi*t+p)",
    "forcing/flight-of-one":
        "a p c; F(t) := sin(pi*t+p)/pi+c; claim F(a+1)-F(a) = -2/pi*sin(pi*a+p)",
    "forcing/flight-of-one-wrong":
        "a p c; F(t) := sin(pi*t+p)/pi+c; claim F(a+1)-F(a) = -1/pi*sin(pi*a+p)",
    "forcing/full-period":
        "a p c; F(t) := sin(pi*t+p)/pi+c; claim F(a+2) = F(a)",
    "forcing/full-period-wrong":
        "a p d; c := 1; G(t) := -cos(pi*t+p)/pi**2+c*t+d; claim G(a+2) = G(a)",
    "forcing/linear-law":
        "a c; d h > 0; b := a+h; F(t) := d*t**2/2+c; claim F(b)-F(a) = d*h/2*(a+b)",
    "forcing/linear-law-wrong":
        "a c; d h > 0; b := a+h; F(t) := d*t**2/2+c; claim F(b)-F(a) = d*h*(a+b)",
    "forcing/cubic-law":
        "a b c; F(t) := t**4/4-3*t**2/2+c; claim F(b)-F(a) = (b**4-a**4)/4-3/2*(b**2-a**2)",
    "forcing/cubic-law-wrong":
        "a := 1; b := 2; F(t) := t**4/4-3*t**2/2; claim F(b)-F(a) = (b-a)**4/4-3/2*(b-a)**2",
    "forcing/second-period-wrong":
        "T := 1; d := 2; claim T = d",
    "forcing/second-period-multiples-wrong":
        "T := 1; d := 2; f(t) := cos(2*pi*t); given f(1/7+T) = f(1/7); given f(1/7+d) = f(1/7); claim f(T/2) = f(0)",
    "forcing/antiperiod-wrong":
        "f(t) := cos(pi*t); given f(1/7+1) = -f(1/7); claim f(1) = f(0)",
    "forcing/gauss-law":
        "a b; claim exp(-a**2)*exp(-b**2) = exp(-a**2-b**2)",
    "forcing/gauss-law-wrong":
        "a := 0; b := 1; f(t) := exp(-t**2); claim integral(f,a,b) = 0",
    "forcing/chirp-law":
        "a; claim cos(a**2)**2 = (1+cos(2*a**2))/2",
    "forcing/chirp-law-wrong":
        "a := 0; b := 1; f(t) := cos(t**2); claim integral(f,a,b) = sin(b**2)-sin(a**2)",
    "forcing/inverse-square-law":
        "a h > 0; c; b := a+h; F(t) := -1/t+c; claim F(b)-F(a) = 1/a-1/b",
    "forcing/inverse-square-law-wrong":
        "a := 1; b := 2; F(t) := -1/t; claim F(b)-F(a) = 1/a-1/b+1",
    "forcing/inverse-square-law-across":
        "a := -1; b := 1; F(t) := -1/t+(1 if t > 0 else 0); claim F(b)-F(a) = 1/a-1/b",
    "forcing/squared-cosine":
        "a c; h > 0; b := a+h; F(t) := t/2+sin(2*pi*t)/(4*pi)+c; claim F(b)-F(a) = h/2+(sin(2*pi*b)-sin(2*pi*a))/(4*pi)",
    "forcing/squared-cosine-wrong":
        "a := 0; b := 1/4; F(t) := t/2+sin(2*pi*t)/(4*pi); claim F(b)-F(a) = (b-a)/2+(sin(2*pi*b)-sin(2*pi*a))/(2*pi)",
    "forcing/decaying-law":
        "a c; h > 0; b := a+h; F(t) := -exp(-t)+c; claim F(b)-F(a) = exp(-a)-exp(-b)",
    "forcing/decaying-law-wrong":
        "a := 0; b := 1; F(t) := -exp(-t); claim F(b)-F(a) = exp(-b)-exp(-a)",
    "forcing/two-tones":
        "t; f(t) := cos(pi*t)+cos(2*pi*t); claim f(t+2) = f(t)",
    "forcing/two-tones-wrong":
        "f(t) := cos(pi*t)+cos(2*pi*t); claim f(1) = f(0)",
    # restated-premises
    "restated-premises/law-at-running-time":
        "t p; claim cos(pi*t+p) = cos(pi*t+p)",
    "restated-premises/law-at-running-time-wrong":
        "claim cos(0*pi) = sin(0*pi)",
    "restated-premises/period-two-wrong":
        "f(t) := cos(pi*t); given f(1/7+2) = f(1/7); claim f(1) = f(0)",
    "restated-premises/period-one-wrong":
        "f(t) := cos(2*pi*t); given f(1/7+1) = f(1/7); claim f(1/2) = f(0)",
    "restated-premises/period-backwards-wrong":
        "f(t) := t-t+1; claim f(0) = -f(0)",
    "restated-premises/declared-derivative-wrong":
        "f := 1; g := 0; claim g = f",
    "restated-premises/derivative-by-premise-wrong":
        "f := 1; g := 0; claim f = g",
    "restated-premises/law-derived":
        "u; f(t) := t**2; claim D(f,u) = 2*u",
    "restated-premises/law-derived-wrong":
        "f(t) := t**2; claim D(f,mpf(1)) = 1",
    "restated-premises/law-derived-cosine":
        "u; f(t) := cos(3*t); claim D(f,u) = -3*sin(3*u)",
    "restated-premises/law-derived-cosine-wrong":
        "u := 1; f(t) := cos(3*t); claim D(f,u) = -sin(3*u)",
    "restated-premises/law-back":
        "a c; f(t) := t**2+c; claim f(a)-f(0*a) = a**2",
    "restated-premises/law-back-wrong":
        "a := 0; f(t) := t**2+1; claim f(a) = a**2",
    "restated-premises/recurrence":
        "a x; y := a*x; claim y = a*x",
    "restated-premises/recurrence-wrong":
        "a := 2; x := 1; y := 2; given y = a*x; claim x = a*y",
    "restated-premises/mirrored":
        "y; x := y+1; claim y+1 = x",
    "restated-premises/mirrored-wrong":
        "y := 0; x := 1; given x = y+1; claim y = x+1",
    "restated-premises/quotient":
        "b c; a := b*c; if b != 0; claim a = b*c",
    "restated-premises/quotient-wrong":
        "a := 2; b := 1; c := 2; given a/b = c; claim b/a = c",
    "restated-premises/quotient-reciprocal":
        "b c; if b != 0 and c != 0; a := b*c; claim b/a = 1/c",
    "restated-premises/product-to-quotient-wrong":
        "a := 2; b := 1; c := 2; given a = b*c; claim a*c = b",
    "restated-premises/square":
        "s sign; x := s*sqrt(2); claim x**2 = 2",
    "restated-premises/square-wrong":
        "x := -sqrt(2); given x**2 = 2; claim x = sqrt(2)",
    "restated-premises/sine-value":
        "n int; x := asin(1/3)+2*pi*n; claim sin(x) = 1/3",
    "restated-premises/sine-value-wrong":
        "x := pi-asin(1/3); given sin(x) = 1/3; claim x = asin(1/3)",
    "restated-premises/inequality":
        "x; d > 0; y := x+d; claim x <= y",
    "restated-premises/inequality-wrong":
        "x := 1; y := 1; given x <= y; claim x < y",
    "restated-premises/motion-law-wrong":
        "z := 1; g := 1; f := 0; given z = f+g; claim z = f-g",
    "restated-premises/several-in-one":
        "x := 1; y := 2; claim x+y = 3",
    "restated-premises/several-in-one-wrong":
        "x := 1; y := 2; claim y-x = 2",
    # relations
    "relations/relation-and-premise":
        "s sign; S := s*sqrt(1/2); C := S; given S**2 = 1-C**2; claim 2*S**2 = 1",
    "relations/relation-and-premise-wrong":
        "S := -1/sqrt(2); C := S; given S**2 = 1-C**2; claim S = 1/sqrt(2)",
    "relations/relation-value":
        "S := 4/5; C := 3/5; given S**2 = 1-C**2; claim S = 4/5",
    "relations/relation-value-wrong":
        "S := -4/5; C := 3/5; given S**2 = 1-C**2; claim S = 4/5",
    "relations/relation-bound":
        "S := 0; C := 1; given S**2 = 1-C**2; claim S = 0",
    "relations/relation-bound-wrong":
        "S := 0; C := 1; given S**2 = 1-C**2; claim S = 1",
    "relations/circle-and-line":
        "s sign; x := (7+s)/2; y := 7-x; given x**2+y**2 = 25; claim x*y = 12",
    "relations/circle-and-line-wrong":
        "x := 4; y := 3; given x**2+y**2 = 25; given x+y = 7; claim x = 3",
    "relations/golden-power":
        "s sign; x := (1+s*sqrt(5))/2; claim x**5 = 5*x+3",
    "relations/golden-power-wrong":
        "x := (1-sqrt(5))/2; given x**2 = x+1; claim x = (1+sqrt(5))/2",
    "relations/golden-both-roots":
        "s sign; x := (1+s*sqrt(5))/2; claim x**2 = x+1",
    "relations/golden-both-roots-wrong":
        "x := (-1+sqrt(5))/2; claim x**2 = x+1",
    "relations/double-root-as-two":
        "x := 1; claim x**2 = 4",
    "relations/chain":
        "d; c := d**2; b := c+1; a := b**2; claim a = d**4+2*d**2+1",
    "relations/chain-wrong":
        "d := 1; c := 1; b := 2; a := 4; claim a = d**4+1",
    "relations/chain-of-roots":
        "a; b := a**2; c := b**2; claim a**4 = c",
    "relations/chain-of-roots-wrong":
        "a := 1; b := 1; c := 1; claim a**2 = sqrt(c)+1",
    "relations/chain-of-roots-sign":
        "a; b := a**2; c := b**2; claim b = sqrt(c)",
    "relations/chain-of-roots-sign-wrong":
        "a := -1; b := 1; c := 1; given a**2 = b; claim a = sqrt(b)",
    "relations/parametrised-circle":
        "s; x := (1-s**2)/(1+s**2); y := 2*s/(1+s**2); claim x**2+y**2 = 1",
    "relations/parametrised-circle-wrong":
        "s := -1; x := (1-s**2)/(1+s**2); y := 2*s/(1+s**2); claim x+y = 1",
    "relations/mobius-inverse":
        "a b c x; if a != 0; d := (1+b*c)/a; if c*x+d != 0; y := (a*x+b)/(c*x+d); claim x*(a-c*y) = d*y-b",
    "relations/mobius-inverse-wrong":
        "a := 2; b := 1; c := 1; d := 1; x := 1; y := 3/2; given a*d-b*c = 1; given y = (a*x+b)/(c*x+d); claim x*(a+c*y) = d*y-b",
    "relations/mobius-inverse-divided":
        "a b c x; if a != 0; d := (1+b*c)/a; if c*x+d != 0; y := (a*x+b)/(c*x+d); claim x = (d*y-b)/(a-c*y)",
    "relations/power-sums":
        "x y; p := x+y; q := x*y; claim x**3+y**3 = p**3-3*p*q",
    "relations/power-sums-wrong":
        "x := 1; y := 1; p := 2; q := 1; claim x**3+y**3 = p**3-2*p*q",
    "relations/zero-sum":
        "a b; c := -a-b; claim a**3+b**3+c**3 = 3*a*b*c",
    "relations/zero-sum-wrong":
        "a := 1; b := 1; c := -2; given a+b+c = 0; claim a**3+b**3+c**3 = a*b*c",
    "relations/zero-sum-fourth":
        "a b; c := -a-b; claim (a**2+b**2+c**2)**2 = 2*(a**4+b**4+c**4)",
    "relations/where-discriminant":
        "a b x; c := -a*x**2-b*x; claim (2*a*x+b)**2 = b**2-4*a*c",
    "relations/where-discriminant-wrong":
        "a := 1; b := -3; c := 2; x := 1; given a*x**2+b*x+c = 0; claim 2*a*x+b = sqrt(b**2-4*a*c)",
    "relations/with-substitution":
        "x b; y := 2*x+b; claim y = 2*x+b",
    "relations/with-substitution-wrong":
        "x := 1; b := 0; y := 2; given y = 2*x+b; claim y = x+b",
    "relations/with-acts-on-premises-only":
        "a := 3; x := 1; b := 0; y := 2; given y = 2*x+b; claim y = a*x+b",
    "relations/three-eliminated":
        "a; x := a; y := 0*a; z := 2*a; given y+z = 2*a; given z+x = 3*a; claim y = 0",
    "relations/three-eliminated-wrong":
        "a := 1; y := 0; claim y = a",
    "relations/quadratic-in-what-it-defines":
        "y > 0; x := y**2; a := x**2; claim y**4 = a",
    "relations/quadratic-in-what-it-defines-wrong":
        "y := 2; x := 4; a := 16; claim y**4 = x",
    # indices
    "indices/twice":
        "a x; y := a*x; z := a*y; claim z = a**2*x",
    "indices/twice-wrong":
        "a := 2; x := 1; z := 4; claim z = a**3*x",
    "indices/k-runs-twice":
        "a x; y := a*x; z := a*y; claim z = a**2*x",
    "indices/k-does-not-run-restated":
        "a x; y := a*x; claim y**2 = a**2*x**2",
    "indices/k-next":
        "a x; y := a*x; z := a*y; claim z = a*y",
    "indices/pair-k-does-not-run":
        "r := 1/2; x := 2; y := -1; z := 7; given y = -r*x; claim z = r**2*x",
    "indices/pair-both-flights":
        "r q > 0; x; y := -r*x; z := -q*y; claim z = r*q*x",
    "indices/backwards":
        "a x; claim (x+a)+(x-a) = 2*x",
    "indices/backwards-wrong":
        "a := 1; x := 0; claim (x+a)-(x-a) = a",
    "indices/fibonacci":
        "x y; z := x+y; u := z+y; v := u+z; claim v = 3*y+2*x",
    "indices/fibonacci-wrong":
        "x := 0; y := 1; z := x+y; u := z+y; v := u+z; claim v = 2*y+3*x",
    "indices/cassini":
        "x y; z := x+y; claim z*x-y**2 = x**2+x*y-y**2",
    "indices/cassini-wrong":
        "x := 0; y := 1; z := 1; u := 2; claim u*y-z**2 = z*x-y**2",
    "indices/cassini-step":
        "x y; z := x+y; u := y+z; claim u*y-z**2 = -(z*x-y**2)",
    "indices/logistic":
        "a x; y := a*x*(1-x); claim a*y*(1-y) = a**2*x*(1-x)*(1-a*x*(1-x))",
    "indices/logistic-wrong":
        "a := 2; x := 1/4; y := a*x*(1-x); claim a*y*(1-y) = a**2*x*(1-x)*(1-x*(1-x))",
    "indices/newton":
        "a x; if x != 0; y := (x+a/x)/2; claim y**2-a = (x**2-a)**2/(4*x**2)",
    "indices/newton-wrong":
        "a := 2; x := 1; y := 3/2; claim y**2-a = (x**2-a)**2/(2*x**2)",
    "indices/constant-sequence-wrong":
        "x := 1; claim x = 2",
    "indices/closed-form":
        "a; n int; if n >= 0; claim a**n = a**n",
    "indices/closed-form-wrong":
        "a := 1; claim a**0 = 0*a",
    # domains
    "domains/cancelled":
        "x; if x != 1; claim (x**2-1)/(x-1) = x+1",
    "domains/cancelled-wrong":
        "x := 0; claim (x**2-1)/(x-1) = x-1",
    "domains/factor-premise":
        "x := 1; y := 0; given x**2-1 = (x-1)*y; claim y = x+1",
    "domains/factor-premise-generic":
        "x; if x != 1; y := x+1; claim y = x+1",
    "domains/factor-premise-assumed":
        "x; if x != 1; y := x+1; claim y = x+1",
    "domains/factor-premise-assumed-beside":
        "x := 1; y := 0; given x**2-1 = (x-1)*y; claim y = x+1",
    "domains/zeroth-power":
        "x; claim x**0 = 1",
    "domains/zeroth-power-wrong":
        "x := 2; claim x**0 = x",
    "domains/absolute-value-positive":
        "x > 0; claim abs(x) = x",
    "domains/absolute-value-positive-wrong":
        "x := -1; claim abs(x) = x",
    "domains/absolute-value-product":
        "x y; claim abs(x*y) = abs(x)*abs(y)",
    "domains/absolute-value-product-wrong":
        "x := 1; y := -1; claim abs(x+y) = abs(x)+abs(y)",
    "domains/triangle-inequality":
        "x y; claim abs(x+y) <= abs(x)+abs(y)",
    "domains/triangle-inequality-wrong":
        "x := 0; y := 0; claim abs(x+y) < abs(x)+abs(y)",
    "domains/root-of-square-negative":
        "d > 0; x := -d; claim sqrt(x**2) = -x",
    "domains/root-of-square-interval":
        "x := -1; claim sqrt(x**2) = x",
    "domains/root-of-shifted-square":
        "x in (-3, 1); claim sqrt(1-2*x+x**2) = 1-x",
    "domains/even-power-of-sign":
        "n int; claim (-1)**(2*n) = 1",
    "domains/even-power-of-sign-wrong":
        "n := 1; claim (-1)**n = 1",
    "domains/sine-of-integer":
        "n int; claim sin(pi*n) = 0",
    "domains/sine-of-integer-wrong":
        "n := 1; claim sin(pi*n/2) = 0",
    "domains/sine-of-real":
        "n := 1/2; claim sin(pi*n) = 0",
    "domains/integer-between":
        "n int; if 0 <= n <= 1; claim n**2 = n",
    "domains/integer-between-wrong":
        "n := 1/2; claim n**2 = n",
    "domains/reciprocal-sum":
        "x > 0; claim x+1/x >= 2",
    "domains/reciprocal-sum-wrong":
        "x := -1; claim x+1/x >= 2",
    "domains/means":
        "x y >= 0; claim (x+y)/2 >= sqrt(x*y)",
    "domains/means-wrong":
        "x := 1; y := 1; claim (x+y)/2 > sqrt(x*y)",
    "domains/square-inequality":
        "x y; claim x**2+y**2 >= 2*x*y",
    "domains/square-inequality-wrong":
        "x := 1; y := 1; claim x**2+y**2 > 2*x*y",
    "domains/at-most-one":
        "r in (0, 1); claim 1-r**2 >= 0",
    "domains/at-most-one-wrong":
        "r := 1; claim 1-r**2 > 0",
    "domains/lone-point":
        "x := 0; claim sqrt(-x**2) = x",
    "domains/lone-point-wrong":
        "x := 0; claim sqrt(-x**2) = 1",
    "domains/lone-point-two-roots":
        "x := 0; claim sqrt(x)+sqrt(-x) = x",
    "domains/lone-point-two-roots-wrong":
        "x := 0; claim sqrt(x)+sqrt(-x) = x+1",
    "domains/nowhere-logarithm":
        "nowhere; x; claim ln(-1-x**2) = ln(-1-x**2)",
    "domains/nowhere-two-logarithms":
        "nowhere; x; claim ln(x)+ln(-x) = 0",
    "domains/nowhere-denominator":
        "nowhere; x; claim 1/(x-x) = 1/(x-x)",
    "domains/nowhere-under-premise":
        "nowhere; x := 0; claim 1/x = 1/x",
    "domains/complex-quadratic":
        "a b; s sign; z := I*0+a+s*sqrt(I*0+a**2-b); claim z**2-2*a*z+b = 0",
    "domains/complex-quadratic-wrong":
        "a := 0; b := 1; z := a+sqrt(I*0+a**2+b); claim z**2-2*a*z+b = 0",
    "domains/complex-focus":
        "a; b := a**2+1; z := a+I; given z**2-2*a*z+b = 0; claim b = a**2+1",
    "domains/complex-focus-wrong":
        "a := 0; b := 1; z := a+I; given z**2-2*a*z+b = 0; claim b = a**2-1",
    "domains/complex-root-squared":
        "z complex; claim sqrt(z)**2 = z",
    "domains/complex-root-squared-wrong":
        "z := -1+0*I; claim sqrt(z**2) = z",
    "domains/complex-exponential":
        "z w complex; claim exp(z+w) = exp(z)*exp(w)",
    "domains/complex-root-of-product":
        "z := -1+0*I; w := -1+0*I; claim sqrt(z*w) = sqrt(z)*sqrt(w)",
    "domains/euler":
        "x; claim exp(I*x) = cos(x)+I*sin(x)",
    "domains/euler-wrong":
        "x := pi/2; claim exp(I*x) = cos(x)-I*sin(x)",
    "domains/complex-logarithm":
        "z complex; if z != 0; claim exp(ln(z)) = z",
    "domains/complex-logarithm-wrong":
        "z := -1+0*I; w := -1+0*I; claim ln(z*w) = ln(z)+ln(w)",
    "domains/complex-number":
        "claim (1+I)**2 = 2*I",
    "domains/complex-number-wrong":
        "claim (1+I)**2 = -2*I",
    "domains/complex-square-minus-one":
        "s sign; z := s*I; claim z**4 = 1",
    "domains/complex-square-minus-one-wrong":
        "z := -I; given z**2 = -1; claim z = I",
    "domains/complex-sine":
        "x; claim sin(I*x) = I*sinh(x)",
    "domains/complex-sine-wrong":
        "x := 0; claim cos(I*x) = I*cosh(x)",
    "domains/cube-root-of-one":
        "x := 1; claim x = 1",
    "domains/cube-root-of-one-wrong":
        "x := (-1+I*sqrt(3))/2; given x**3 = 1; claim x = 1",
    "domains/sum-of-two-squares":
        "x := 0; claim x = 0",
    "domains/sum-of-two-squares-wrong":
        "x := 1; y := I; given x**2+y**2 = 0; claim x = 0",
    # differential
    "differential/oscillator-energy":
        "p q; f(t) := p*cos(t)+q*sin(t); g(t) := -p*sin(t)+q*cos(t); u; claim f(u)**2+g(u)**2 = f(0)**2+g(0)**2",
    "differential/oscillator-energy-wrong":
        "f(t) := cos(t); g(t) := -sin(t); u := pi/2; claim f(u)**2-g(u)**2 = f(0)**2-g(0)**2",
    "differential/oscillator-solution":
        "p q; f(t) := p*cos(t)+q*sin(t); g(t) := -p*sin(t)+q*cos(t); u; claim f(u) = f(0)*cos(u)+g(0)*sin(u)",
    "differential/oscillator-solution-wrong":
        "f(t) := sin(t); g(t) := cos(t); u := 1; claim f(u) = f(0)*cos(u)-g(0)*sin(u)",
    "differential/oscillator-period":
        "p q; f(t) := p*cos(t)+q*sin(t); g(t) := -p*sin(t)+q*cos(t); u; claim f(u+2*pi) = f(u)",
    "differential/oscillator-period-wrong":
        "f(t) := cos(t); claim f(pi) = f(0)",
    "differential/exponential":
        "k u; f(t) := k*exp(t); claim f(u) = f(0)*exp(u)",
    "differential/exponential-wrong":
        "u := 0; f(t) := 2*exp(t); claim f(u) = exp(u)",
    "differential/exponential-product":
        "k a b; f(t) := k*exp(t); claim f(a)*f(b) = f(0)*f(a+b)",
    "differential/exponential-product-wrong":
        "a := 0; b := 0; f(t) := 2*exp(t); claim f(a)*f(b) = f(a+b)",
    "differential/decay":
        "k u; f(t) := k*exp(-2*t); claim f(u)*exp(2*u) = f(0)",
    "differential/decay-wrong":
        "u := 1; f(t) := exp(-2*t); claim f(u)*exp(u) = f(0)",
    "differential/decay-second-derivative":
        "k a u; f(t) := k*exp(-a*t); claim D2(f,u) = a**2*f(u)",
    "differential/decay-second-derivative-wrong":
        "a := 1; u := 0; f(t) := exp(-t); claim D2(f,u) = -a**2*f(u)",
    "differential/logistic":
        "u k > 0; f(t) := 1/(1+k*exp(-t)); claim D2(f,u) = D(f,u)*(1-2*f(u))",
    "differential/logistic-wrong":
        "u := 1; f(t) := 1/(1+exp(-t)); claim D2(f,u) = D(f,u)*(1-f(u))",
    "differential/constant-acceleration":
        "a p q u; f(t) := p+q*t+a*t**2/2; claim f(u) = f(0)+q*u+a*u**2/2",
    "differential/constant-acceleration-wrong":
        "a := 1; u := 1; f(t) := a*t**2/2; claim f(u) = a*u**2",
    "differential/constant-acceleration-energy":
        "a p q u; f(t) := p+q*t+a*t**2/2; g(t) := q+a*t; claim g(u)**2-2*a*f(u) = g(0)**2-2*a*f(0)",
    "differential/constant-acceleration-energy-wrong":
        "a := 1; u := 1; f(t) := t**2/2; g(t) := t; claim g(u)**2-a*f(u) = 0",
    "differential/henon-determinant":
        "a b x; claim (-2*a*x)*0-1*b = -b",
    "differential/henon-determinant-wrong":
        "b := 1; claim -b = b",
    "differential/henon-twice":
        "b; claim (-b)*(-b) = b**2",
    "differential/henon-twice-wrong":
        "b := 1; claim b**2 = -b**2",
    "differential/standard-map":
        "a x; claim (1+a*cos(x))*1-1*(a*cos(x)) = 1",
    "differential/standard-map-trace":
        "a x; claim (1+a*cos(x))+1 = 2+a*cos(x)",
    "differential/standard-map-trace-wrong":
        "a := 1; x := 0; claim (1+a*cos(x))+1 = 2+a*sin(x)",
    "differential/standard-map-wrong":
        "a := 1; x := 0; claim 1 = 1+a*cos(x)",
    "differential/implicit-map-wrong":
        "a := 1; x := 1; claim a/(1+3*x**2) = a/(1+x**2)",
    "differential/abbreviation-in-jacobian":
        "a x; f(t) := t+a*t**2; claim D(f,x) = 1+2*a*x",
    "differential/abbreviation-in-jacobian-wrong":
        "a := 1; x := 1; f(t) := t+a*t**2; claim D(f,x) = 1",
    "differential/chain-rule-map":
        "a x; f(t) := sin(a*t); claim D(f,x) = a*cos(a*x)",
    "differential/chain-rule-map-wrong":
        "a := 2; x := 0; f(t) := sin(a*t); claim D(f,x) = cos(a*x)",
    "differential/root-map":
        "a > 0; x; f(t) := sqrt(a+t**2); claim D(f,x) = x/f(x)",
    "differential/root-map-wrong":
        "a := 1; x := 1; f(t) := sqrt(a+t**2); claim D(f,x) = 1/(2*f(x))",
    # witness-traps
    "witness-traps/half-angle":
        "u; claim sin(u) = 2*sin(u/2)*cos(u/2)",
    "witness-traps/half-angle-wrong":
        "u := pi; claim sin(u) = 2*sin(u/2)",
    "witness-traps/cosine-one":
        "n int; u := 2*pi*n; claim sin(u/2) = 0",
    "witness-traps/cosine-one-wrong":
        "u := 2*pi; given cos(u) = 1; claim cos(u/2) = 1",
    "witness-traps/sine-zero":
        "n int; u := pi*n; claim sin(2*u) = 0",
    "witness-traps/sine-zero-wrong":
        "u := pi; given sin(u) = 0; claim sin(u/2) = 0",
    "witness-traps/tangent-one":
        "nowhere; u := pi/4; claim tan(2*u) = 0",
    "witness-traps/premise-denominator":
        "x; if x != 1; y := (x**2-x)/(x-1); claim y = x",
    "witness-traps/premise-denominator-wrong":
        "x := 2; y := 2; given y = (x**2-x)/(x-1); claim y = 1",
    "witness-traps/premise-denominator-zero-value":
        "x := -1; y := -1; given y = (x**2-x)/(x-1); claim x = -1",
    "witness-traps/premise-denominator-zero-value-wrong":
        "x := -1; y := -1; given y = (x**2-x)/(x-1); claim x = 1",
    "witness-traps/reciprocals":
        "x; if x != 0; y := -x; given 1/x+1/y = 0; claim x+y = 0",
    "witness-traps/reciprocals-wrong":
        "x := 2; y := -2; given 1/x+1/y = 0; claim x*y = -1",
    "witness-traps/root-of-negative-premise":
        "y; x := -1-y**2; claim sqrt(x**2) = -x",
    "witness-traps/root-of-negative-premise-wrong":
        "y := 1; x := -2; claim sqrt(x**2) = 1-y**2",
    "witness-traps/reflexion-of-exponential":
        "k; f(t) := k*exp(t); claim f(1)*f(-1) = f(0)**2",
    "witness-traps/reflexion-of-exponential-wrong":
        "f(t) := 2*exp(t); claim f(1)*f(-1) = f(0)",
    "witness-traps/oscillator-half-turn":
        "p q; f(t) := p*cos(t)+q*sin(t); g(t) := -p*sin(t)+q*cos(t); claim f(pi) = -f(0)",
    "witness-traps/oscillator-half-turn-wrong":
        "f(t) := cos(t); claim f(pi) = f(0)",
    "witness-traps/straight-line":
        "p q; f(t) := p+q*t; claim f(2)-f(1) = f(1)-f(0)",
    "witness-traps/straight-line-wrong":
        "f(t) := t; claim f(2) = f(1)",
    "witness-traps/period-and-values-wrong":
        "f(t) := cos(pi*t); claim f(4) = f(1)",
    "witness-traps/two-periods-wrong":
        "f(t) := cos(2*pi*t); given f(1/7+2) = f(1/7); given f(1/7+3) = f(1/7); claim f(1/2) = f(0)",
    "witness-traps/even-function-wrong":
        "f(t) := t-t+1; claim f(0) = 0",
    "witness-traps/periodic-derivative-wrong":
        "f(t) := t; given D(f,mpf(2)) = D(f,mpf(1)); claim f(1) = f(0)",
    "witness-traps/derivative-zero-wrong":
        "f(t) := t-t+1; claim f(1) = 0",
    "witness-traps/additive-function-wrong":
        "f(t) := t+sin(pi*t)**2; given f(1/7+1) = f(1/7)+1; claim f(1/2) = f(0)+1/2",
    "witness-traps/quintic-wrong":
        "x := 7/6; claim x**5-x-1 = 0",
    "witness-traps/transcendental-root-wrong":
        "x := 3/4; claim x = cos(x)",
    "witness-traps/exponential-root":
        "x := ln(2); claim exp(x) = 2",
    "witness-traps/exponential-root-wrong":
        "x := ln(2); given exp(x) = 2; claim x = 0.6931471805599453",
    "witness-traps/inequality-premise":
        "x := 0; claim x = 0",
    "witness-traps/inequality-premise-wrong":
        "x := 1; y := 1; given x**2-y**2 <= 0; claim x = 0",
    "witness-traps/irrational-only":
        "x := sqrt(2); claim x**3 = 2*x",
    "witness-traps/irrational-only-wrong":
        "x := sqrt(2); claim x = 99/70",
    "witness-traps/small-difference":
        "x > 0; claim ((1+x)**3-1)/x = 3+3*x+x**2",
    "witness-traps/small-difference-wrong":
        "x := 1; claim ((1+x)**3-1)/x = 3+3*x+x**2+x/10**30",
    "witness-traps/vanishes-at-small-integers":
        "x; claim x*(x-1)*(x+1) = x**3-x",
    "witness-traps/vanishes-at-small-integers-wrong":
        "x := 4; claim x*(x**2-1)*(x**2-4)*(x**2-9) = 0",
    # equations-of-fields
    "equations-of-fields/doppler":
        "g c > 0; v s; if c != s; f := (c+v)/(c-s)*g; if f > 0; claim v = f/g*(c-s)-c",
    "equations-of-fields/doppler-wrong":
        "g := 1; c := 2; v := 0; s := 1; f := 2; given f = (c+v)/(c-s)*g; claim v = f/g*(c+s)-c",
    "equations-of-fields/relativistic-doppler":
        "b > 0; u in (-1, 1); a := b*sqrt((1+u)/(1-u)); claim u = (a**2-b**2)/(a**2+b**2)",
    "equations-of-fields/relativistic-doppler-wrong":
        "b := 1; u := 3/5; a := 2; given a = b*sqrt((1+u)/(1-u)); claim u = (a**2+b**2)/(a**2-b**2)",
    "equations-of-fields/thin-lens":
        "a b; f := a*b/(a+b); given 1/f = 1/a+1/b; claim (a-f)*(b-f) = f**2",
    "equations-of-fields/thin-lens-wrong":
        "a := 4; b := 4; f := 2; given 1/f = 1/a+1/b; claim f = (a+b)/(a*b)",
    "equations-of-fields/lensmaker":
        "n R > 0; Q; if Q != 0; h := (n-1)*(1/R-1/Q); f := 1/h; if f > 0; claim f*(n-1)*(Q-R) = R*Q",
    "equations-of-fields/lensmaker-wrong":
        "n := 2; R := 1; Q := 2; f := 2; given 1/f = (n-1)*(1/R-1/Q); claim f*(n-1)*(R-Q) = R*Q",
    "equations-of-fields/kepler-third":
        "a G M > 0; v := sqrt(G*M/a); T := 2*pi*a/v; given v**2/a = G*M/a**2; claim T**2 = 4*pi**2*a**3/(G*M)",
    "equations-of-fields/kepler-third-wrong":
        "a := 2; G := 1; M := 2; v := 1; T := 4*pi; given v**2/a = G*M/a**2; claim T**2 = 4*pi**2*a**2/(G*M)",
    "equations-of-fields/kepler-ellipse":
        "a > 0; e in (-1, 1); E; x := a*(cos(E)-e); y := a*sqrt(1-e**2)*sin(E); r := a*(1-e*cos(E)); claim x**2+y**2 = r**2",
    "equations-of-fields/kepler-ellipse-wrong":
        "a := 1; e := 1/2; E := 0; x := a*(cos(E)-e); y := 0; r := a*(1+e*cos(E)); claim x**2+y**2 = r**2",
    "equations-of-fields/vis-viva":
        "r s m > 0; v := sqrt(2*m*s/(r*(r+s))); w := r*v/s; given v**2/2-m/r = w**2/2-m/s; claim v**2*(r+s)*(s-r)*r = 2*m*(s-r)*s",
    "equations-of-fields/vis-viva-wrong":
        "r := 1; s := 3; m := 2; v := sqrt(3); w := v/3; given v**2/2-m/r = w**2/2-m/s; given r*v = s*w; claim v**2*(r+s)*(s-r)*r = m*(s-r)*s",
    "equations-of-fields/beam-deflection":
        "F; E J L > 0; u; w(t) := F*t**2/(6*E*J)*(3*L-t); claim D2(w,u) = F*(L-u)/(E*J)",
    "equations-of-fields/beam-deflection-wrong":
        "F := 1; E := 1; J := 1; L := 1; u := 1; w(t) := F*t**2/(6*E*J)*(3*L-t); claim D2(w,u) = F*(L+u)/(E*J)",
    "equations-of-fields/beam-tip":
        "F; E J L > 0; d := F*L**2/(6*E*J)*2*L; claim d = F*L**3/(3*E*J)",
    "equations-of-fields/beam-tip-wrong":
        "F := 1; E := 1; J := 1; L := 1; d := 1/3; claim d = F*L**3/(8*E*J)",
    "equations-of-fields/rc-circuit":
        "R in (1/2, 4); C in (1/2, 4); U u; q(t) := C*U*(1-exp(-t/(R*C))); claim R*D(q,u)+q(u)/C = U",
    "equations-of-fields/rc-circuit-wrong":
        "R := 1; C := 1; U := 1; u := 1; q(t) := C*U*(1-exp(-t/(R*C))); claim R*D(q,u)-q(u)/C = U",
    "equations-of-fields/rlc-quality":
        "R L C > 0; w := 1/sqrt(L*C); Q := w*L/R; claim Q = sqrt(L/C)/R",
    "equations-of-fields/rlc-quality-wrong":
        "R := 2; L := 1; C := 1; w := 1; Q := 1/2; claim Q = R*sqrt(L/C)",
    "equations-of-fields/parallel-resistors":
        "a b > 0; R := a*b/(a+b); claim R < a",
    "equations-of-fields/parallel-resistors-wrong":
        "a := 2; b := 2; R := 1; given 1/R = 1/a+1/b; claim R = (a+b)/2",
    "equations-of-fields/lorentz":
        "c > 0; s in (-1, 1); v := s*c; x t; G := 1/sqrt(1-v**2/c**2); X := G*(x-v*t); u := G*(t-v*x/c**2); claim X**2-c**2*u**2 = x**2-c**2*t**2",
    "equations-of-fields/lorentz-wrong":
        "c := 1; v := 3/5; x := 1; t := 1; G := 5/4; X := G*(x-v*t); u := G*(t-v*x); claim X**2+u**2 = x**2+t**2",
    "equations-of-fields/lorentz-inverse":
        "c > 0; s in (-1, 1); v := s*c; x t; G := 1/sqrt(1-v**2/c**2); X := G*(x-v*t); u := G*(t-v*x/c**2); claim x = G*(X+v*u)",
    "equations-of-fields/velocity-addition":
        "c > 0; p in (-1, 1); q in (-1, 1); u := p*c; v := q*c; w := (u+v)/(1+u*v/c**2); claim (c-w)/(c+w) = (c-u)*(c-v)/((c+u)*(c+v))",
    "equations-of-fields/velocity-addition-wrong":
        "c := 1; u := 1/2; v := 1/2; w := 4/5; given w = (u+v)/(1+u*v/c**2); claim (c-w)/(c+w) = (c-u)*(c+v)/((c+u)*(c-v))",
    "equations-of-fields/gamma":
        "b in (-1, 1); g := 1/sqrt(1-b**2); claim g**2*b**2 = g**2-1",
    "equations-of-fields/gamma-wrong":
        "b := -3/5; g := 5/4; given g = 1/sqrt(1-b**2); claim b = sqrt(1-1/g**2)",
    "equations-of-fields/michaelis-menten":
        "V K s > 0; v := V*s/(K+s); claim 1/v = K/V/s+1/V",
    "equations-of-fields/michaelis-menten-wrong":
        "V := 2; K := 1; s := 1; v := 1; claim 1/v = V/K/s+1/V",
    "equations-of-fields/michaelis-half":
        "V K > 0; s := K; v := V/2; given v = V*s/(K+s); claim s = K",
    "equations-of-fields/michaelis-half-wrong":
        "V := 2; K := 1; s := 1; v := 1; given v = V*s/(K+s); claim s = 2*K",
    "equations-of-fields/black-scholes-d2":
        "S K T v > 0; r; d := (ln(S/K)+(r+v**2/2)*T)/(v*sqrt(T)); e := (ln(S/K)+(r-v**2/2)*T)/(v*sqrt(T)); claim e = d-v*sqrt(T)",
    "equations-of-fields/black-scholes-d2-wrong":
        "S := 1; K := 1; T := 1; v := 2; r := 0; d := 1; e := -1; given d = (ln(S/K)+(r+v**2/2)*T)/(v*sqrt(T)); claim e = d-v**2*sqrt(T)",
    "equations-of-fields/black-scholes-densities":
        "S K T v > 0; r; d := (ln(S/K)+(r+v**2/2)*T)/(v*sqrt(T)); e := d-v*sqrt(T); claim S*exp(-d**2/2) = K*exp(-r*T)*exp(-e**2/2)",
    "equations-of-fields/black-scholes-densities-wrong":
        "S := 1; K := 1; T := 1; v := 1; r := 1; d := 3/2; e := 1/2; given d = (ln(S/K)+(r+v**2/2)*T)/(v*sqrt(T)); claim S*exp(-d**2/2) = K*exp(r*T)*exp(-e**2/2)",
    "equations-of-fields/snell-brewster":
        "a b > 0; t := atan(b/a); p := pi/2-t; given a*sin(t) = b*sin(p); claim a*sin(t) = b*cos(t)",
    "equations-of-fields/snell-brewster-wrong":
        "a := 2; b := 1; t := atan(1/2); p := pi/2-t; given a*sin(t) = b*sin(p); claim a*cos(t) = b*sin(t)",
    "equations-of-fields/fresnel":
        "p t; if sin(p) != 0; n := sin(t)/sin(p); if n > 0; r := (cos(t)-n*cos(p))/(cos(t)+n*cos(p)); claim r*sin(t+p) = -sin(t-p)",
    "equations-of-fields/fresnel-wrong":
        "p := pi/6; t := pi/4; n := sin(t)/sin(p); r := (cos(t)-n*cos(p))/(cos(t)+n*cos(p)); claim r*sin(t+p) = sin(t-p)",
    "equations-of-fields/routh":
        "x := 2; p := x*x+x+1; s := (x**3-1)**2/p**3; claim s = 1/7",
    "equations-of-fields/routh-wrong":
        "x := 2; p := x*x+x+1; s := (x**3-1)**2/p**3; claim s = 1/9",
    "equations-of-fields/mobius-composed":
        "a b c d x; y := (a*x+b)/(c*x+d); z := (a*y+b)/(c*y+d); claim z*(a*c*x+b*c+c*d*x+d**2) = a**2*x+a*b+b*c*x+b*d",
    "equations-of-fields/mobius-composed-wrong":
        "a := 1; b := 1; c := 0; d := 1; x := 0; y := 1; z := 2; claim z*1 = 0",
    "equations-of-fields/cross-ratio":
        "a b c d k; m(t) := (t+k)/(1-k*t); p := m(a); q := m(b); r := m(c); s := m(d); claim (p-r)*(q-s)/((p-s)*(q-r)) = (a-c)*(b-d)/((a-d)*(b-c))",
    "equations-of-fields/cross-ratio-wrong":
        "a := 1; b := 2; c := 3; d := 5; k := 0; m(t) := t; p := 1; q := 2; r := 3; s := 5; claim (p-r)*(q-s)/((p-s)*(q-r)) = (a-d)*(b-c)/((a-c)*(b-d))",
    "equations-of-fields/quadratic-formula":
        "a b c; s sign; if a != 0; x := (-b+s*sqrt(b**2-4*a*c))/(2*a); claim a*x**2+b*x+c = 0",
    "equations-of-fields/quadratic-formula-wrong":
        "a := 2; b := 0; c := -2; x := (-b+sqrt(b**2-4*a*c))/2; claim a*x**2+b*x+c = 0",
    "equations-of-fields/citardauq":
        "a b c; s sign; if a*c != 0; x := 2*c/(-b+s*sqrt(b**2-4*a*c)); claim a*x**2+b*x+c = 0",
    "equations-of-fields/citardauq-wrong":
        "a := 1; b := -3; c := 2; x := 2*c/(b+sqrt(b**2-4*a*c)); claim a*x**2+b*x+c = 0",
    "equations-of-fields/heron":
        "c > 0; x h; b := sqrt(x**2+h**2); a := sqrt((c-x)**2+h**2); if a*b > 0; s := (a+b+c)/2; claim c**2*h**2/4 = s*(s-a)*(s-b)*(s-c)",
    "equations-of-fields/heron-wrong":
        "c := 4; x := 0; h := 3; b := 3; a := 5; s := 6; claim c**2*h**2/2 = s*(s-a)*(s-b)*(s-c)",
    "equations-of-fields/law-of-cosines":
        "a b > 0; C; claim (a-b*cos(C))**2+(b*sin(C))**2 = a**2+b**2-2*a*b*cos(C)",
    "equations-of-fields/law-of-cosines-wrong":
        "a := 1; b := 1; C := pi/3; claim (a-b*cos(C))**2+(b*sin(C))**2 = a**2+b**2+2*a*b*cos(C)",
    "equations-of-fields/spherical-cosines":
        "a b C; u := cos(b); v := sin(b)*cos(C); w := sin(b)*sin(C); claim (u-cos(a))**2+(v-sin(a))**2+w**2 = 2-2*(cos(a)*cos(b)+sin(a)*sin(b)*cos(C))",
    "equations-of-fields/spherical-cosines-wrong":
        "a := pi/2; b := pi/2; C := 0; u := 0; v := 1; w := 0; claim u**2+(v-1)**2+w**2 = 2+2",
    "equations-of-fields/haversine":
        "p q; h := sin((p-q)/2)**2; claim cos(p)*cos(q)+sin(p)*sin(q) = 1-2*h",
    "equations-of-fields/haversine-wrong":
        "p := pi; q := 0; h := 1; claim cos(p)*cos(q)+sin(p)*sin(q) = 1-h",
    "equations-of-fields/euler-rotation":
        "a b; claim (cos(a)*cos(b))**2+(sin(a)*cos(b))**2+sin(b)**2 = 1",
    "equations-of-fields/euler-rotation-wrong":
        "a := 0; b := pi/2; claim (cos(a)*cos(b))**2+(sin(a)*cos(b))**2-sin(b)**2 = 1",
    "equations-of-fields/euler-orthogonal":
        "a b g; claim cos(a)*cos(b)*(cos(a)*sin(b)*sin(g)-sin(a)*cos(g))+sin(a)*cos(b)*(sin(a)*sin(b)*sin(g)+cos(a)*cos(g))-sin(b)*cos(b)*sin(g) = 0",
    "equations-of-fields/euler-orthogonal-wrong":
        "a := pi/4; b := 0; g := 0; claim cos(a)*sin(a)+sin(a)*cos(a) = 0",
    "equations-of-fields/pendulum-period":
        "L g > 0; T := 2*pi*sqrt(L/g); claim g = 4*pi**2*L/T**2",
    "equations-of-fields/pendulum-period-wrong":
        "L := 1; g := 1; T := 2*pi; claim g = 2*pi*L/T**2",
    "equations-of-fields/projectile-range":
        "v g > 0; a in (0, pi); t := 2*v*sin(a)/g; x := v*t*cos(a); claim x = v**2/g*sin(2*a)",
    "equations-of-fields/projectile-range-wrong":
        "v := 1; g := 1; a := pi/4; t := 2*sin(a); x := t*cos(a); claim x = sin(2*a)/2",
    "equations-of-fields/elastic-collision":
        "m M > 0; u U; v := ((m-M)*u+2*M*U)/(m+M); V := ((M-m)*U+2*m*u)/(m+M); given m*u**2+M*U**2 = m*v**2+M*V**2; claim (u-v)*(u+v-U-V) = 0",
    "equations-of-fields/elastic-collision-wrong":
        "m := 1; M := 1; u := 1; U := 0; v := 1; V := 0; given m*u+M*U = m*v+M*V; given m*u**2+M*U**2 = m*v**2+M*V**2; claim u+v = U+V",
    "equations-of-fields/arrhenius":
        "A R T S > 0; E; k := A*exp(-E/(R*T)); p := A*exp(-E/(R*S)); claim ln(k/p) = E/R*(1/S-1/T)",
    "equations-of-fields/arrhenius-wrong":
        "A := 1; R := 1; T := 1; S := 2; E := 1; k := exp(-1); p := exp(-1/2); claim ln(k/p) = E/R*(1/T-1/S)",
    "equations-of-fields/van-der-waals-critical":
        "a b R > 0; V := 3*b; T := 8*a/(27*R*b); claim R*T/(V-b)-a/V**2 = a/(27*b**2)",
    "equations-of-fields/van-der-waals-critical-wrong":
        "a := 1; b := 1; R := 1; V := 3; T := 8/27; claim R*T/(V-b)-a/V**2 = 8*a/(27*b**2)",
    "equations-of-fields/hardy-weinberg":
        "p; q := 1-p; claim (2*p*q)**2 = 4*p**2*q**2",
    "equations-of-fields/hardy-weinberg-wrong":
        "p := 1/2; q := 1/2; claim (2*p*q)**2 = 2*p**2*q**2",
    "equations-of-fields/compton":
        "a h m c > 0; t; b := a+h/(m*c)*(1-cos(t)); claim b = a+2*h/(m*c)*sin(t/2)**2",
    "equations-of-fields/compton-wrong":
        "a := 1; h := 1; m := 1; c := 1; t := pi; b := 3; claim b = a+h/(m*c)*sin(t/2)**2",
    "equations-of-fields/annuity":
        "P r > 0; n int; if n >= 1; claim P*r*(1+r)**n/((1+r)**n-1) = P*r/(1-(1+r)**(-n))",
    "equations-of-fields/annuity-wrong":
        "P := 1; r := 1; n := 1; claim P*r*(1+r)**n/((1+r)**n-1) = P*r/(1+(1+r)**(-n))",
    "equations-of-fields/schwarz-two":
        "a b c d; claim (a*c+b*d)**2 <= (a**2+b**2)*(c**2+d**2)",
    "equations-of-fields/schwarz-two-wrong":
        "a := 0; b := 0; c := 0; d := 0; claim (a*c+b*d)**2 < (a**2+b**2)*(c**2+d**2)",
    "equations-of-fields/euler-four-squares:c1":
        "a b c d p q r s; claim (a**2+b**2+c**2+d**2)*(p**2+q**2+r**2+s**2) = (a*p+b*q+c*r+d*s)**2+(a*q-b*p+c*s-d*r)**2+(a*r-b*s-c*p+d*q)**2+(a*s+b*r-c*q-d*p)**2",
    "equations-of-fields/euler-four-squares:c2":
        "a b c d p q r s; claim (a**2+b**2+c**2+d**2)*(p**2+q**2+r**2+s**2) = (a*p+b*q+c*r+d*s)**2+(a*q-b*p+c*s+d*r)**2+(a*r-b*s-c*p+d*q)**2+(a*s+b*r-c*q-d*p)**2",
    "equations-of-fields/wave-numbers:c1":
        "k c > 0; A x t; w := c*k; claim A*sin(k*x-w*t)+A*sin(k*x+w*t) = 2*A*sin(k*x)*cos(w*t)",
    "equations-of-fields/wave-numbers:c2":
        "k := 1; c := 1; w := 1; A := 1; B := 0; x := 0; t := pi/2; claim A*sin(k*x-w*t)+B*sin(k*x+w*t) = (A+B)*sin(k*x)*cos(w*t)",
    "equations-of-fields/wave-numbers:c3":
        "k c > 0; x t; w := c*k; claim sin(k*x-w*t) = sin(k*(x-c*t))",
    # reading
    "reading/planck-fraction":
        "h; b := h/(2*pi); claim 2*pi*b = h",
    "reading/planck-fraction-wrong":
        "h := 1; b := 1/(2*pi); claim b = h/2*pi",
    "reading/half-in-brackets":
        "a; b := a/2; claim 2*b = a",
    "reading/half-in-brackets-wrong":
        "a := 2; b := 1; given b = a/2; claim b = 1/(2*a)",
    "reading/number-slash-number":
        "x; claim x/2+x/2 = x",
    "reading/number-slash-number-wrong":
        "x := 1; claim x/3+x/3 = x",
    "reading/new-name-in-claim":
        "a b x; c := -a*x**2-b*x; claim (2*a*x+b)**2 = b**2-4*a*c",
    "reading/new-name-in-claim-wrong":
        "a := 1; b := 0; c := -1; x := 1; given a*x**2+b*x+c = 0; claim (2*a*x+b)**2 = b**2-a*c",
    "reading/decimal":
        "x := 1.5; claim x = 3/2",
    "reading/decimal-wrong":
        "x := 1.5; claim x = 1.500000000000000000001",
    "reading/conditions-within-a-formula:2":
        "x; if x > 0; claim abs(x) = x",
    "reading/conditions-beside-a-formula:c1":
        "x; if x < 0; claim sqrt(x**2) = -x",
    "reading/conditions-beside-a-formula:c2":
        "x; if x < 0; claim sqrt(x**2) = -x",
    "reading/conditions-beside-a-formula:c3":
        "x; if x < 0; claim sqrt(x**2) = -x",
    "reading/conditions-beside-a-formula:c4":
        "x := 1; claim sqrt(x**2) = -x",
    "reading/conditions-beside-a-formula:c6":
        "n := 1/2; claim cos(n*pi)**2 = 1",
    "reading/conditions-beside-a-formula:c7":
        "x y; if x < 0; if y > 0; claim abs(x*y) = -x*y",
    "reading/conditions-beside-a-formula:c8":
        "x := -1; y := 1; claim (x+y)**2 = x**2+y**2",
    "reading/conditions-beside-a-formula:c9":
        "x; if x != 1; claim (x**2-1)/(x-1) = x+1",
    "reading/unread-stops-nothing:c2":
        "x y; claim x+y = y+x",
    # relations
    "relations/claims-as-premises:c1":
        "x := 1; claim x = 2",
    "relations/claims-as-premises:c2":
        "x := 2; claim x**2 = 4",
    "relations/claims-as-premises:c3":
        "x := 2; claim x**3 = 7",
    "relations/assume-travels:c1":
        "x; if x != 1; y := x+1; given x**2-1 = (x-1)*y; claim y = x+1",
    "relations/assume-travels:c2":
        "x; if x != 1; y := x+1; claim abs(x-1) > 0",
    "relations/assume-travels:c3":
        "x := 1; y := 0; given x**2-1 = (x-1)*y; claim x**2+x = x*y",
}


def truths(text):
    """The truth of each claim of a sheet, by label ("" where there is one), and faults of its form."""
    sheet = tomllib.loads(text)
    # a claim `A <=> B` has a truth for each of its ways, `c =>` and `c <=`
    found = dict(re.findall(r"^# truth ?(.*?): (true|false|contradictory|ambiguous|unread|unknown)$", text, re.M))
    faults = [] if "# because" in text else ["no `# because:`"]
    claims = [entry for entry in sheet["equation"] if entry["role"] == "claim"]
    wanted = {"true": "proved", "false": "refuted"}
    for entry in claims:
        label = str(entry["label"])
        if not any(own.strip("[]") in ("", label) or own.startswith(label + " ") for own in found):
            faults.append(f"{label}: no truth")
        truth = found.get(label, found.get(""))
        # the tests hold verdicts against the truths: what is expected need not be said
        if truth in wanted and entry.get("expect", wanted[truth]) != wanted[truth]:
            faults.append(f"{entry['label']}: `expect` does not say {wanted.get(truth)}")
    return found, faults


def main():
    random.seed(20)
    arguments = [word for word in sys.argv[1:] if word != "-v"]
    counts, unchecked, failures = Counter(), [], []
    sheets = [
        (file.stem, *sheet.split("\n", 1))
        for file in sorted(HERE.glob("*.sheets"))
        for sheet in ("\n" + file.read_text()).split("\n=== ")[1:]
    ]
    names = set()
    for klass, stem, text in sheets:
        name = f"{klass}/{stem}"
        found, faults = truths(text)
        failures += [f"{name}: {fault}" for fault in faults]
        for label, truth in found.items():
            key = f"{name}:{label}" if label else name
            names.add(key)
            counts[klass, truth] += 1
            if arguments and not any(word in key for word in arguments):
                continue
            if key not in TABLE:
                unchecked.append(key)
                continue
            try:
                fault, shown = check(TABLE[key], truth)
            except Exception as error:  # a recipe that cannot be run is a failure like any other
                fault, shown = f"{type(error).__name__}: {error}", None
            if fault:
                failures.append(f"{key} ({truth}): {fault}")
            elif shown and "-v" in sys.argv:
                print(f"{key}: {shown}")
    failures += [f"{key}: a recipe without a sheet" for key in sorted(set(TABLE) - names)]
    kinds = ["true", "false", "contradictory", "ambiguous", "unread"]
    print(f"{'class':22}" + "".join(f"{kind:>14}" for kind in kinds))
    for folder in sorted({folder for folder, _ in counts}) + ["all"]:
        row = [sum(n for (f, k), n in counts.items() if k == kind and folder in (f, "all")) for kind in kinds]
        print(f"{folder:22}" + "".join(f"{n:14}" for n in row))
    print(f"{len(sheets)} sheets, {sum(counts.values())} claims, {len(TABLE)} with a recipe")
    if "-v" in sys.argv:
        print("on their proofs alone: " + ", ".join(unchecked))
    for failure in failures:
        print(f"WRONG {failure}")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
