"""Checks files of proof data of vibro-audit: python3 check.py FILE.json ...

It shares no line with the program that wrote the files, and trusts nothing of them but the statement: what is given and
what is claimed. It needs python-flint (pip install python-flint): its polynomials, and its balls, which enclose numbers
with a bound of the error. crates/prover/proof-data.md of vibro-audit describes files, steps and points. A polynomial has
variables for terms, each of which stands for its own value. A fact is a property of a polynomial; each step of a proof
adds facts that follow from those before it.
"""

import functools
import itertools
import json
import math
import re
import resource
import signal
import sys

from flint import acb, arb, ctx, fmpq, fmpq_mpoly_ctx

ZERO, NONZERO, POSITIVE, NONNEGATIVE, INTEGER = "zero", "nonzero", "positive", "nonnegative", "integer"
IMPLIED_BY = {ZERO: (ZERO,), NONZERO: (NONZERO, POSITIVE), POSITIVE: (POSITIVE,), INTEGER: (INTEGER,)}
IMPLIED_BY[NONNEGATIVE] = (NONNEGATIVE, POSITIVE, ZERO)
FUNCTIONS = ("sin", "cos", "exp", "ln", "arcsin", "arccos", "arctan")
LARGEST_FILE, LARGEST_MEMORY, LONGEST = 1 << 26, 1 << 32, 120  # characters, bytes, seconds
BITS, MORE_BITS = (128, 320, 800), (128, 800, 12800)  # of the balls that show a sign in a proof, and at a point
MOST_PRODUCTS, MORE_VARIABLES = 20_000_000, 40  # of terms of two polynomials; beyond those for terms of the file
ELSEWHERE = " is not checked here: --format rocq may write it"

# what is true of all numbers, a row each: name, letters, guards, conclusion, source
ROWS = """
@AXIOMS@"""
COLUMNS = [[part.strip() for part in row.split("|")] for row in ROWS.splitlines() if row and not row.startswith("#")]
AXIOMS = {name: (letters.split(), guards.split("; "), then) for name, letters, guards, then, _ in COLUMNS}
SLOPES = {"sin": "cos(x)", "cos": "-sin(x)", "exp": "exp(x)", "ln": "1 / x", "root": "root(n, x) / (n * x)"}
SLOPES.update(arcsin="1 / root(2, 1 - x^2)", arccos="-(1 / root(2, 1 - x^2))", arctan="1 / (1 + x^2)")
SCHEMA = json.loads(r"""@SCHEMA@""")
ERRORS = (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError, MemoryError, OSError)


class Refused(Exception):
    """A step that does not follow, or a premise that does not hold."""


def require(holds, why):
    if not holds:
        raise Refused(why)


# --- polynomials -----------------------------------------------------------------------------------------------------


def rational(text):
    above, _, below = text.partition("/")
    return fmpq(int(above), int(below or 1))


def times(a, b):
    require(len(a) * len(b) <= MOST_PRODUCTS, "polynomials too long to multiply out")
    return a * b


def power(a, exponent):
    require(exponent <= 4000, "an exponent too large to multiply out")
    if len(a) <= 1 or exponent < 2:
        return a**exponent
    half = power(a, exponent // 2)
    return times(times(half, half), a ** (exponent % 2))


def ratio(a, b):
    """The number by which b is multiplied to be a; None where there is none, or both are 0."""
    if len(a) != len(b) or a.is_zero():
        return None
    factor = a.leading_coefficient() / b.leading_coefficient()
    return factor if a == b * factor else None


# --- terms -----------------------------------------------------------------------------------------------------------


class Term:
    """A number, symbol, function or operation: `kind`, and what it is `of`. Equal ones are the same object."""

    known = {}

    def __new__(cls, kind, *of):
        term = cls.known.get((kind, *of))
        if term is None:
            term = cls.known[(kind, *of)] = object.__new__(cls)
            term.kind, term.of, term.number = kind, of, len(cls.known) - 1
            term.parts = tuple(part for part in of if isinstance(part, Term))
            own = of if kind == "symbol" else ()
            term.symbols = frozenset(own).union(*(part.symbols for part in term.parts))
            term.is_closed = kind not in ("symbol", "value") and all(part.is_closed for part in term.parts)
        return term

    __add__ = lambda self, other: Term("sum", self, as_term(other))
    __sub__ = lambda self, other: Term("sum", self, -as_term(other))
    __rsub__ = lambda self, other: as_term(other) - self
    __neg__ = lambda self: Term("product", as_term(-1), self)
    __mul__ = lambda self, other: Term("product", self, as_term(other))
    __rmul__ = lambda self, other: as_term(other) * self
    __truediv__ = lambda self, other: Term("quotient", self, as_term(other))
    __rtruediv__ = lambda self, other: as_term(other) / self
    __pow__ = lambda self, exponent: Term("power", self, written(exponent))


def as_term(of):
    return of if isinstance(of, Term) else Term("number", fmpq(of))


def inside(*terms):
    """The terms and all that they are made of, parts first."""
    met, open_ = set(terms), list(terms)
    while open_:
        new = set(open_.pop().parts) - met
        met |= new
        open_ += new
    return sorted(met, key=lambda term: term.number)


def rewrite(term, new):
    """The term with parts replaced: `new` gives for what is made of replaced parts another term, or None."""
    done = {}
    for inner in inside(term):
        made = Term(inner.kind, *(done.get(part, part) if isinstance(part, Term) else part for part in inner.of))
        done[inner] = new(made) or made
    return done[term]


def put_in(term, values):
    """The term with values for symbols."""
    if term.symbols.isdisjoint(values):
        return term
    return rewrite(term, lambda inner: values.get(inner.of[0]) if inner.kind == "symbol" else None)


def written(number, least=0):
    """An index or exponent that is written out."""
    kind, value = as_term(number).kind, as_term(number).of[0]
    require(kind == "number" and value.q == 1 and value >= least, "an index or exponent is not written out")
    return int(value.p)


def read(text, letters):
    """The term of a row of the tables above, with terms for its letters. No text of a file is read so."""
    names = {name: lambda of, name=name: Term(name, of) for name in FUNCTIONS}
    names.update(pi=Term("pi"), i=Term("i"), root=lambda index, x: Term("root", written(index, 2), x))
    names["power"] = lambda base, exponent: Term("realpower", as_term(base), exponent)
    names["product"] = lambda *of: Term("product", *map(as_term, of))
    text = re.sub(r"(\w+) \* (\w+) \* (\w+)\b(?!\()", r"product(\1, \2, \3)", text).strip().replace("^", "**")
    return as_term(eval(text, {"__builtins__": {}}, {**names, **letters}))


def relation(text, letters):
    signs = ((" = ", ZERO), (" != ", NONZERO), (" >= ", NONNEGATIVE), (" > ", POSITIVE))
    sign, holds = next(pair for pair in signs if pair[0] in text)
    left, right = text.split(sign)
    return holds, read(left, letters) if right == "0" else read(left, letters) - read(right, letters)


class Statement:
    """What is given and what is claimed, with the terms of a proof or a point. A symbol or function is a number."""

    def __init__(self, data, more):
        Term.known, self.bits, self.values = {}, BITS, {}
        plain = ("number", "sum", "product", "power", "quotient")
        count = sum(node[0] not in plain for node in data["terms"] + more["terms"]) + MORE_VARIABLES
        self.ring = fmpq_mpoly_ctx.get(["g%d" % n for n in range(count)], "lex")
        self.variables, self.order, self.place = self.ring.gens(), [], {}
        self.zero, self.one = self.ring.constant(0), self.ring.constant(1)
        self.terms, self.symbols, self.functions, self.times = [], [], [], {}  # times of impacts, by their index
        for own in (data, more):
            for _, *meaning in own["symbols"]:
                self.symbol(*meaning)
            self.functions += [meaning for meaning in map(tuple, own["functions"]) if meaning not in self.functions]
            for node in own["terms"]:
                self.read(*node)
        conditions = lambda own: [(holds, self.terms[of]) for holds, of in own]
        for name in ("complex", "letter", "states", "continuous", "flight", "generic", "complex_symbols"):
            setattr(self, name, data[name])
        self.dots = {name: chain for chain in data["dots"] for name in chain[:1]}
        self.definitions = {symbol: self.terms[of] for symbol, of in data["definitions"]}
        self.derivatives = dict(data["derivatives"])
        require(max(self.definitions, default=-1) < len(self.symbols), "an abbreviation that is no symbol")
        law = lambda own: (*own[:3], conditions(own[3])) if own else None
        self.givens = [(label, holds, self.terms[of], law(own)) for label, holds, of, own in data["givens"]]
        self.goals = conditions(data["goals"])

    def read(self, kind, *of):
        require(kind != "root" or of[0] >= 2, "a root of an index below 2")
        own = [self.terms[number] for number in of[0]] if kind in ("sum", "product") else list(of)
        require(kind not in ("integral", "bound"), "an integral of numbers" + ELSEWHERE)
        table = {"symbol": self.symbols, "value": self.functions}.get(kind)
        require(table is None or of[0] < len(table), "no such symbol or function")
        places = {"power": "0", "quotient": "01", "realpower": "01", "root": "1", "value": "2"}
        for place in map(int, places.get(kind, "0" if kind in FUNCTIONS else "")):
            own[place] = self.terms[own[place]]
        own = [rational(of[0])] if kind == "number" else own
        require(Term(kind, *own).number == len(self.terms), "terms out of order")
        self.terms.append(Term(kind, *own))

    def symbol(self, *meaning):
        if meaning not in self.symbols:
            self.symbols.append(meaning)
            if meaning[0] == "time":
                self.times.setdefault(meaning[2], len(self.symbols) - 1)
        return self.symbols.index(meaning)

    def generator(self, term):
        if term not in self.place:
            self.place[term] = len(self.order)
            self.order.append(term)
        return self.variables[self.place[term]]

    def generators(self, p):
        return [self.order[n] for n, degree in enumerate(p.degrees()) if degree > 0]

    def polynomial(self, data):
        total = {}
        for coefficient, flat in data:
            terms, exponents = flat[::2], [0] * len(self.variables)
            in_order = len(flat) % 2 == 0 and terms == sorted(set(terms)) and all(flat[1::2])
            require(in_order, "a monomial out of order, or an exponent of 0")
            for term, exponent in zip(terms, flat[1::2]):
                self.generator(self.terms[term])
                exponents[self.place[self.terms[term]]] = exponent
            total[tuple(exponents)] = total.get(tuple(exponents), 0) + rational(coefficient)
        return self.ring.from_dict(total)

    def written_out(self, term):
        """Without abbreviations."""
        for _ in range(len(self.definitions) + 1):
            term = put_in(term, self.definitions)
        return term

    def is_real(self, term):
        kinds = {inner.kind for inner in inside(term)}
        plain = kinds.isdisjoint(("i", "realpower", "ln", "root", "arcsin", "arccos") if self.complex else "i")
        own = lambda symbol: self.symbols[symbol][0] != "fresh" and symbol not in self.complex_symbols
        named = [self.definitions[symbol] for symbol in term.symbols & self.definitions.keys()]
        return plain and (not self.complex or (all(map(own, term.symbols)) and all(map(self.is_real, named))))

    # impacts and flights
    def state(self, name, index, after):
        return Term("symbol", self.symbol("state", name, index, int(bool(after) and name not in self.continuous)))

    def dotted(self, name, order):
        return dict(enumerate(self.dots.get(name, [name]))).get(order)

    def in_flight(self, name, impact, order, at):
        """A state in a flight; at the impacts at its ends, the state just after or just before."""
        named = self.dotted(name, order)
        for index in (impact, impact + 1):
            if named in self.states and index in self.times and at is Term("symbol", self.times[index]):
                return self.state(named, index, index == impact)
        self.functions += {("flight", name, impact)} - set(self.functions)
        return Term("value", self.functions.index(("flight", name, impact)), order, at)

    def moved(self, term, time, at, shift):
        """The term with its running time replaced and its impacts moved on."""
        def new(inner):
            if inner.kind == "value" and self.functions[inner.of[0]][0] == "flight":
                _, name, impact = self.functions[inner.of[0]]
                return self.in_flight(name, impact + shift, *inner.of[1:])
            if inner.kind != "symbol" or (time is not None and inner.of[0] == time):
                return at if inner.kind == "symbol" else None
            kind, *of = self.symbols[inner.of[0]]
            require(not shift or kind not in ("partial", "invariant"), "what is said of a map is not moved on")
            if shift and kind == "time":
                return Term("symbol", self.symbol("time", of[0], of[1] + shift))
            if shift and kind == "state":
                return self.state(of[0], of[1] + shift, of[2])
            return inner + shift if shift and (kind, *of) == ("parameter", self.letter) else None
        return rewrite(term, new)

    # derivatives
    def derivative(self, term, slope):
        """By the rules of differentiation; `slope` gives the derivative of a symbol."""
        zero, done = as_term(0), {}
        for inner in inside(self.written_out(term)):
            kind, of, slopes = inner.kind, inner.of, [done[part] for part in inner.parts]
            if kind == "symbol":
                done[inner] = as_term(slope(of[0]))
            elif all(own is zero for own in slopes):
                done[inner] = zero
            elif kind == "sum":
                done[inner] = Term("sum", *[own for own in slopes if own is not zero])
            elif kind == "product":
                one = lambda n: Term("product", *[*of[:n], slopes[n], *of[n + 1 :]])
                done[inner] = Term("sum", *[one(n) for n, own in enumerate(slopes) if own is not zero])
            else:
                done[inner] = self.outer_slope(inner, slopes[0], slopes[-1])
        return done[inner]

    def outer_slope(self, term, first, last):
        kind, of = term.kind, term.of
        if kind == "power":
            return (of[0] ** (of[1] - 1) if of[1] > 1 else as_term(1)) * of[1] * last
        if kind == "quotient":
            return first / of[1] - term * (last / of[1])
        if kind == "value":
            function, order = of[0], of[1] + 1
            while order and function in self.derivatives:
                function, order = self.derivatives[function], order - 1
            return Term("value", function, order, of[2]) * last
        require(not self.complex or kind in ("sin", "cos", "exp"), "a principal branch may not be continuous")
        if kind == "realpower":
            return term * (last * Term("ln", of[0]) + of[1] * (first / of[0]))
        return read(SLOPES[kind], {"x": of[-1], "n": of[0]}) * last
    by = lambda self, term, symbol: self.derivative(term, lambda other: int(other == symbol))

    # domains
    def domain(self, *terms):
        """What must hold for terms to have values."""
        met, conditions = inside(*terms), []
        for inner in met:
            kind, of = inner.kind, inner.of
            if kind == "symbol" and of[0] in self.definitions:
                met += [new for new in inside(self.definitions[of[0]]) if new not in met]
            if kind == "quotient" or (kind == "ln" and self.complex):
                conditions.append((NONZERO, of[-1]))
            elif kind == "ln" or (kind == "root" and not self.complex and of[0] % 2 == 0):
                conditions.append((POSITIVE if kind == "ln" else NONNEGATIVE, of[-1]))
            elif kind in ("arcsin", "arccos") and not self.complex:
                conditions += [(NONNEGATIVE, 1 - of[0]), (NONNEGATIVE, as_term(1) + of[0])]
        return conditions

    def holding_near(self, conditions, terms, moves):
        """What must hold besides for what holds at a point under conditions to hold near it too, as symbols move."""
        moving = lambda term: any(map(moves, term.symbols))
        conditions = [(holds, of) for holds, of in conditions if moving(of)]
        require(not {ZERO, INTEGER} & {holds for holds, _ in conditions}, "what is differentiated holds on no open set")
        powers = [inner.of for inner in inside(*terms) if inner.kind == "realpower" and moving(inner)]
        near = [(POSITIVE if moving(exponent) else NONZERO, base) for base, exponent in powers]
        return near + [(NONZERO, of) for holds, of in conditions if holds == NONNEGATIVE]

    def evaluate(self, term, values):
        """A ball around the value of a term without symbols, or a short rational number; `values` are known ones."""
        for inner in inside(term):
            if inner not in values:
                require(inner.kind not in ("symbol", "value"), "a number with a symbol or function in it")
                found = self.value(inner.kind, inner.of, [values[part] for part in inner.parts])
                found = acb(found) if isinstance(found, fmpq) and found.height_bits() > 4096 else found
                is_fine = isinstance(found, fmpq) or (found.is_finite() and (self.complex or found.imag.is_zero()))
                require(is_fine, "a term without a value, or with one that is not real")
                values[inner] = found
        return values[term]

    def value(self, kind, of, values):
        """The value of what is `of` parts with these values."""
        if kind in ("number", "pi", "i"):
            return of[0] if kind == "number" else acb(arb.pi()) if kind == "pi" else acb(0, 1)
        if kind in ("sum", "product"):
            return sum(values, fmpq(0)) if kind == "sum" else math.prod(values, start=fmpq(1))
        x, y = values[0], values[-1]
        if kind == "quotient":
            require(away(y), "a divisor may be 0")
            return x / y
        if kind == "power" or (kind == "realpower" and isinstance(y, fmpq) and y.q == 1):
            return raised(x, of[1] if kind == "power" else int(y.p))
        x, has_value = acb(x), away(x) and (self.complex or acb(x).real > 0)
        if kind in ("sin", "cos", "exp"):
            return getattr(x, kind)()
        if kind in ("ln", "realpower") or (kind == "root" and self.complex and x != 0):
            require(has_value, "a logarithm or power without a value")
            return x.log() if kind == "ln" else x.pow(acb(y) if kind == "realpower" else acb(fmpq(1, of[0])))
        if kind == "root":
            # it grows with what it is of
            low, high = x.real.lower(), x.real.upper()
            require(of[0] % 2 == 1 or low >= 0, "a root without a value")
            root = lambda end: -((-end).root(of[0])) if end < 0 else end.root(of[0]) if end > 0 else arb(0)
            return acb(root(low).union(root(high)))
        is_real = x.imag.is_zero() and (kind == "arctan" or abs(x.real) < 1)
        require(is_real or not self.complex, "an inverse function that may be on its cut")
        return {"arctan": acb.atan, "arcsin": acb.asin, "arccos": acb.acos}[kind](x)

    def enclosed(self, p, bits, values):
        """A ball around the values of a polynomial; None where it may have none."""
        ctx.prec, total = bits, acb(0)
        try:
            for exponents, coefficient in p.to_dict().items():
                powers = [(self.order[n], exponent) for n, exponent in enumerate(exponents) if exponent]
                factors = (raised(self.evaluate(term, values), exponent) for term, exponent in powers)
                total += math.prod(factors, start=acb(coefficient))
        except (Refused, ZeroDivisionError, ValueError):
            return None
        return total if total.is_finite() else None

    def sign(self, p):
        """The sign of a number: 1 or -1, or 0 of one that is not real; None where balls do not tell."""
        if p.is_constant():
            value = p.leading_coefficient()
            return (value > 0) - (value < 0) or None
        for bits in self.bits if all(term.is_closed for term in self.generators(p)) else ():
            found = self.enclosed(p, bits, self.values.setdefault(bits, {}))
            if found is not None and away(found):
                return 0 if not found.imag.is_zero() else 1 if found.real > 0 else -1
        return None


def away(value):
    """Whether a number is not 0 for certain."""
    return value != 0 if isinstance(value, fmpq) else not value.contains(0)


def raised(base, exponent):
    require(abs(exponent) <= 100_000 and (exponent >= 0 or away(base)), "a power without a value")
    return (base if abs(exponent) <= 64 or not isinstance(base, fmpq) else acb(base)) ** exponent


class Expansion:
    """Terms as a numerator over powers of divisors, of which each begins with 1; those in `whole` stay as they are."""

    def __init__(self, s, whole=()):
        self.s, self.done, self.divisors, self.whole = s, {}, [], {s.terms[number] for number in whole}

    def of(self, term):
        if term not in self.done:
            self.done[term] = (self.s.generator(term), {}) if term in self.whole else self.unfolded(term)
        return self.done[term]

    def unfolded(self, term):
        kind, of = term.kind, term.of
        if kind == "number":
            return self.s.one * of[0], {}
        if kind in ("sum", "product"):
            join, start = (self.plus, self.s.zero) if kind == "sum" else (self.product, self.s.one)
            return functools.reduce(join, map(self.of, of), (start, {}))
        if kind == "power":
            (above, below), exponent = self.of(of[0]), of[1]
            require(exponent >= 0, "a negative power")
            return power(above, exponent), {key: n * exponent for key, n in below.items() if exponent}
        if kind == "quotient":
            above, (numerator, below) = self.of(of[0]), self.of(of[1])
            require(not numerator.is_zero(), "a divisor is 0")
            named = lambda exponents: sorted((self.s.order[n].number, e) for n, e in enumerate(exponents) if e)
            _, first = min((named(exponents), value) for exponents, value in numerator.to_dict().items())
            divisor, inverse = numerator / first, self.over(below) / first
            if divisor.is_constant():
                return self.product(above, (inverse, {}))
            self.divisors += [] if divisor in self.divisors else [divisor]
            return self.product(above, (inverse, {self.divisors.index(divisor): 1}))
        return self.s.generator(term), {}

    def over(self, divisors):
        """The product of powers of divisors."""
        return functools.reduce(times, (power(self.divisors[key], n) for key, n in divisors.items()), self.s.one)

    def product(self, a, b):
        return times(a[0], b[0]), {key: a[1].get(key, 0) + b[1].get(key, 0) for key in {**a[1], **b[1]}}

    def plus(self, a, b):
        common = {key: max(a[1].get(key, 0), b[1].get(key, 0)) for key in {**a[1], **b[1]}}
        lacking = lambda own: self.over({key: n - own.get(key, 0) for key, n in common.items()})
        return times(a[0], lacking(a[1])) + times(b[0], lacking(b[1])), common

    def property_of(self, holds, term):
        """The polynomial that has the property where the term has it."""
        numerator, divisors = self.of(term)
        require(holds != INTEGER or not divisors, "an integer is given by a quotient")
        odd = self.over({key: 1 for key, n in divisors.items() if n % 2 and holds in (POSITIVE, NONNEGATIVE)})
        require(all(map(self.s.is_real, self.s.generators(odd))), "an order of quotients of complex numbers")
        return times(numerator, odd)


# --- proofs ----------------------------------------------------------------------------------------------------------


class Proof:
    """Follows the steps of a proof."""

    def __init__(self, s, certificate):
        self.s, self.expansion, self.running, self.absurd = s, Expansion(s, certificate["whole"]), None, False
        self.assumed = {(holds, term) for _, holds, term, law in s.givens if not law}
        self.facts, self.laws = [], []
        self.follow(certificate["steps"])

    def follow(self, steps, where="step"):
        for number, step in enumerate(steps, 1):
            try:
                require(hasattr(self, "step_" + step[0]), "such a step" + ELSEWHERE)
                getattr(self, "step_" + step[0])(*step[1:])
            except (Refused, *ERRORS) as refusal:
                raise Refused("%s %d (%s): %s" % (where, number, step[0], refusal)) from None

    # what is known
    def knows(self, holds, term):
        if self.absurd or any((own, term) in self.assumed for own in IMPLIED_BY[holds]):
            return True
        return self.knows_polynomial(holds, self.expansion.property_of(holds, term))

    def knows_polynomial(self, holds, p):
        if self.absurd or (p.is_zero() and holds in (ZERO, NONNEGATIVE)):
            return True
        if any(self.implies(*fact, holds, p) for fact in self.facts):
            return True
        if holds == INTEGER:
            is_known = lambda term: (INTEGER, term) in self.assumed or (INTEGER, self.s.generator(term)) in self.facts
            require(all(value.q == 1 for value in p.coeffs()), "an integer with coefficients that are none" + ELSEWHERE)
            return all(map(is_known, self.s.generators(p)))
        return holds != ZERO and self.s.sign(p) in ((1, 0, -1) if holds == NONZERO else (1,))

    def implies(self, known, q, holds, p):
        """Whether a property of q says another of p, which is q but for a factor."""
        factor = ratio(q, p) if known in IMPLIED_BY[holds] else None
        if factor is None or holds == INTEGER:
            return factor is not None and q == p
        return known == ZERO or holds == NONZERO or factor > 0

    def need(self, holds, term):
        require(self.knows(holds, term), "a term is not known to be %s" % holds)

    def defined(self, *terms):
        for holds, of in self.s.domain(*terms):
            self.need(holds, of)

    def reals(self, *terms):
        require(all(map(self.s.is_real, terms)), "a law of real numbers for complex ones")

    def real(self, data):
        """A polynomial of real terms."""
        p = self.s.polynomial(data)
        self.reals(*self.s.generators(p))
        return p

    def add(self, holds, p):
        self.absurd |= holds == ZERO and p.is_constant() and not p.is_zero()
        self.facts.append((holds, p))

    def conclude(self, holds, term):
        self.add(holds, self.expansion.property_of(holds, term))

    def fact(self, number, *wanted):
        holds, p = self.facts[number]
        require(holds in wanted, "fact %d is %s" % (number, holds))
        return p

    def combination(self, terms):
        return sum((times(self.s.polynomial(factor), self.fact(number, ZERO)) for factor, number in terms), self.s.zero)

    def product(self, factors, *wanted):
        return functools.reduce(times, (power(self.fact(n, *wanted), exponent) for n, exponent in factors), self.s.one)

    def identical(self, left, right):
        require(left == right, "the two sides are not the same polynomial")
    mark = lambda self: (len(self.facts), len(self.laws), self.absurd, self.running)

    def back_to(self, facts, laws, absurd, running):
        """Forgets what was added since a mark."""
        del self.facts[facts:], self.laws[laws:]
        self.absurd, self.running = absurd, running

    # the steps
    def step_given(self, number):
        _, holds, term, law = self.s.givens[number]
        require(not law, "the given is a law")
        self.conclude(holds, term)

    def step_zero(self, target, exponent, squares, factors, terms):
        """factors * (target^exponent + squares) = combination of what vanishes; no factor vanishes."""
        p = self.real(target) if squares else self.s.polynomial(target)
        require(exponent > 0 and (exponent % 2 == 0 or not squares), "the power is 0, or odd beside squares")
        require(all(rational(factor) > 0 for factor, _ in squares), "a square needs a positive factor")
        left = power(p, exponent)
        for factor, of in squares:
            left += power(self.real(of), 2) * rational(factor)
        self.identical(times(left, self.product(factors, NONZERO, POSITIVE)), self.combination(terms))
        self.add(ZERO, p)

    def step_nonzero(self, target, cofactor, factors, terms):
        """cofactor * target = product of what does not vanish + combination of what does."""
        target, cofactor = self.s.polynomial(target), self.s.polynomial(cofactor)
        self.identical(times(cofactor, target), self.product(factors, NONZERO, POSITIVE) + self.combination(terms))
        self.add(NONZERO, target)

    def step_sign(self, target, strict, factors, summands, terms):
        """positive factors * target = sum of squares times what is not negative + combination of what vanishes."""
        target, right, sure = self.real(target), self.combination(terms), False
        for factor, facts, of in summands:
            of, factor = self.real(of), rational(factor)
            require(factor > 0, "a summand needs a positive factor")
            sure |= all(self.facts[number][0] == POSITIVE for number in facts) and of.is_constant() and not of.is_zero()
            beside = self.product([(number, 1) for number in facts], POSITIVE, NONNEGATIVE)
            right += times(power(of, 2) * factor, beside)
        require(sure or not strict, "no summand is positive for certain")
        self.identical(times(self.product(factors, POSITIVE), target), right)
        self.add(POSITIVE if strict else NONNEGATIVE, target)

    def step_squeezed(self, low, high):
        low, high = (self.fact(number, POSITIVE, NONNEGATIVE) for number in (low, high))
        self.identical(low, -high)
        self.add(ZERO, low)

    def step_congruence(self, left, right):
        left, right = self.s.terms[left], self.s.terms[right]
        (*first, a), (*second, b) = left.of, right.of
        if left.kind == "realpower" and a is b:
            (a, *first), (b, *second) = left.of, right.of
        is_function = left.kind == right.kind and left.kind in (*FUNCTIONS, "root", "value", "realpower")
        require(is_function and first == second, "not the same function")
        self.defined(a - b)
        self.need(ZERO, a - b)
        self.conclude(ZERO, left - right)

    def step_cases(self, on, order, holds, target, branches):
        on, target = self.real(on) if order else self.s.polynomial(on), self.s.polynomial(target)
        cases = [(POSITIVE, on), (ZERO, on), (POSITIVE, -on)] if order else [(ZERO, on), (NONZERO, on)]
        require(len(cases) == len(branches), "not one branch for each case")
        for number, (case, steps) in enumerate(zip(cases, branches), 1):
            mark = self.mark()
            self.add(*case)
            self.follow(steps, "case %d, step" % number)
            require(self.knows_polynomial(holds, target), "case %d does not lead to what is to be shown" % number)
            self.back_to(*mark)
        self.add(holds, target)

    def step_unfold(self, term):
        term = self.s.terms[term]
        if term.kind == "symbol":
            return self.conclude(ZERO, term - self.s.definitions[term.of[0]])
        self.defined(term)
        numerator, divisors = self.expansion.unfolded(term)
        return self.add(ZERO, times(self.s.generator(term), self.expansion.over(divisors)) - numerator)

    def step_enclosure(self, p):
        p = self.s.polynomial(p)
        require(self.s.sign(p) == 1, "the value is not known to be positive")
        self.add(POSITIVE, p)

    def step_axiom(self, name, terms):
        names, guards, conclusion = AXIOMS[name]
        require(len(names) == len(terms), "an axiom of another number of letters")
        letters = dict(zip(names, map(self.s.terms.__getitem__, terms)))
        for guard in filter(None, guards):
            word, _, inner = guard.partition("(")
            if guard in ("complex", "reals"):
                require(bool(self.s.complex) == (guard == "complex"), "an axiom of other numbers")
            elif word in ("even", "odd", "natural"):
                number = written(letters[inner.rstrip(")")])
                require(word == "natural" or number % 2 == (word == "odd"), "no %s number" % word)
            elif word in ("defined", "real", "integer"):
                needs = {"defined": self.defined, "real": self.reals, "integer": functools.partial(self.need, INTEGER)}
                needs[word](read(guard[len(word) :], letters))
            else:
                holds, term = relation(guard, letters)
                self.defined(term)
                self.need(holds, term)
        self.conclude(*relation(conclusion, letters))

    # laws
    def source(self, kind, number, shift=0):
        """A law as (property, time, term, conditions, domain of what it was derived from, flight), impacts moved on."""
        if kind == "derived":
            return self.laws[number]
        _, holds, term, (time, flight, every, conditions) = self.s.givens[number]
        require(not shift or every, "the law does not extend so far")
        require(not time or self.s.symbols[time[0]][0] not in ("time", "state"), "a law over what is no time")
        moved = lambda of: self.s.moved(self.s.written_out(of), None, None, shift)
        conditions, flight = [(own, moved(of)) for own, of in conditions], [own + shift for own in flight]
        return holds, time, moved(term), conditions, [], flight

    def at_time(self, at, flight):
        """Refuses what is no time of a flight: one of its ends, or a symbol that runs over it."""
        for own in flight:
            require(at.kind == "symbol", "no time of the flight")
            runs = self.s.symbols[at.of[0]] == ("running",) and self.s.flight == flight
            is_end = at.of[0] in (self.s.times.get(own), self.s.times.get(own + 1))
            require(is_end or runs or (at.of[0], own) == self.running, "no time of the flight")

    def step_law(self, source, at):
        holds, time, term, conditions, domain, flight = self.source(*source)
        require(len(time) == len(at), "a time for a law without one, or none for one with it")
        for number in at:
            at = self.s.terms[number]
            is_fresh = at.kind == "symbol" and self.s.symbols[at.of[0]][0] == "fresh"
            require(is_fresh or self.s.is_real(at), "a law of real times at a complex one")
            self.defined(at)
            self.at_time(at, flight)
        moved = lambda of: self.s.moved(of, time[0] if time else None, at, 0)
        term, conditions = moved(term), [(own, moved(of)) for own, of in conditions + domain]
        self.defined(term, *(of for _, of in conditions))
        for condition, of in conditions:
            self.need(condition, of)
        self.conclude(holds, term)

    def step_derivative(self, source):
        holds, time, term, conditions, domain, flight = self.source(*source)
        require(holds == ZERO and time, "no law over a time that says what vanishes")
        terms = [term] + [of for _, of in conditions]
        slope, *_ = [self.s.by(of, time[0]) for of in terms]  # refuses what is not continuous
        # the law holds only where all that it came from has values: of single times that says nothing of the derivative
        domain = domain + self.s.domain(*terms)
        domain = domain + self.s.holding_near(conditions + domain, terms, lambda symbol: symbol == time[0])
        self.laws.append((ZERO, time, slope, conditions, domain, flight))

    def step_constant(self, of, time, at, flight, steps):
        """A term whose derivative by `time` vanishes wherever that is has the value that it has at `at`."""
        s, of, at = self.s, self.s.written_out(self.s.terms[of]), self.s.terms[at]
        require(s.symbols[time][0] == "fresh", "the time of a law is a symbol of the statement")
        spoken = [term for _, p in self.facts for term in s.generators(p)]
        spoken += [term for _, _, term, law in s.givens if not law]
        require(not any(time in s.written_out(term).symbols for term in spoken), "something is known of the time")
        require(not flight or at is not Term("symbol", time), "the constant is taken at the running time")
        self.at_time(at, flight)
        mark, slope, self.running = self.mark(), s.by(of, time), (time, *flight) if flight else None
        self.follow(steps, "within, step")
        self.defined(of, slope)
        self.need(ZERO, slope)
        self.back_to(*mark)
        self.defined(at)
        self.laws.append((ZERO, [time], of - s.moved(of, time, at, 0), [], [], flight))


# --- points ----------------------------------------------------------------------------------------------------------


class Point:
    """A point: values of symbols and functions. All that is given holds there, or this is refused."""

    def __init__(self, s, data):
        self.s, s.bits, term = s, MORE_BITS, s.terms.__getitem__
        self.solved, self.sample = ({symbol: term(of) for symbol, of in data[part]} for part in ("solved", "sample"))
        self.named = {function: (time, term(of)) for function, time, of in data["functions_named"]}
        self.table = {(function, order, term(at)): term(of) for function, order, at, of in data["table"]}
        self.values = {**self.solved, **self.sample}
        count = sum(len(data[part]) for part in ("solved", "sample", "functions_named", "table"))
        require(count == len(self.values) + len(self.named) + len(self.table), "something has two values")
        # what numbers are, by steps that use no premise
        givens, s.givens = s.givens, []
        self.proof, s.givens = Proof(s, data["certificate"]), givens
        require(not self.proof.absurd, "numbers contradict each other")
        self.check_values()
        self.check_functions()
        self.check_table()
        for label, holds, of, law in s.givens:
            self.check_law(label, holds, of, *law) if law else self.check_given(label, holds, of)
        self.check_flights()

    def check_values(self):
        for symbol, value in self.values.items():
            require(self.s.symbols[symbol][0] != "partial", "a derivative along a map" + ELSEWHERE)
            held = value.symbols if symbol in self.sample else value.symbols & {*self.s.definitions, *self.solved}
            require(symbol not in self.s.definitions and not held, "a value of, or with, what has another value")
            is_real = Term("i") not in inside(value)
            if symbol in self.sample or self.s.complex:
                is_real &= acb(self.s.evaluate(put_in(value, self.sample), {})).imag.is_zero()
            require(is_real or symbol in self.s.complex_symbols, "a real symbol has a complex value")

    # functions
    def check_functions(self):
        """Functions are smooth, and each is the derivative that it is declared to be."""
        s, tabled, implied = self.s, {function for function, _, _ in self.table}, dict(self.named)
        values = inside(*self.table.values(), *(term for _, term in self.named.values()))
        require(Term("i") not in values, "a real function has a complex value")
        for function in tabled | self.named.keys():
            time, slope = self.named.get(function, (None, as_term(0)))
            is_own = time is None or (s.symbols[time][0] == "fresh" and time not in self.values)
            require(is_own and s.written_out(slope) is slope, "a function is a term in a symbol of its own")
            last = lambda inner: inner.parts[-1] if inner.kind in ("quotient", "root", "ln") else inner
            moving = [inner for inner in inside(slope) if time in last(inner).symbols]
            kinds = {"quotient", "root", "ln", "arcsin", "arccos", "realpower"} & {inner.kind for inner in moving}
            require(not kinds, "a function that is not smooth for its form alone" + ELSEWHERE)
            of, met, others = function, {function}, self.named.keys() if time is None else tabled
            require(function not in others, "a function is named and in the table")
            while of in s.derivatives and s.derivatives[of] not in met:
                of = s.derivatives[of]
                met.add(of)
                require(of not in others, "one of a function and its derivative is named, the other in the table")
                slope = s.by(slope, time)
                other, known = implied.setdefault(of, (time, slope)) if function in self.named else (time, slope)
                known = put_in(known, {other: Term("symbol", time)})
                self.vanish(slope - known, "a function is not the derivative that it is declared to be")
            require(of not in s.derivatives, "a function that is a derivative of its own" + ELSEWHERE)

    def chain(self, function):
        chain = {function}  # all functions that are derivatives of one another
        for _ in self.s.derivatives:
            chain |= {own for pair in self.s.derivatives.items() if chain & set(pair) for own in pair}
        return chain

    def check_table(self):
        """Times of the table are different: then there is a smooth function with these values."""
        s, tabled = self.s, {function for function, _, _ in self.table}
        bound = set().union(*map(self.chain, tabled))
        for label, _, term, law in s.givens:
            functions = {inner.of[0] for inner in inside(s.written_out(term)) if inner.kind == "value"}
            require(not law or law[1] or not functions & bound, "(%s): a law of single values%s" % (label, ELSEWHERE))
        require(all(s.functions[function][0] == "line" for function in tabled), "single values of a flight" + ELSEWHERE)
        for (f, n, a), (g, m, b) in itertools.combinations(self.table, 2):
            if g in self.chain(f) and (a is not b or (f, n) == (g, m)):
                require(self.holds(NONZERO, a - b), "two times of the table may be the same")

    def check_flights(self):
        """A flight that is named has the states at its two ends."""
        s = self.s
        for function, (time, slope) in self.named.items():
            kind, name, *impact = s.functions[function]
            for order in range(3 if kind == "flight" else 0):
                for index, after in ((impact[0], True), (impact[0] + 1, False)):
                    named = s.dotted(name, order)
                    state = s.state(named, index, after) if named in s.states and index in s.times else None
                    if state is not None and state.of[0] in self.values:
                        self.check_given(named, ZERO, put_in(slope, {time: Term("symbol", s.times[index])}) - state)
                slope = s.by(slope, time)

    def translate(self, term, running=None):
        """With solved symbols, functions and the table put in. Values at the running time stay."""
        exact = Expansion(self.s)
        def new(inner):
            if inner.kind == "symbol":
                return self.solved.get(inner.of[0])
            if inner.kind != "value" or (running in inner.of[2].symbols and inner.of[0] not in self.named):
                return None
            function, order, at = inner.of
            if function in self.named:
                time, slope = self.named[function]
                for _ in range(order):
                    slope = self.s.by(slope, time)
                return put_in(slope, {time: at})
            for (f, n, time), value in self.table.items():
                if (f, n) == (function, order) and exact.of(at - time)[0].is_zero():
                    return value
            raise Refused("a function has no value at one of its times")
        term = self.s.written_out(term)
        for _ in range(40):
            before, term = term, rewrite(term, new)
            if term is before:
                return term
        raise Refused("values that stand in each other")

    def is_zero(self, term):
        """Whether the numerator vanishes: both parts of it, without and with the imaginary unit, whose square is -1."""
        p, split, place = self.proof.expansion.of(term)[0], {0: {}, 1: {}}, self.s.place.get(Term("i"))
        for exponents, value in p.to_dict().items():
            n = exponents[place] if place is not None else 0
            rest = tuple(0 if m == place else exponent for m, exponent in enumerate(exponents))
            split[n % 2][rest] = split[n % 2].get(rest, 0) + (-value if n % 4 >= 2 else value)
        return all(self.proof.knows_polynomial(ZERO, self.s.ring.from_dict(part)) for part in split.values())

    def holds(self, holds, term):
        """Whether a term has a property at the point."""
        term = put_in(self.translate(term), self.sample)
        self.proof.defined(term)
        for inner in inside(term):
            if inner.kind == "realpower":
                self.s.evaluate(inner, {})
        p = self.proof.expansion.property_of(holds, term)
        if holds == INTEGER:
            require(p.is_constant(), "not known to be an integer")
            return p.leading_coefficient().q == 1
        if self.is_zero(term):
            return holds in (ZERO, NONNEGATIVE)
        told = self.s.sign(p)
        require(told or (told == 0 and holds in (ZERO, NONZERO)), "a value is not real, or too close to 0 to tell")
        return holds == NONZERO or (holds != ZERO and told > 0)

    def vanish(self, term, why):
        require(self.is_zero(term) or (not self.s.generic and self.is_zero(put_in(term, self.sample))), why)

    def check_given(self, label, holds, term):
        if holds == ZERO and self.s.generic:
            # what the generic symbols depend on runs around the point, all else stays
            around = set().union(*(self.translate(Term("symbol", symbol)).symbols for symbol in self.s.generic))
            fixed = {symbol: value for symbol, value in self.sample.items() if symbol not in around}
            p, _ = Expansion(self.s).of(put_in(self.translate(term), fixed))
            require(p.is_zero(), "(%s) does not hold identically in the generic symbols" % label)
        require(self.holds(holds, term), "(%s) does not hold at the point" % label)

    def check_law(self, label, holds, term, time, flight, every, _):
        s = self.s
        require(holds == ZERO and time, "(%s), a recursion or inequality%s" % (label, ELSEWHERE))
        # the law speaks of every time, whatever the value of its symbol at the point
        running = s.symbol("fresh", "law", len(s.symbols))
        impacts = {*s.times, *(meaning[2] for meaning in s.symbols if meaning[0] == "state")}
        flights = {*range(min(impacts), max(impacts))} if impacts else set()
        flights |= {meaning[2] for meaning in s.functions if meaning[0] == "flight"}
        for shift in [own - flight[0] for own in flights] if flight else [0]:
            require(shift == 0 or every, "(%s) does not extend to all flights" % label)
            moved = s.moved(s.written_out(term), time[0], Term("symbol", running), shift)
            self.vanish(self.translate(moved, running), "(%s) does not hold at all times" % label)

    def fails(self):  # a solution that is not defined is none
        return not all(self.holds(*own) for holds, of in self.s.goals for own in (*self.s.domain(of), (holds, of)))


# --- letters that need not commute -----------------------------------------------------------------------------------


def joined(*words):
    """The product of words: each the powers of what commutes, and what keeps its place, as (name, is transposed)."""
    powers = {}
    for name, exponent in itertools.chain(*(scalars for scalars, _ in words)):
        powers[name] = powers.get(name, 0) + exponent
    letters = tuple((name, bool(turned)) for _, own in words for name, turned in own)
    return tuple(sorted((name, exponent) for name, exponent in powers.items() if exponent)), letters


def added(terms):
    total = {}
    for coefficient, word in terms:
        total[word] = total.get(word, 0) + coefficient
    return {word: coefficient for word, coefficient in total.items() if coefficient != 0}


def check_words(data):
    """Each claim is its line, a sum of multiples of what is given and of lines before. What is given can hold."""
    turn = lambda letters: tuple((name, not is_turned) for name, is_turned in reversed(letters))
    summed = lambda terms: added((rational(number), joined((scalars, letters))) for number, scalars, letters in terms)
    claims, givens, lines = [*map(summed, data["claims"])], [*map(summed, data["givens"])], []
    every, names = list(itertools.chain(*claims, *givens)), lambda scalars: {name for name, n in scalars if n < 0}
    arrows = any("\\vec" in name or "overrightarrow" in name for _, letters in every for name, _ in letters)
    divided = set().union(*(names(scalars) for scalars, _ in every))
    for line in data["lines"]:
        terms = []
        for coefficient, front, kind, source, behind in line:
            require(not arrows or not (front[1] or behind[1]), "a line multiplies by a word what has vectors")
            require(names(front[0]) | names(behind[0]) <= divided, "a line divides by what nothing else does")
            for (scalars, letters), own in (lines if kind == "line" else givens)[source].items():
                word = scalars, turn(letters) if kind == "transposed" else letters
                terms.append((rational(coefficient) * own, joined(front, word, behind)))
        lines.append(added(terms))
    require(claims == [lines[line] for line in data["claim_lines"]] != [], "a line is not the claim")
    point = {name: rational(value) for name, value in data["point"].items()}
    factors = lambda word: [point[name] ** n for name, n in word[0]] + [point[name] for name, _ in word[1]]
    value = lambda words: sum((math.prod(factors(word), start=own) for word, own in words.items()), fmpq(0))
    *values, _ = map(value, givens + claims)  # claims have values too
    require(not any(own != 0 for own in values[: len(givens)]), "what is given does not hold at the point")
    return "proved: what is claimed is a combination of what is given"


# --- files -----------------------------------------------------------------------------------------------------------


def check(data):
    """Refuses what is not shown; else says in a sentence what is."""
    if data == SCHEMA:
        return "the schema of these files"
    if "words" in data:
        return check_words(data["words"])
    if data["verdict"] == "refuted":
        point = Point(Statement(data, data["point"]), data["point"])
        require(point.fails(), "the claim holds at the point")
        return "refuted: the premises hold at the point, and the claim fails"
    s = Statement(data, data["proof"])
    proof = Proof(s, data["proof"])
    require(s.goals, "there is no claim")
    for holds, term in s.goals:
        proof.defined(term)
        require(proof.knows(holds, term), "the steps do not lead to the claim")
    Point(Statement(data, data["point"]), data["point"])
    return "proved: every step follows, and the premises hold at the point"


def misfit(value, schema):
    """How a value has another shape than a schema says, with its place; None where it fits."""
    while "$ref" in schema:
        schema = SCHEMA["$defs"][schema["$ref"].rpartition("/")[2]]
    if "oneOf" in schema:
        found = [*itertools.takewhile(bool, (misfit(value, form) for form in schema["oneOf"]))]
        far = lambda why: (sum(map(why.partition(":")[0].count, ".[")), "is none of" not in why)
        return max(found, key=far) if len(found) == len(schema["oneOf"]) else None
    kind, size = schema.get("type"), len(value) if isinstance(value, (str, list)) else 0
    wanted = schema.get("enum", [schema["const"]] if "const" in schema else None)
    first, rest, own = schema.get("prefixItems", []), schema.get("items", {}), schema.get("properties", {})
    why, parts = None, ()
    if wanted and not any(type(value) is type(one) and value == one for one in wanted):
        why = "none of %s" % wanted
    elif kind and type(value) is not {"object": dict, "array": list, "string": str, "integer": int}[kind]:
        why = "no " + kind
    elif kind == "integer" and not schema["minimum"] <= value <= schema["maximum"]:
        why = "out of range"
    elif not schema.get("minItems", 0) <= size <= schema.get("maxItems", schema.get("maxLength", size)):
        why = "too long or too short"
    elif "pattern" in schema and not (re.fullmatch(schema["pattern"], value) and not re.search("/0*$", value)):
        why = "no number, or divides by 0"
    elif kind == "array":
        parts = [(n, part, first[n] if n < len(first) else rest) for n, part in enumerate(value)]
    elif kind == "object":
        rest, names = schema["additionalProperties"], set(schema.get("required", ())) - value.keys()
        for name in names | (set() if rest else value.keys() - own.keys()):
            why = "an object where `%s` is missing or not known" % name
        parts = [(name, part, own.get(name, rest)) for name, part in value.items() if not why]
    for place, part, form in parts:
        inner = misfit(part, form)
        if inner:
            return ("[%d]" if kind == "array" else ".%s") % place + inner
    return why and ": %.40s is %s" % (json.dumps(value), why)


def once(pairs):
    require(len(dict(pairs)) == len(pairs), "a field stands twice")
    return dict(pairs)


def read_file(path):
    """The proof data of a file."""
    with open(path, encoding="utf-8") as file:
        text = file.read(LARGEST_FILE + 1)
    require(len(text) <= LARGEST_FILE, "the file is longer than %d characters" % LARGEST_FILE)
    data = json.loads(text, object_pairs_hook=once)
    why = data != SCHEMA and misfit(data, SCHEMA)
    require(not why, "data%s" % why)
    return data


def main(paths):
    """Says of each file whether it is accepted; ends with 1 where one is refused, else with 3 where one is left out."""

    def stop(*_):
        raise TimeoutError("it takes longer than %d s" % LONGEST)
    resource.setrlimit(resource.RLIMIT_AS, (LARGEST_MEMORY, LARGEST_MEMORY))
    signal.signal(signal.SIGALRM, stop)
    sys.setrecursionlimit(20000)
    worst = 0
    for path in paths:
        signal.alarm(LONGEST)
        try:
            said = "accepted: " + check(read_file(path))
        except (Refused, *ERRORS) as why:
            is_left_out = str(why).endswith(ELSEWHERE)
            kind = "" if isinstance(why, Refused) else type(why).__name__ + ": "
            said = "%s: %s%s" % ("left out" if is_left_out else "refused", kind, why)
            worst = 1 if worst == 1 or not is_left_out else 3
        signal.alarm(0)
        print("%s: %s" % (path, said), flush=True)
    sys.exit(worst)

if __name__ == "__main__":
    main(sys.argv[1:])
