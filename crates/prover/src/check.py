# ---------------------------------------------------------------------------------------------------------------------
# The checker. It shares no line with the program that wrote the data above, and trusts none of it but the statement:
# what is given and what is claimed. It needs SymPy (products of polynomials) and mpmath (values of numbers).
#
# A term is a node in a table; equal terms have equal numbers. A polynomial is a dictionary from monomials to rational
# coefficients; a monomial is a sorted tuple of (term, exponent), and each term in it stands for its own value. A fact
# is a property of a polynomial. Each step of a proof adds facts that follow from those before it.
import os
import sys

# a script beside this one may be called like a module
sys.path[:] = [path for path in sys.path if os.path.abspath(path) != os.path.dirname(os.path.abspath(__file__))]

import ast
import atexit
import itertools
import json
import math
import random
from fractions import Fraction

import mpmath
from sympy import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

ZERO, NONZERO, POSITIVE, NONNEGATIVE, INTEGER = "zero", "nonzero", "positive", "nonnegative", "integer"
FUNCTIONS = ("sin", "cos", "exp", "ln", "arcsin", "arccos", "arctan")
DIGITS = 60

# what is true of all numbers, a row each: name, letters, guards, conclusion, source
ROWS = """
@AXIOMS@"""
AXIOMS = {
    name: (letters.split(), [guard for guard in guards.split("; ") if guard], conclusion)
    for name, letters, guards, conclusion, _ in (
        [part.strip() for part in row.split("|")] for row in ROWS.splitlines() if row and not row.startswith("#")
    )
}
SMALL = mpmath.mpf(10) ** -45
mpmath.iv.dps = 30
# how near two values of one number are, as a share of it
NEAR = mpmath.mpf(10) ** -12


# how far two rules for one integral may be apart, and how much more than that its value is trusted to be off
WIDEST, MARGIN = mpmath.mpf(10) ** -9, 1000


class Refused(Exception):
    """A step that does not follow, or a premise that does not hold."""


def require(holds, why):
    if not holds:
        raise Refused(why)


def quadrature(of, ends):
    """The integral of a function between two numbers by two rules, and how far these are apart. `ends` gives the numbers with the
    digits at hand. Where a rule has trouble the function may be singular at the ends: distances from these are what is run over, so
    that they keep their digits."""
    with mpmath.workdps(50):
        try:
            low, high = ends()
            found, other = mpmath.quad(of, [low, high]), mpmath.quad(of, mpmath.linspace(low, high, 8))
            apart = abs(found - other)
            if mpmath.isfinite(found) and apart <= mpmath.mpf(10) ** -40 * (1 + abs(found)):
                return found, apart
        except (Refused, ZeroDivisionError, ValueError):
            pass
    rules = []
    for digits, third in ((100, 0), (110, 1)):
        with mpmath.workdps(2 * digits):
            low, high = ends()
            half, sum_ = (high - low) / 2, mpmath.mpf(0)
            for end, sign in ((low, 1), (high, -1)):

                def beside(distance):
                    with mpmath.workdps(2 * digits):
                        return of(end + sign * distance)

                with mpmath.workdps(digits):
                    sum_ += mpmath.quad(beside, [0, half / 3, half] if third else [0, half])
            rules.append(sum_)
    apart = abs(rules[0] - rules[1])
    require(all(map(mpmath.isfinite, rules)) and apart <= WIDEST * (1 + abs(rules[0])), "an integral without a value")
    return rules[1], apart


# --- polynomials -----------------------------------------------------------------------------------------------------


def read_polynomial(data):
    polynomial = {}
    for coefficient, flat in data:
        monomial = tuple(zip(flat[::2], flat[1::2]))
        require(list(monomial) == sorted(set(monomial)) and len(dict(monomial)) == len(monomial), "a monomial out of order")
        require(all(type(n) is int for pair in monomial for n in pair), "a term or an exponent that is no integer")
        require(all(term >= 0 and power > 0 for term, power in monomial), "an exponent that is not positive")
        polynomial[monomial] = polynomial.get(monomial, 0) + Fraction(coefficient)
    return {monomial: value for monomial, value in polynomial.items() if value}


def constant(value):
    return {(): Fraction(value)} if value else {}


def generator(term):
    return {((term, 1),): Fraction(1)}


def generators(*polynomials):
    return sorted({term for p in polynomials for monomial in p for term, _ in monomial})


def add(a, b, factor=1):
    """a + factor * b"""
    total = dict(a)
    for monomial, value in b.items():
        value = total.get(monomial, 0) + factor * value
        if value:
            total[monomial] = value
        else:
            total.pop(monomial, None)
    return total


def scaled(a, factor):
    return {monomial: value * factor for monomial, value in a.items()} if factor else {}


def times(a, b):
    """The product, by SymPy."""
    if not a or not b:
        return {}
    for one, other in ((a, b), (b, a)):
        if list(one) == [()]:
            return scaled(other, one[()])
    order = generators(a, b)
    place = {term: n for n, term in enumerate(order)}
    ring = PolyRing(["g%d" % term for term in order], QQ, lex)

    def inward(p):
        element = {}
        for monomial, value in p.items():
            exponents = [0] * len(order)
            for term, power in monomial:
                exponents[place[term]] = power
            element[tuple(exponents)] = QQ(value.numerator, value.denominator)
        return ring.from_dict(element)

    product = inward(a) * inward(b)
    return {
        tuple((order[n], power) for n, power in enumerate(exponents) if power): Fraction(int(value.numerator), int(value.denominator))
        for exponents, value in product.items()
    }


def power(a, exponent):
    require(exponent <= 4000, "an exponent too large to multiply out")
    result, square = constant(1), a
    while exponent:
        if exponent & 1:
            result = times(result, square)
        exponent >>= 1
        if exponent:
            square = times(square, square)
    return result


def value_of_constant(p):
    """The number that a polynomial without generators is; None for others."""
    return Fraction(0) if not p else p.get(()) if len(p) == 1 else None


def lead(p):
    return p[min(p)]


def ratio(a, b):
    """The number by which b is multiplied to be a; None where there is none, or both are 0."""
    if not a or not b or a.keys() != b.keys():
        return None
    factor = lead(a) / lead(b)
    return factor if a == scaled(b, factor) else None


# --- terms -----------------------------------------------------------------------------------------------------------


def parts(node):
    kind = node[0]
    if kind in ("number", "pi", "i", "symbol", "bound", "integral"):
        return ()
    if kind in ("sum", "product"):
        return node[1]
    if kind == "power":
        return (node[1],)
    if kind in ("quotient", "realpower"):
        return node[1:]
    return (node[-1],)


def with_parts(node, new):
    kind = node[0]
    if kind in ("number", "pi", "i", "symbol", "bound", "integral"):
        return node
    if kind in ("sum", "product"):
        return (kind, tuple(new))
    if kind == "power":
        return (kind, new[0], node[2])
    if kind in ("quotient", "realpower"):
        return (kind, new[0], new[1])
    return node[:-1] + (new[0],)


class Statement:
    """What is given and what is claimed: terms, symbols, and their meaning."""

    def __init__(self, data):
        self.nodes, self.known = [], {}
        self.integrals, self.apart = {}, mpmath.mpf(0)
        self.symbols, self.symbol_number = [], {}
        self.functions, self.function_number = [], {}
        self.times = {}  # of the impacts, by their index
        self.complex = bool(data["complex"])
        self.states, self.continuous = set(data["states"]), set(data["continuous"])
        self.letter = data["letter"]  # of the index
        self.dots = {name: chain for chain in data["dots"] for name in chain[:1]}
        self.extend(data)
        self.definitions = dict(data["definitions"])
        self.derivatives = dict(data["derivatives"])
        self.complex_symbols, self.generic = set(data["complex_symbols"]), set(data["generic"])
        self.flight = data["flight"][0] if data["flight"] else None
        self.maps = [(of, by, [term for _, term in equations]) for of, by, equations in data["maps"]]
        self.beside = data["beside"]
        self.goals = data["goals"]
        self.givens = [
            (label, holds, term, {"time": law[0], "flight": law[1], "every": law[2], "conditions": law[3]} if law else None)
            for label, holds, term, law in data["givens"]
        ]

    def extend(self, data):
        """Takes over more symbols, functions and terms, numbered on."""
        for printed, *meaning in data["symbols"]:
            self.symbol_of(tuple(meaning), printed)
        for meaning in data["functions"]:
            self.function_of(tuple(meaning))
        for node in data["terms"]:
            kind = node[0]
            if kind == "number":
                node = ("number", Fraction(node[1]))
            elif kind in ("sum", "product"):
                node = (kind, tuple(node[1]))
            require(kind != "root" or node[1] >= 2, "a root of an index below 2")
            number, before = self.add(tuple(node)), len(self.nodes)
            require(number == before - 1 and all(type(part) is int and 0 <= part < number for part in parts(self.nodes[number])), "terms out of order")

    def copy(self, more):
        """A statement of its own with more terms."""
        new = object.__new__(Statement)
        new.__dict__.update({k: v.copy() if isinstance(v, (list, dict, set)) else v for k, v in self.__dict__.items()})
        new.extend(more)
        return new

    def symbol_of(self, meaning, printed="?"):
        if meaning not in self.symbol_number:
            self.symbol_number[meaning] = len(self.symbols)
            self.symbols.append((printed, meaning))
            if meaning[0] == "time":
                self.times.setdefault(meaning[2], self.symbol_number[meaning])
        return self.symbol_number[meaning]

    def meaning(self, symbol):
        return self.symbols[symbol][1]

    def function_of(self, meaning):
        if meaning not in self.function_number:
            self.function_number[meaning] = len(self.functions)
            self.functions.append(meaning)
        return self.function_number[meaning]

    # terms

    def add(self, node):
        if node not in self.known:
            self.known[node] = len(self.nodes)
            self.nodes.append(node)
        return self.known[node]

    def number(self, value):
        return self.add(("number", Fraction(value)))

    def symbol(self, symbol):
        return self.add(("symbol", symbol))

    def sum(self, terms):
        return terms[0] if len(terms) == 1 else self.add(("sum", tuple(terms))) if terms else self.number(0)

    def product(self, terms):
        return terms[0] if len(terms) == 1 else self.add(("product", tuple(terms))) if terms else self.number(1)

    def negative(self, term):
        return self.product([self.number(-1), term])

    def difference(self, a, b):
        return self.sum([a, self.negative(b)])

    def quotient(self, a, b):
        return self.add(("quotient", a, b))

    def inside(self, *terms):
        met, open_ = set(terms), list(terms)
        while open_:
            for part in parts(self.nodes[open_.pop()]):
                if part not in met:
                    met.add(part)
                    open_.append(part)
        return sorted(met)

    def rewrite(self, term, new):
        done = {}
        for inner in self.inside(term):
            node = self.nodes[inner]
            node = with_parts(node, [done[part] for part in parts(node)])
            replaced = new(node)
            done[inner] = self.add(node) if replaced is None else replaced
        return done[term]

    def substitute(self, term, symbol, by):
        return self.rewrite(term, lambda node: by if node == ("symbol", symbol) else None)

    def written_out(self, term):
        """Without abbreviations."""
        for _ in range(len(self.definitions) + 1):
            term, before = self.rewrite(term, lambda n: self.definitions.get(n[1]) if n[0] == "symbol" else None), term
            if term == before:
                break
        return term

    def holds(self, term, symbol):
        return any(self.nodes[inner] == ("symbol", symbol) for inner in self.inside(term))

    def is_closed(self, term):
        return not any(self.nodes[inner][0] in ("symbol", "value") for inner in self.inside(term))

    def is_real(self, term):
        for inner in self.inside(term):
            node = self.nodes[inner]
            if node[0] == "i":
                return False
            if self.complex:
                if node[0] in ("realpower", "ln", "root", "arcsin", "arccos"):
                    return False
                if node[0] == "symbol":
                    if node[1] in self.complex_symbols or self.meaning(node[1])[0] == "fresh":
                        return False
                    if node[1] in self.definitions and not self.is_real(self.definitions[node[1]]):
                        return False
        return True

    # impacts and flights

    def state(self, name, index, after):
        return self.symbol_of(("state", name, index, int(bool(after) and name not in self.continuous)))

    def dotted(self, name, order):
        chain = self.dots.get(name, [name])
        return chain[order] if order < len(chain) else None

    def in_flight(self, name, impact, order, at):
        """A state in a flight; at the impacts at its ends, the state just after or just before."""
        node, named = self.nodes[at], self.dotted(name, order)
        if node[0] == "symbol" and named in self.states:
            for index, after in ((impact, True), (impact + 1, False)):
                if self.times.get(index) == node[1]:
                    return self.symbol(self.state(named, index, after))
        return self.add(("value", self.function_of(("flight", name, impact)), order, at))

    def moved(self, term, time, at, shift):
        """The term with its running time replaced and its impacts moved on."""

        def new(node):
            if node[0] == "symbol":
                if time is not None and node[1] == time:
                    return at
                meaning = self.meaning(node[1])
                if shift and meaning[0] == "time":
                    return self.symbol(self.symbol_of(("time", meaning[1], meaning[2] + shift)))
                if shift and meaning[0] == "state":
                    return self.symbol(self.state(meaning[1], meaning[2] + shift, meaning[3]))
                if shift and meaning == ("parameter", self.letter):
                    return self.sum([self.symbol(node[1]), self.number(shift)])
                require(not shift or meaning[0] != "partial", "a derivative along a map is not moved on")
            elif node[0] == "value" and self.functions[node[1]][0] == "flight":
                _, name, impact = self.functions[node[1]]
                return self.in_flight(name, impact + shift, node[2], node[3])
            return None

        return self.rewrite(term, new)

    def is_end(self, term, flight):
        node = self.nodes[term]
        return node[0] == "symbol" and node[1] in (self.times.get(flight), self.times.get(flight + 1))

    def runs_in(self, term, flight, running):
        node = self.nodes[term]
        if node[0] != "symbol":
            return False
        return (node[1], flight) == running or (self.meaning(node[1]) == ("running",) and self.flight == flight)

    # derivatives

    def value(self, function, order, at):
        while order and function in self.derivatives:
            function, order = self.derivatives[function], order - 1
        return self.add(("value", function, order, at))

    def derivative(self, term, slope):
        """By the rules of differentiation; `slope` gives the derivative of a symbol."""
        zero, done = self.number(0), {}
        for inner in self.inside(term):
            node = self.nodes[inner]
            kind, inner_parts = node[0], parts(node)
            moving = [part for part in inner_parts if done[part] != zero]
            if kind == "symbol":
                result = slope(node[1])
            elif kind == "sum":
                result = self.sum([done[part] for part in inner_parts if done[part] != zero])
            elif not moving:
                result = zero
            elif kind == "product":
                result = self.sum([
                    self.product([done[p] if m == n else p for m, p in enumerate(inner_parts)])
                    for n, part in enumerate(inner_parts) if done[part] != zero
                ])
            elif kind == "power":
                base, exponent = node[1:]
                if exponent in (0, 1):
                    result = done[base] if exponent else zero
                else:
                    result = self.product([self.number(exponent), self.add(("power", base, exponent - 1)), done[base]])
            elif kind == "quotient":
                above, below = inner_parts
                relative = self.quotient(done[below], below)
                result = self.difference(self.quotient(done[above], below), self.product([inner, relative]))
            elif kind == "realpower":
                base, exponent = inner_parts
                require(not self.complex, "a complex power is not differentiated")
                first = self.product([done[exponent], self.add(("ln", base))])
                second = self.product([exponent, self.quotient(done[base], base)])
                result = self.product([inner, self.sum([first, second])])
            elif kind == "value":
                result = self.product([self.value(node[1], node[2] + 1, node[3]), done[node[3]]])
            else:
                at = node[-1]
                # principal branches are not continuous everywhere
                require(not self.complex or kind in ("sin", "cos", "exp"), "a principal branch is not differentiated")
                result = self.product([self.slope(kind, node, at, inner), done[at]])
            done[inner] = result
        return done[term]

    def slope(self, kind, node, at, inner):
        one = self.number(1)
        if kind == "sin":
            return self.add(("cos", at))
        if kind == "cos":
            return self.negative(self.add(("sin", at)))
        if kind == "exp":
            return inner
        if kind == "ln":
            return self.quotient(one, at)
        if kind == "root":
            return self.quotient(inner, self.product([self.number(node[1]), at]))
        square = self.add(("power", at, 2))
        if kind == "arctan":
            return self.quotient(one, self.sum([one, square]))
        slope = self.quotient(one, self.add(("root", 2, self.difference(one, square))))
        return slope if kind == "arcsin" else self.negative(slope)

    def by(self, term, symbol):
        return self.derivative(self.written_out(term), lambda other: self.number(int(other == symbol)))

    def along(self, term, map_, by):
        """The derivative along a map by one of the quantities that it starts from."""
        _, starts, _ = map_

        def slope(symbol):
            if symbol == by:
                return self.number(1)
            if self.meaning(symbol)[0] not in ("time", "state") or symbol in starts:
                return self.number(0)
            return self.symbol(self.symbol_of(("partial", symbol, by)))

        return self.derivative(self.written_out(term), slope)

    # domains

    def domain(self, *terms):
        """What must hold for terms to have values."""
        conditions, seen, open_ = [], set(), list(terms)
        while open_:
            for inner in self.inside(open_.pop()):
                if inner in seen:
                    continue
                seen.add(inner)
                node = self.nodes[inner]
                kind = node[0]
                if kind == "symbol" and node[1] in self.definitions:
                    open_.append(self.definitions[node[1]])
                elif kind == "quotient":
                    conditions.append((NONZERO, node[2]))
                elif kind == "ln":
                    conditions.append((NONZERO if self.complex else POSITIVE, node[1]))
                elif kind == "root" and not self.complex and node[1] % 2 == 0:
                    conditions.append((NONNEGATIVE, node[2]))
                elif kind in ("arcsin", "arccos") and not self.complex:
                    one = self.number(1)
                    conditions.append((NONNEGATIVE, self.difference(one, node[1])))
                    conditions.append((NONNEGATIVE, self.sum([one, node[1]])))
        return conditions

    def holding_near(self, conditions, terms, moves):
        """What must hold besides for what holds at a point under conditions to hold near it too, as symbols move."""
        moving = lambda term: any(node[0] == "symbol" and moves(node[1]) for node in map(self.nodes.__getitem__, self.inside(term)))
        near = []
        for holds, of in conditions:
            if moving(of):
                require(holds in (POSITIVE, NONZERO, NONNEGATIVE), "what is differentiated does not hold on an open set")
                if holds == NONNEGATIVE:
                    near.append((NONZERO, of))
        for inner in self.inside(*terms):
            node = self.nodes[inner]
            if node[0] == "realpower" and moving(node[2]):
                near.append((POSITIVE, node[1]))
            elif node[0] == "realpower" and moving(node[1]):
                near.append((NONZERO, node[1]))
        return near

    # values of numbers

    def integral(self, of, low, high):
        """The value of an integral over numbers, by two rules that agree; `apart` is how far these are apart at most."""
        if (of, low, high) not in self.integrals:
            ends = lambda: (self.evaluate(low), self.evaluate(high))
            self.integrals[of, low, high] = quadrature(lambda x: self.evaluate(of, bound=x), ends)
        found, apart = self.integrals[of, low, high]
        self.apart = max(self.apart, apart)
        return found

    def evaluate(self, term, symbol=None, value=None, bound=None):
        """The value of a term; `symbol` and `value` give those of symbols and of unknown functions, `bound` that of the letter
        of an integral."""
        done = {}
        for inner in self.inside(term):
            node = self.nodes[inner]
            kind, of = node[0], [done[part] for part in parts(node)]
            if kind == "number":
                result = mpmath.mpf(node[1].numerator) / node[1].denominator
            elif kind == "pi":
                result = +mpmath.pi
            elif kind == "i":
                result = mpmath.mpc(0, 1)
            elif kind == "bound":
                require(bound is not None, "a number with the letter of an integral in it")
                result = bound
            elif kind == "integral":
                result = self.integral(*node[1:])
            elif kind == "symbol":
                require(symbol is not None or node[1] in self.definitions, "a number with a symbol in it")
                result = self.evaluate(self.definitions[node[1]], symbol, value) if node[1] in self.definitions else symbol(node[1])
            elif kind == "sum":
                result = mpmath.fsum(of)
            elif kind == "product":
                result = mpmath.fprod(of)
            elif kind == "power":
                result = of[0] ** node[2]
            elif kind == "quotient":
                require(of[1] != 0, "a divisor is 0")
                result = of[0] / of[1]
            elif kind == "realpower":
                result = mpmath.power(*of)
            elif kind == "value":
                require(value is not None, "a number with an unknown function in it")
                result = value(node[1], node[2], of[0])
            elif kind == "root":
                result = root(of[0], node[1], self.complex)
            else:
                result = {"sin": mpmath.sin, "cos": mpmath.cos, "exp": mpmath.exp, "ln": mpmath.ln, "arcsin": mpmath.asin, "arccos": mpmath.acos, "arctan": mpmath.atan}[kind](of[0])
            # outside of its domain a real function has no value
            require(self.complex or not isinstance(result, mpmath.mpc) or result.imag == 0, "a number that is not real")
            done[inner] = result
        return done[term]

    def value_of(self, polynomial):
        """The value of a polynomial whose generators are numbers; None where one is not, or has no value."""
        if not all(self.is_closed(term) for term in generators(polynomial)):
            return None
        try:
            values = {term: self.evaluate(term) for term in generators(polynomial)}
        except (Refused, ZeroDivisionError, ValueError):
            return None
        total, size = mpmath.mpf(0), mpmath.mpf(1)
        for monomial, coefficient in polynomial.items():
            part = mpmath.mpf(coefficient.numerator) / coefficient.denominator
            for term, exponent in monomial:
                part *= values[term] ** exponent
            total += part
            size += abs(part)
        # what is left of the digits after cancellation
        return (total, size) if mpmath.isfinite(total) else None

    def enclosed(self, polynomial, box):
        """An interval that holds the values of a polynomial for all letters in a box; None where it may have none."""
        known, total = dict(box), mpmath.iv.mpf(0)
        try:
            for monomial, coefficient in polynomial.items():
                part = exactly(coefficient)
                for term, exponent in monomial:
                    for inner in self.inside(term):
                        if inner not in known:
                            known[inner] = within(self.nodes[inner], [known[part] for part in parts(self.nodes[inner])])
                    part *= known[term] ** exponent
                total += part
        except (Refused, ZeroDivisionError, ValueError, mpmath.libmp.ComplexResult):
            return None
        return total if mpmath.isfinite(total.a) and mpmath.isfinite(total.b) else None

    def sign(self, polynomial):
        """The sign of the real value of a number: 1 or -1; None where it is too close to 0 to tell, or not real."""
        exact = value_of_constant(polynomial)
        if exact is not None:
            return (exact > 0) - (exact < 0) or None
        found = self.value_of(polynomial)
        inner = (self.nodes[inner] for term in generators(polynomial) for inner in self.inside(term))
        small = max(1000 * NEAR, MARGIN * self.apart) if any(node[0] == "integral" for node in inner) else SMALL
        if found is None or abs(found[0]) <= small * found[1]:
            return None
        # rounding within terms shows with more digits
        with mpmath.workdps(3 * mpmath.mp.dps):
            more = self.value_of(polynomial)
        if more is None or abs(more[0] - found[0]) > NEAR * abs(more[0]) or abs(mpmath.im(more[0])) > NEAR * abs(more[0]):
            return None
        return 1 if mpmath.re(more[0]) > 0 else -1


def exactly(fraction):
    return mpmath.iv.mpf(fraction.numerator) / fraction.denominator


def within(node, of):
    """The values of a node over intervals of its parts, all real."""
    kind = node[0]
    if kind == "number":
        return exactly(node[1])
    if kind == "pi":
        return +mpmath.iv.pi
    if kind in ("sum", "product"):
        total = mpmath.iv.mpf(kind == "product")
        for part in of:
            total = total + part if kind == "sum" else total * part
        return total
    if kind == "power":
        return of[0] ** node[2]
    if kind == "quotient":
        require(not (of[1].a <= 0 <= of[1].b), "a divisor may be 0")
        return of[0] / of[1]
    if kind in ("sin", "cos", "exp"):
        return getattr(mpmath.iv, kind)(of[0])
    ends = [mpmath.mpf(of[0].a), mpmath.mpf(of[0].b)] if of else []
    if kind in ("ln", "realpower"):
        require(ends[0] > 0, "a logarithm that may have no value")
        return mpmath.iv.log(of[0]) if kind == "ln" else mpmath.iv.exp(of[1] * mpmath.iv.log(of[0]))
    monotone = {"arcsin": mpmath.asin, "arccos": mpmath.acos, "arctan": mpmath.atan}
    if kind == "root":
        require(ends[0] >= 0 or node[1] % 2 == 1, "a root that may have no value")
        ends = [root(end, node[1], False) for end in ends]
    else:
        require(kind in monotone and (kind == "arctan" or -1 <= ends[0] <= ends[1] <= 1), "a term without a value")
        ends = sorted(monotone[kind](end) for end in ends)
    # both ends are rounded in all their digits
    return mpmath.iv.mpf([ends[0] - SMALL, ends[1] + SMALL])


def root(of, index, complex_):
    if not complex_ and index % 2 == 1 and mpmath.im(of) == 0 and mpmath.re(of) < 0:
        return -mpmath.root(-of, index)
    return mpmath.root(of, index) if of else mpmath.mpf(0)


# --- terms as quotients of polynomials -------------------------------------------------------------------------------


class Expansion:
    """Terms as a numerator over powers of divisors, of which each has 1 as its first coefficient."""

    def __init__(self, statement, whole=()):
        self.statement, self.whole, self.done = statement, set(whole), {}

    def of(self, term):
        if term not in self.done:
            for inner in self.statement.inside(term):
                if inner not in self.done:
                    self.done[inner] = (generator(inner), {}) if inner in self.whole else self.unfolded(inner)
                    if isinstance(self.done[inner], Refused) and inner == term:
                        raise self.done[inner]
        if isinstance(self.done[term], Refused):
            raise self.done[term]
        return self.done[term]

    def unfolded(self, term):
        node = self.statement.nodes[term]
        kind = node[0]
        try:
            if kind == "number":
                return constant(node[1]), {}
            if kind == "sum":
                total = ({}, {})
                for part in node[1]:
                    total = self.plus(total, self.of(part))
                return total
            if kind == "product":
                result = (constant(1), {})
                for part in node[1]:
                    result = self.by(result, self.of(part))
                return result
            if kind == "power":
                (above, below), exponent = self.of(node[1]), node[2]
                require(exponent >= 0, "a negative power")
                return power(above, exponent), {key: (p, n * exponent) for key, (p, n) in below.items() if exponent}
            if kind == "quotient":
                above, (numerator, below) = self.of(node[1]), self.of(node[2])
                require(numerator, "a divisor is 0")
                first = lead(numerator)
                inverse = constant(1 / first)
                for p, n in below.values():
                    inverse = times(inverse, power(p, n))
                divisor = scaled(numerator, 1 / first)
                divisors = {} if value_of_constant(divisor) is not None else {key_of(divisor): (divisor, 1)}
                return self.by(above, (inverse, divisors))
        except Refused as refusal:
            return refusal
        return generator(term), {}

    @staticmethod
    def by(a, b):
        divisors = dict(a[1])
        for key, (p, n) in b[1].items():
            divisors[key] = (p, n + divisors[key][1] if key in divisors else n)
        return times(a[0], b[0]), divisors

    @staticmethod
    def plus(a, b):
        numerators, divisors = [a[0], b[0]], dict(a[1])
        for key, (p, n) in b[1].items():
            missing = n - a[1].get(key, (p, 0))[1]
            if missing > 0:
                numerators[0] = times(numerators[0], power(p, missing))
                divisors[key] = (p, n)
        for key, (p, n) in a[1].items():
            missing = n - b[1].get(key, (p, 0))[1]
            if missing > 0:
                numerators[1] = times(numerators[1], power(p, missing))
        return add(*numerators), divisors

    def property_of(self, holds, term):
        """The polynomial that has the property where the term has it."""
        numerator, divisors = self.of(term)
        require(holds != INTEGER or not divisors, "an integer is given by a quotient")
        if holds in (POSITIVE, NONNEGATIVE):
            for p, n in divisors.values():
                if n % 2:
                    numerator = times(numerator, p)
        return numerator


def key_of(p):
    return tuple(sorted(p.items()))


def integer_valued(p):
    """Whether a polynomial is an integer wherever its generators are: by its values at 0, ..., degree in each of them, which
    its forward differences are made of."""
    if all(value.denominator == 1 for value in p.values()):
        return True
    degrees = {}
    for monomial in p:
        for term, exponent in monomial:
            degrees[term] = max(exponent, degrees.get(term, 0))
    if math.prod(degree + 1 for degree in degrees.values()) > 1000:
        return False
    for values in itertools.product(*(range(degree + 1) for degree in degrees.values())):
        at = dict(zip(degrees, values))
        total = sum(c * math.prod(at[term] ** exponent for term, exponent in monomial) for monomial, c in p.items())
        if total.denominator != 1:
            return False
    return True


# --- proofs ----------------------------------------------------------------------------------------------------------


class Proof:
    """Follows the steps of a proof."""

    def __init__(self, statement, certificate):
        self.s = statement
        require(all(term < len(statement.nodes) for term in certificate["whole"]), "no such term")
        self.expansion = Expansion(statement, certificate["whole"])
        self.assumed = {(holds, term) for _, holds, term, law in statement.givens if not law}
        self.facts, self.laws, self.running, self.absurd = [], [], None, False
        self.excluded = []

    def follow(self, steps, where="step"):
        for number, step in enumerate(steps, 1):
            try:
                getattr(self, "step_" + step[0])(*step[1:])
            except Refused as refusal:
                raise Refused("%s %d (%s): %s" % (where, number, step[0], refusal)) from None
            except (KeyError, IndexError, TypeError, ValueError, AttributeError, ZeroDivisionError) as error:
                raise Refused("%s %d (%s): %s" % (where, number, step[0], error)) from None

    # what is known

    def knows(self, holds, term):
        implied = {NONZERO: (NONZERO, POSITIVE), NONNEGATIVE: (NONNEGATIVE, POSITIVE, ZERO)}.get(holds, (holds,))
        if self.absurd or any((h, term) in self.assumed for h in implied):
            return True
        return self.knows_polynomial(holds, self.expansion.property_of(holds, term))

    def knows_polynomial(self, holds, p):
        if self.absurd:
            return True
        if holds == ZERO and not p:
            return True
        if holds == NONZERO and self.s.sign(p) is not None:
            return True
        if holds == POSITIVE and self.s.sign(p) == 1:
            return True
        if holds == NONNEGATIVE and (not p or self.s.sign(p) == 1):
            return True
        if holds == INTEGER and integer_valued(p):
            if all((INTEGER, term) in self.assumed or (INTEGER, generator(term)) in self.facts for term in generators(p)):
                return True
        return any(self.implies(fact, holds, p) for fact in self.facts)

    @staticmethod
    def implies(fact, holds, p):
        known, q = fact
        if not q and not p:
            return known == ZERO and holds in (ZERO, NONNEGATIVE)
        factor = ratio(q, p)
        if factor is None:
            return False
        if holds == INTEGER:
            return known == INTEGER and factor == 1
        if holds == ZERO:
            return known == ZERO
        if holds == NONZERO:
            return known in (NONZERO, POSITIVE)
        if known == ZERO:
            return holds == NONNEGATIVE
        return factor > 0 and (known == POSITIVE or (known == NONNEGATIVE and holds == NONNEGATIVE))

    def need(self, holds, term):
        require(self.knows(holds, term), "a term is not known to be %s" % holds)

    def defined(self, *terms):
        for holds, of in self.s.domain(*terms):
            self.need(holds, of)

    def reals(self, *terms):
        require(all(self.s.is_real(term) for term in terms), "a law of real numbers for complex ones")

    def real(self, p):
        self.reals(*generators(p))

    def add(self, holds, p):
        if holds == ZERO and p and value_of_constant(p) is not None:
            self.absurd = True
        self.facts.append((holds, p))

    def conclude(self, holds, term):
        self.add(holds, self.expansion.property_of(holds, term))

    def fact(self, number, *wanted):
        require(0 <= number < len(self.facts), "no such fact")
        holds, p = self.facts[number]
        require(holds in wanted, "fact %d is %s" % (number, holds))
        return p

    def combination(self, terms):
        total = {}
        for coefficient, number in terms:
            total = add(total, times(read_polynomial(coefficient), self.fact(number, ZERO)))
        return total

    def product(self, factors, *wanted):
        result = constant(1)
        for number, exponent in factors:
            require(exponent >= 0, "a negative exponent")
            result = times(result, power(self.fact(number, *wanted), exponent))
        return result

    # the steps

    def step_given(self, number):
        require(0 <= number < len(self.s.givens), "no such given")
        _, holds, term, law = self.s.givens[number]
        require(not law, "the given is a law")
        self.conclude(holds, term)

    def step_zero(self, target, exponent, squares, factors, terms):
        """factors * (target^exponent + squares) = combination of what vanishes; no factor vanishes."""
        target = read_polynomial(target)
        require(exponent > 0, "the power is 0")
        left = power(target, exponent)
        if squares:
            require(exponent % 2 == 0, "squares need an even power")
            self.real(target)
            for factor, p in squares:
                p = read_polynomial(p)
                require(Fraction(factor) > 0, "a square needs a positive factor")
                self.real(p)
                left = add(left, times(p, p), Fraction(factor))
        left = times(left, self.product(factors, NONZERO, POSITIVE))
        require(left == self.combination(terms), "the two sides are not the same polynomial")
        self.add(ZERO, target)

    def step_nonzero(self, target, cofactor, factors, terms):
        """cofactor * target = product of what does not vanish + combination of what does."""
        target = read_polynomial(target)
        left = times(read_polynomial(cofactor), target)
        right = add(self.product(factors, NONZERO, POSITIVE), self.combination(terms))
        require(left == right, "the two sides are not the same polynomial")
        self.add(NONZERO, target)

    def step_sign(self, target, strict, factors, summands, terms):
        """positive factors * target = sum of squares times what is not negative + combination of what vanishes."""
        target = read_polynomial(target)
        self.real(target)
        left, right, sure = times(self.product(factors, POSITIVE), target), self.combination(terms), False
        for factor, facts, p in summands:
            p = read_polynomial(p)
            require(Fraction(factor) > 0, "a summand needs a positive factor")
            self.real(p)
            part = scaled(times(p, p), Fraction(factor))
            sure |= bool(value_of_constant(p)) and all(self.facts[n][0] == POSITIVE for n in facts)
            for number in facts:
                part = times(part, self.fact(number, POSITIVE, NONNEGATIVE))
            right = add(right, part)
        require(sure or not strict, "no summand is positive for certain")
        require(left == right, "the two sides are not the same polynomial")
        self.add(POSITIVE if strict else NONNEGATIVE, target)

    def step_squeezed(self, low, high):
        low, high = (self.fact(n, POSITIVE, NONNEGATIVE) for n in (low, high))
        require(low == scaled(high, -1), "the two facts are not opposite")
        self.add(ZERO, low)

    def step_congruence(self, left, right):
        a, b = self.s.nodes[left], self.s.nodes[right]
        require(a[0] == b[0] and a[0] in FUNCTIONS + ("root", "value", "realpower"), "not the same function")
        if a[0] == "realpower":
            same, differ = ((1, 2) if a[1] == b[1] else (2, 1))
            require(a[same] == b[same], "neither base nor exponent is the same")
            arguments = self.s.difference(a[differ], b[differ])
        else:
            require(a[1:-1] == b[1:-1], "not the same function")
            arguments = self.s.difference(a[-1], b[-1])
        self.defined(arguments)
        self.need(ZERO, arguments)
        self.conclude(ZERO, self.s.difference(left, right))

    def step_cases(self, on, order, holds, target, branches):
        on, target = read_polynomial(on), read_polynomial(target)
        if order:
            self.real(on)
            cases = [(POSITIVE, on), (ZERO, on), (POSITIVE, scaled(on, -1))]
        else:
            cases = [(ZERO, on), (NONZERO, on)]
        require(len(cases) == len(branches), "not one branch for each case")
        for number, (case, steps) in enumerate(zip(cases, branches), 1):
            outer = len(self.facts), len(self.laws), self.absurd
            self.add(*case)
            self.follow(steps, "case %d, step" % number)
            require(self.knows_polynomial(holds, target), "case %d does not lead to what is to be shown" % number)
            del self.facts[outer[0]:], self.laws[outer[1]:]
            self.absurd = outer[2]
        self.add(holds, target)

    # laws

    def source(self, source):
        """A law as (time, term, conditions, domain of what it was derived from, flight), impacts moved on."""
        if source[0] == "derived":
            require(0 <= source[1] < len(self.laws), "no such law")
            return self.laws[source[1]]
        _, holds, term, law = self.s.givens[source[1]]
        shift = source[2]
        require(law and holds == ZERO and law["time"], "no law over a time that says what vanishes")
        require(not shift or law["every"], "the law does not extend so far")
        moved = lambda of: self.s.moved(self.s.written_out(of), None, None, shift)
        conditions = [(h, moved(of)) for h, of in law["conditions"]]
        flight = law["flight"][0] + shift if law["flight"] else None
        return law["time"][0], moved(term), conditions, [], flight

    def step_law(self, source, at):
        at = at[0] if at else None
        if source[0] == "derived":
            require(at is not None, "a derived law needs a time")
            time, term, conditions, domain, flight = self.source(source)
            conditions = conditions + domain
            require(flight is None or self.s.is_end(at, flight) or self.s.runs_in(at, flight, self.running), "no time of the flight")
            holds, shift = ZERO, 0
        else:
            _, holds, term, law = self.s.givens[source[1]]
            shift = source[2]
            require(law and bool(law["time"]) == (at is not None), "no law, or not over a time")
            require(not shift or law["every"], "the law does not extend so far")
            time = law["time"][0] if law["time"] else None
            conditions = [(h, self.s.written_out(of)) for h, of in law["conditions"]]
            term = self.s.written_out(term)
            if law["flight"] and at is not None:
                flight = law["flight"][0] + shift
                require(self.s.is_end(at, flight) or self.s.runs_in(at, flight, self.running), "no time of the flight")
        if at is not None:
            self.defined(at)
        term = self.s.moved(term, time, at, shift)
        conditions = [(h, self.s.moved(of, time, at, shift)) for h, of in conditions]
        self.defined(term, *(of for _, of in conditions))
        for condition, of in conditions:
            self.need(condition, of)
        self.conclude(holds, term)

    def step_derivative(self, source):
        time, term, conditions, domain, flight = self.source(source)
        terms = [term] + [of for _, of in conditions]
        for of in terms:
            self.s.by(of, time)  # refuses what is not continuous
        # the law holds only where all that it came from has values: at a single time that says nothing of the derivative
        domain = domain + self.s.domain(*terms)
        domain = domain + self.s.holding_near(conditions + domain, terms, lambda symbol: symbol == time)
        self.laws.append((time, self.s.by(term, time), conditions, domain, flight))

    def step_constant(self, of, time, at, flight, steps):
        """A term whose derivative by `time` vanishes wherever that is has the value that it has at `at`."""
        flight = flight[0] if flight else None
        require(self.s.meaning(time)[0] == "fresh", "the time of a law is a symbol of the statement")
        speaks = lambda p: any(self.s.holds(self.s.written_out(term), time) for term in generators(p))
        require(not any(speaks(p) for _, p in self.facts), "something is known of the time of a law")
        given = (term for _, _, term, law in self.s.givens if not law)
        require(not any(self.s.holds(self.s.written_out(term), time) for term in given), "something is given of the time")
        if flight is not None:
            require(self.s.is_end(at, flight) or self.s.runs_in(at, flight, self.running), "no time of the flight")
            require(self.s.nodes[at] != ("symbol", time), "the constant is taken at the running time")
        of = self.s.written_out(of)
        slope = self.s.by(of, time)
        outer = len(self.facts), len(self.laws), self.absurd, self.running
        self.running = (time, flight) if flight is not None else None
        self.follow(steps, "within, step")
        self.defined(of, slope)
        self.need(ZERO, slope)
        del self.facts[outer[0]:], self.laws[outer[1]:]
        self.absurd, self.running = outer[2:]
        self.defined(at)
        there = self.s.moved(of, time, at, 0)
        self.laws.append((time, self.s.difference(of, there), [], [], flight))

    def step_along(self, number, equation, by):
        map_ = self.s.maps[number]
        require(number >= 0 and equation >= 0 and by in map_[1], "a map is differentiated by what it starts from")
        require((INTEGER, self.s.symbol(by)) not in self.assumed, "a map is differentiated by an integer")
        term = self.s.written_out(map_[2][equation])
        fixed = lambda node: node[0] == "symbol" and self.s.meaning(node[1])[0] in ("partial", "invariant")
        require(not any(fixed(self.s.nodes[inner]) for inner in self.s.inside(term)), "what changes is taken as fixed")
        slope = self.s.along(term, map_, by)
        self.defined(term, slope)
        moves = lambda symbol: self.s.meaning(symbol)[0] in ("time", "state")
        for holds, of in self.s.holding_near(self.s.domain(term), [term], moves):
            self.need(holds, of)
        self.conclude(ZERO, slope)

    def step_generic(self, term):
        def free(term):
            nodes = (self.s.nodes[inner] for inner in self.s.inside(term))
            plain = ("number", "sum", "product", "power")
            return all(node[0] in plain or node[0] == "symbol" and node[1] in self.s.generic for node in nodes)

        bound = any(holds == ZERO and free(given) for _, holds, given, _ in self.s.givens)
        require(free(term) and not bound, "no polynomial in generic symbols that are free")
        self.excluded.append(term)
        self.conclude(NONZERO, term)

    def step_unfold(self, term):
        node = self.s.nodes[term]
        if node[0] == "symbol":
            require(node[1] in self.s.definitions, "the symbol is no abbreviation")
            return self.conclude(ZERO, self.s.difference(term, self.s.definitions[node[1]]))
        self.defined(term)
        numerator, divisors = self.expansion.unfolded(term)
        product = generator(term)
        for p, n in divisors.values():
            product = times(product, power(p, n))
        self.add(ZERO, add(product, numerator, -1))

    def step_enclosure(self, p):
        p = read_polynomial(p)
        require(self.s.sign(p) == 1, "the value is not known to be positive")
        self.add(POSITIVE, p)

    def step_between(self, p, within):
        require(not self.s.complex, "an order between complex numbers")
        p, box = read_polynomial(p), {}
        for low, high in within:
            (letter, below, first), (other, above, second) = (self.bound(n) for n in (low, high))
            require(letter == other and letter not in box and first and not second, "no bounds of a letter on both sides")
            box[letter] = mpmath.iv.mpf([below.a, above.b])
        open_, left = [box], 4000
        while open_:
            box = open_.pop()
            value = self.s.enclosed(p, box)
            if value is not None and value.a > 0:
                continue
            require(box and left, "the value is not known to be positive between these bounds")
            left -= 1
            letter = max(box, key=lambda letter: box[letter].delta)
            middle = box[letter].mid.a
            open_ += [{**box, letter: mpmath.iv.mpf(part)} for part in ((box[letter].a, middle), (middle, box[letter].b))]
        self.add(POSITIVE, p)

    def bound(self, n):
        """The letter of a fact that bounds one, the number that it gives, and whether it is a lower bound."""
        fact = self.fact(n, POSITIVE, NONNEGATIVE)
        moving = [m for m in fact if any(not self.s.is_closed(term) for term, _ in m)]
        require(len(moving) == 1 and len(moving[0]) == 1 and moving[0][0][1] == 1, "no bound of a letter")
        letter, factor = moving[0][0][0], fact[moving[0]]
        require(self.s.nodes[letter][0] == "symbol", "no bound of a letter")
        rest = self.s.enclosed({m: value for m, value in fact.items() if m != moving[0]}, {})
        require(rest is not None, "a bound without a value")
        return letter, -rest / exactly(factor), factor > 0

    def step_axiom(self, name, terms):
        require(name in AXIOMS, "there is no such axiom")
        letters, guards, conclusion = AXIOMS[name]
        require(len(letters) == len(terms), "an axiom of another number of letters")
        instance = Instance(self.s, dict(zip(letters, terms)))
        for guard in guards:
            self.meets(instance, guard)
        self.conclude(*instance.relation(conclusion))

    def meets(self, instance, guard):
        word, bracket, inside = guard.partition("(")
        of = inside.rstrip(")")
        if guard in ("complex", "reals"):
            require(self.s.complex == (guard == "complex"), "an axiom of real numbers for complex ones, or the other way")
        elif bracket and word in ("even", "odd", "natural"):
            number = instance.written(instance.letters[of])
            require(word == "natural" or number % 2 == (word == "odd"), "no %s number" % word)
        elif bracket and word in ("defined", "real", "integer"):
            term = instance.read(guard[len(word):])
            {"defined": self.defined, "real": self.reals, "integer": lambda of: self.need(INTEGER, of)}[word](term)
        else:
            holds, term = instance.relation(guard)
            self.defined(term)
            self.need(holds, term)


class Instance:
    """Reads guards and conclusions of an axiom, with terms for its letters."""

    RELATIONS = ((" = ", ZERO), (" != ", NONZERO), (" >= ", NONNEGATIVE), (" > ", POSITIVE))

    def __init__(self, statement, letters):
        self.s, self.letters = statement, letters

    def relation(self, text):
        sign, holds = next(pair for pair in self.RELATIONS if pair[0] in text)
        left, right = text.split(sign)
        return holds, self.read(left) if right == "0" else self.s.difference(self.read(left), self.read(right))

    def read(self, text):
        return self.term(ast.parse(text.strip().replace("^", "**"), mode="eval").body)

    def written(self, term):
        node = self.s.nodes[term]
        require(node[0] == "number" and node[1] >= 0 and node[1].denominator == 1, "an index or exponent is not written out")
        return int(node[1])

    def term(self, node):
        s = self.s
        if isinstance(node, ast.Constant):
            return s.number(node.value)
        if isinstance(node, ast.Name):
            return self.letters[node.id] if node.id in self.letters else s.add((node.id,))
        if isinstance(node, ast.UnaryOp):
            literal = isinstance(node.operand, ast.Constant)
            return s.number(-node.operand.value) if literal else s.negative(self.term(node.operand))
        if isinstance(node, ast.Call):
            of = [self.term(argument) for argument in node.args]
            name = {"power": "realpower"}.get(node.func.id, node.func.id)
            if name == "root":
                index = self.written(of[0])
                require(index >= 2, "a root has an index of 2 or more")
                return s.add(("root", index, of[1]))
            return s.add((name, *of))
        if isinstance(node.op, ast.Pow):
            return s.add(("power", self.term(node.left), self.written(self.term(node.right))))
        if isinstance(node.op, ast.Mult):
            factors = [node.right]
            while isinstance(node.left, ast.BinOp) and isinstance(node.left.op, ast.Mult):
                node = node.left
                factors.append(node.right)
            return s.product([self.term(factor) for factor in [node.left, *reversed(factors)]])
        left, right = self.term(node.left), self.term(node.right)
        build = {ast.Add: lambda: s.sum([left, right]), ast.Sub: lambda: s.difference(left, right)}
        return build.get(type(node.op), lambda: s.quotient(left, right))()


def check_proof(statement, certificate):
    """Every goal follows by the steps."""
    proof = Proof(statement, certificate)
    proof.follow(certificate["steps"])
    require(statement.goals, "there is no claim")
    for holds, term in statement.goals:
        proof.defined(term)
        require(proof.knows(holds, term), "the steps do not lead to the claim")
    return proof


def check_contradiction(statement, certificate):
    proof = Proof(statement, certificate)
    proof.follow(certificate["steps"])
    require(proof.absurd and not proof.excluded, "the steps lead to no contradiction")


# --- points ----------------------------------------------------------------------------------------------------------


class Point:
    """A point: values of symbols and functions. All that is given holds there, or this is refused."""

    def __init__(self, statement, data):
        self.s = s = statement
        self.solved, self.sample = dict(data["solved"]), dict(data["sample"])
        self.named = {function: (time, term) for function, time, term in data["functions_named"]}
        self.table = {}
        for function, order, at, value in data["table"]:
            require((function, order, at) not in self.table, "a value is in the table twice")
            self.table[function, order, at] = value
        self.periods = {}
        self.expansion = Expansion(s, data["certificate"]["whole"])
        self.zeros = self.shown_zeros(data["certificate"])
        require(len(self.named) == len(data["functions_named"]), "a function is named twice")
        self.check_values()
        self.check_functions()
        self.check_table()
        self.check_flights()
        for label, holds, term, law in list(s.givens):
            try:
                if law:
                    self.check_law(holds, term, law)
                else:
                    self.check_given(holds, term)
            except Refused as refusal:
                raise Refused("(%s): %s" % (label, refusal)) from None
        self.check_maps()

    def shown_zeros(self, certificate):
        """What vanishes by steps that use no premise."""
        bare = self.s.copy({"symbols": [], "functions": [], "terms": []})
        bare.givens, bare.goals, bare.maps = [], [], []
        proof = Proof(bare, certificate)
        proof.follow(certificate["steps"])
        require(not proof.absurd and not proof.excluded, "numbers contradict each other, or a set is excluded at a point")
        # terms that the steps made keep their numbers
        for node in bare.nodes[len(self.s.nodes):]:
            self.s.add(node)
        return [p for holds, p in proof.facts if holds == ZERO]

    def check_values(self):
        s = self.s
        require(not self.solved.keys() & self.sample.keys(), "a symbol has two values")
        for symbol, value in [*self.solved.items(), *self.sample.items()]:
            require(symbol not in s.definitions, "an abbreviation has no value of its own")
            require(s.written_out(value) == value, "a value holds an abbreviation")
            imaginary = any(s.nodes[inner] == ("i",) for inner in s.inside(value))
            require(symbol in s.complex_symbols or not imaginary, "a real symbol has a complex value")
            if symbol in self.sample:
                require(s.is_closed(value), "a value of the sample holds symbols")
                found = s.evaluate(value)
                real = not isinstance(found, mpmath.mpc) or found.imag == 0
                require(real or symbol in s.complex_symbols, "a real symbol has a complex value")
            else:
                held = {s.nodes[inner][1] for inner in s.inside(value) if s.nodes[inner][0] == "symbol"}
                require(not held & self.solved.keys(), "a solved value holds a solved symbol")

    # functions

    def check_functions(self):
        s = self.s
        for function, (time, term) in self.named.items():
            require(s.meaning(time)[0] == "fresh" and time not in self.sample and time not in self.solved, "a function is a term in a symbol of its own")
            require(s.written_out(term) == term, "a function holds an abbreviation")
            for inner in s.inside(term):
                node = s.nodes[inner]
                kind = node[0]
                if not s.holds(inner, time):
                    continue
                require(kind != "realpower", "a function is not smooth everywhere")
                base = node[2] if kind in ("quotient", "root") else node[-1]
                if kind in ("quotient", "root", "ln") and s.holds(base, time):
                    require(self.positive_everywhere(base, time), "a function is not smooth everywhere")
                require(kind not in ("arcsin", "arccos"), "a function is not smooth everywhere")
        tabled = {function for function, _, _ in self.table}
        require(not tabled & self.named.keys(), "a function is named and in the table")
        for function in tabled | self.named.keys():
            # its declared derivatives are named as its derivatives are, or not at all
            time, slope = self.named.get(function, (None, None))
            of, met = function, {function}
            while of in s.derivatives:
                of = s.derivatives[of]
                if slope is not None:
                    slope = s.by(slope, time)
                    require(of not in tabled, "a function is named and its derivative is in the table")
                    if of in self.named:
                        other, term = self.named[of]
                        self.vanish(s.difference(slope, s.substitute(term, other, s.symbol(time))), "a function is not the derivative that it is declared to be")
                else:
                    require(of not in met, "a function that is a derivative of its own has only single values")
                    require(of not in self.named, "a derivative is named of a function that has only single values")
                if of in met:
                    break
                met.add(of)

    def positive_everywhere(self, term, time):
        """A polynomial in even powers of the symbol with positive coefficients."""
        numerator, divisors = Expansion(self.s).of(self.put_in(term, self.sample))
        of = self.s.symbol(time)
        even = all(inner == of and exponent % 2 == 0 for monomial in numerator for inner, exponent in monomial)
        return even and not divisors and () in numerator and all(value > 0 for value in numerator.values())

    def put_in(self, term, values):
        return self.s.rewrite(term, lambda node: values.get(node[1]) if node[0] == "symbol" else None)

    def translate(self, term, running=None):
        """With solved symbols, functions and the table put in. Values at the running time stay."""
        s = self.s

        def new(node):
            if node[0] == "symbol":
                return self.solved.get(node[1])
            if node[0] == "value":
                _, function, order, at = node
                if function in self.named:
                    time, slope = self.named[function]
                    for _ in range(order):
                        slope = s.by(slope, time)
                    return s.substitute(slope, time, at)
                if running is not None and s.holds(at, running):
                    return None
                found = self.looked_up(function, order, at)
                require(found is not None, "a function has no value at one of its times")
                return found
            return None

        term = s.written_out(term)
        for _ in range(40):
            term, before = s.rewrite(term, new), term
            if term == before:
                return term
        raise Refused("values that stand in each other")

    def looked_up(self, function, order, at):
        s, exact = self.s, Expansion(self.s)
        period = self.periods.get(function)
        period = self.put_in(period, self.solved) if period is not None else None
        for turns in [0] + ([n for n in range(-6, 7) if n] if period is not None else []):
            for (f, n, time), value in self.table.items():
                if (f, n) != (function, order):
                    continue
                if turns:
                    time = s.sum([time, s.product([s.number(turns), period])])
                if not exact.of(s.difference(at, time))[0]:
                    return value
        return None

    # numbers

    def split(self, p):
        """The polynomials without and with the imaginary unit, its square being -1."""
        unit, split = self.s.add(("i",)), ({}, {})
        for monomial, value in p.items():
            exponent = dict(monomial).get(unit, 0)
            rest = tuple(pair for pair in monomial if pair[0] != unit)
            value = -value if exponent % 4 >= 2 else value
            split[exponent % 2][rest] = split[exponent % 2].get(rest, 0) + value
        return tuple({m: v for m, v in part.items() if v} for part in split)

    def is_zero(self, p):
        return all(not part or any(ratio(part, zero) is not None for zero in self.zeros) for part in self.split(p))

    def number(self, term):
        """The value of a number: exactly 0, or not 0 for certain."""
        for holds, of in self.s.domain(term):
            require(self.has(holds, of), "something written is not defined at the point")
        for inner in self.s.inside(term):
            node = self.s.nodes[inner]
            if node[0] == "realpower":
                base, exponent = self.s.evaluate(node[1]), self.s.evaluate(node[2])
                if self.s.complex:
                    require(abs(base) > SMALL, "a power is not defined at the point")
                    continue
                whole = exponent == mpmath.nint(exponent)
                fine = base > SMALL or (base < -SMALL and whole) or (abs(base) <= SMALL and exponent >= 0 and (exponent > SMALL or whole))
                require(fine, "a power is not defined at the point")
        if self.is_zero(self.expansion.of(term)[0]):
            return mpmath.mpf(0)
        # an exponential is as good as its argument, however small it is
        top = self.expansion.of(term)[0]
        is_exponential = len(top) == 1 and all(self.s.nodes[n][0] == "exp" for n in generators(top))
        for digits in (DIGITS, 8 * DIGITS, 64 * DIGITS):
            with mpmath.workdps(digits):
                value = self.s.evaluate(term)
                size = 0 if is_exponential else 1 + sum(abs(self.s.evaluate(inner)) for inner in self.s.inside(term))
                if mpmath.isfinite(value) and abs(value) > mpmath.mpf(10) ** (-3 * digits // 4) * size:
                    return value
        raise Refused("a value is too close to 0 to tell")

    def has(self, holds, term):
        """Whether a number has a property."""
        if holds == INTEGER:
            numerator, divisors = self.expansion.of(term)
            value = value_of_constant(numerator)
            require(value is not None and not divisors, "not known to be an integer")
            return value.denominator == 1
        value = self.number(term)
        if holds in (ZERO, NONZERO):
            return (value == 0) == (holds == ZERO)
        real = not isinstance(value, mpmath.mpc) or value.imag == 0 or self.is_zero(self.split(self.expansion.of(term)[0])[1])
        require(real, "an order of complex numbers")
        return mpmath.re(value) > 0 or (holds == NONNEGATIVE and value == 0)

    def holds(self, holds, term):
        return self.has(holds, self.put_in(self.translate(term), self.sample))

    def vanish(self, term, why):
        if self.is_zero(self.expansion.of(term)[0]):
            return
        require(not self.s.generic, why)
        require(self.is_zero(self.expansion.of(self.put_in(term, self.sample))[0]), why)

    # what is given

    def check_given(self, holds, term):
        if holds == ZERO and self.s.generic:
            # what the generic symbols depend on runs around the point, all else stays
            around = set()
            for symbol in self.s.generic:
                value = self.translate(self.s.add(("symbol", symbol)))
                nodes = [self.s.nodes[inner] for inner in self.s.inside(value)]
                around |= {node[1] for node in nodes if node[0] == "symbol"}
            fixed = {symbol: value for symbol, value in self.sample.items() if symbol not in around}
            numerator, _ = Expansion(self.s).of(self.put_in(self.translate(term), fixed))
            require(not numerator, "the premise does not hold identically in the generic symbols")
        require(self.holds(holds, term), "it does not hold at the point")

    def check_law(self, holds, term, law):
        s = self.s
        require(holds == ZERO, "a law that is an inequality")
        if not law["time"]:
            require(law["every"] and not law["flight"], "a law without a time")
            return self.check_sequence(term, law)
        time = law["time"][0]
        # the law speaks of every time, whatever the value of its symbol at the point
        running = s.symbol_of(("fresh", "law", len(s.symbols)))
        at = s.symbol(running)
        if not law["flight"]:
            found = self.period_of(term, time)
            if found and found[0] in self.periods and self.periods[found[0]] == found[1]:
                return None
            moved = s.substitute(s.written_out(term), time, at)
            return self.vanish(self.translate(moved, running), "the law does not hold at all times")
        base = law["flight"][0]
        for flight in self.flights():
            require(flight == base or law["every"], "the law does not extend to a flight of the statement")
            moved = s.moved(s.written_out(term), time, at, flight - base)
            self.vanish(self.translate(moved, running), "the law does not hold at all times")
        return None

    def flights(self):
        impacts = set(self.s.times) | {m[2] for _, m in self.s.symbols if m[0] == "state"}
        between = set(range(min(impacts), max(impacts))) if impacts else set()
        return sorted(between | {f[2] for f in self.s.functions if f[0] == "flight"})

    def check_sequence(self, term, law):
        """A recursion that can be solved for its first and its last state goes on from any values."""
        s = self.s

        def states(term):
            found = [s.nodes[inner][1] for inner in s.inside(s.written_out(term)) if s.nodes[inner][0] == "symbol"]
            return {n: s.meaning(n) for n in found if s.meaning(n)[0] == "state"}

        own = states(term)
        names = {meaning[1] for meaning in own.values()}
        require(len(names) == 1, "a recursion of no state or several")
        for _, _, other, its in s.givens:
            if its and its["every"] and not its["flight"] and (other, its) != (term, law):
                require(not names & {m[1] for m in states(other).values()}, "states are bound by several recursions")
        indices = sorted(meaning[2] for meaning in own.values())
        require(indices[0] < indices[-1], "a recursion that cannot be solved for its ends")
        for symbol, meaning in own.items():
            if meaning[2] in (indices[0], indices[-1]):
                slope = s.by(term, symbol)
                require(not any(s.holds(slope, n) for n in own), "a recursion that cannot be solved for its ends")
                require(self.holds(NONZERO, slope), "a recursion that cannot be solved for its ends")
        spoken = sorted(m[2] for _, m in s.symbols if m[0] == "state" and m[1] in names)
        for shift in range(spoken[0] - indices[0], spoken[-1] - indices[-1] + 1):
            self.check_given(ZERO, s.moved(s.written_out(term), None, None, shift))

    def period_of(self, term, time):
        """The function and its period, where a law says nothing else."""
        s = self.s
        numerator, divisors = Expansion(s).of(s.written_out(term))
        single = [(s.nodes[m[0][0]], v) for m, v in sorted(numerator.items()) if len(m) == 1 and m[0][1] == 1]
        if divisors or len(numerator) != 2 or len(single) != 2 or single[0][1] != -single[1][1]:
            return None
        (u, _), (v, _) = single
        if u[0] != "value" or v[0] != "value" or u[1:3] != v[1:3] or u[2] != 0:
            return None
        steady = s.difference(s.by(u[3], time), s.number(1))
        period = s.substitute(s.difference(u[3], v[3]), time, s.number(0))
        apart = s.difference(s.difference(u[3], v[3]), period)
        exact = Expansion(s)
        return None if exact.of(steady)[0] or exact.of(apart)[0] else (u[1], period)

    def chain(self, function):
        chain, size = {function}, 0
        while size < len(chain):
            size = len(chain)
            for f, g in self.s.derivatives.items():
                if f in chain or g in chain:
                    chain |= {f, g}
        return chain

    def check_table(self):
        s = self.s
        tabled = {function for function, _, _ in self.table}
        bound = set().union(*(self.chain(f) for f in tabled)) if tabled else set()
        for label, _, term, law in list(s.givens):
            if not law or not law["time"] or law["flight"]:
                continue
            written = s.written_out(term)
            if not any(s.nodes[n][0] == "value" and s.nodes[n][1] in bound for n in s.inside(written)):
                continue
            found = self.period_of(term, law["time"][0])
            require(found, "(%s) binds a function that has only single values" % label)
            function, period = found
            require(self.holds(NONZERO, period), "a period is 0")
            while function is not None:
                known = self.periods.setdefault(function, period)
                a, b = (self.translate(p) for p in (known, period))
                exact = Expansion(s)
                require(not exact.of(s.sum([a, b]))[0] or not exact.of(s.difference(a, b))[0], "a function has two periods")
                function = s.derivatives.get(function)
        entries = sorted(self.table)
        value = lambda term: s.evaluate(self.put_in(self.translate(term), self.sample))
        for n, (f, order, a) in enumerate(entries):
            for g, other, b in entries[n + 1:]:
                if g not in self.chain(f) or (a == b and (f, order) != (g, other)):
                    continue
                apart = value(a) - value(b)
                require(abs(apart) > SMALL, "two times of the table may be the same")
                for period in [self.periods[h] for h in sorted(self.chain(f)) if h in self.periods][:1]:
                    turns = apart / value(period)
                    require(abs(turns - mpmath.nint(turns)) > SMALL, "two times of the table may be the same but for whole periods")
            if s.functions[f][0] == "flight":
                impact = s.functions[f][2]
                ends = [s.times[n] for n in (impact, impact + 1) if n in s.times]
                for end in (end for end in ends if end in self.sample or end in self.solved):
                    require(abs(value(a) - value(s.symbol(end))) > SMALL, "a time of the table may be an end of the flight")

    def check_flights(self):
        """A flight that is named has the states at its two ends."""
        s = self.s
        for function, (time, slope) in list(self.named.items()):
            if s.functions[function][0] != "flight":
                continue
            _, name, impact = s.functions[function]
            for order in range(3):
                named = s.dotted(name, order)
                for index, after in ((impact, True), (impact + 1, False)):
                    meaning = ("state", named, index, int(after and named not in s.continuous))
                    symbol = s.symbol_number.get(meaning)
                    if named not in s.states or index not in s.times or symbol is None:
                        continue
                    if symbol not in self.solved and symbol not in self.sample:
                        continue
                    at = s.substitute(slope, time, s.symbol(s.times[index]))
                    self.check_given(ZERO, s.difference(at, s.symbol(symbol)))
                slope = s.by(slope, time)

    def check_maps(self):
        """Derivatives along maps have the values that the implicit function theorem gives them."""
        s = self.s
        value = lambda term: s.evaluate(self.put_in(self.translate(term), self.sample))
        for of, starts, equations in s.maps:
            wanted = {by: [n for n in of if s.symbol_number.get(("partial", n, by)) in self.solved.keys() | self.sample.keys()] for by in starts}
            if not any(wanted.values()) or len(equations) != len(of):
                continue
            matrix = mpmath.matrix([[value(s.by(term, n)) for n in of] for term in equations])
            require(abs(mpmath.det(matrix)) > SMALL, "the map has no derivatives at the point")
            for by, named in wanted.items():
                if named:
                    right = mpmath.matrix([-value(s.by(term, by)) for term in equations])
                    solution = mpmath.lu_solve(matrix, right)
                    for row, n in enumerate(of):
                        if n in named:
                            found = value(s.symbol(s.symbol_number["partial", n, by]))
                            require(abs(found - solution[row]) < mpmath.mpf(10) ** -35 * (1 + abs(found)), "a derivative along a map is not what the map gives")

    def fails(self):
        """Whether a goal fails at the point."""
        for holds, term in self.s.goals:
            # a solution that is not defined is none
            for condition, of in self.s.domain(term):
                if not self.holds(condition, of):
                    return True
            if not self.holds(holds, term):
                return True
        return False


# --- the translation of the printed formulas --------------------------------------------------------------------------


class Elsewhere(Exception):
    """A formula has no value at a random point."""


class Values:
    """Random values of all symbols and functions, by the names in which formulas are printed."""

    def __init__(self, statement, seed, definitions=(), maps=()):
        self.s, self.seed, self.numbers, self.bound = statement, seed, {}, {}
        self.definitions, self.maps = dict(definitions), dict(maps)
        # beyond seeds with values of formulas over the reals, formulas are compared over the complex numbers
        self.anywhere = seed >= 60
        whole = (statement.nodes[term] for _, holds, term, law in statement.givens if holds == INTEGER and not law)
        self.integers = {statement.symbols[node[1]][0] for node in whole if node[0] == "symbol"}

    def draw(self, key):
        if key not in self.numbers:
            source = random.Random("%s %s" % (self.seed, key))
            drawn = mpmath.mpf(source.randint(200, 900))
            if self.seed >= 20 and key not in self.integers:
                # elsewhere, where there is no value near 0
                drawn *= source.choice([1, 3, 40] if self.seed < 40 else [-40, -3, 1, 3, 40])
            self.numbers[key] = mpmath.floor(drawn / 50) if key in self.integers else drawn / 1009
        return self.numbers[key]

    # of the kernel's terms

    def symbol(self, symbol):
        printed, meaning = self.s.symbols[symbol]
        return self.partial(*(self.s.symbols[n][0] for n in meaning[1:])) if meaning[0] == "partial" else self.draw(printed)

    def value(self, function, order, at):
        meaning = self.s.functions[function]
        return self.unknown(meaning[1], meaning[2] if meaning[0] == "flight" else None, order, at)

    # of the formulas as printed

    def __call__(self, name):
        if name in self.bound:
            return self.bound[name]
        meaning = self.definitions.get(name)
        return self.draw(name) if meaning is None else meaning(self)

    def number(self, text):
        value = Fraction(text)
        return mpmath.mpf(value.numerator) / value.denominator

    def integral(self, of, by, low, high):
        """The integral of a formula; `low` and `high` give the limits. One to infinity is that to a number, and from there on by
        the rule of mpmath for half lines."""

        def at(x):
            self.bound[by] = x
            return of()

        def between(low, high):
            found, apart = quadrature(at, lambda: (low(), high()))
            self.s.apart = max(self.s.apart, apart)
            return found

        def beyond(number, infinity):
            with mpmath.workdps(50):
                return mpmath.quad(at, [number(), infinity])

        infinite = [mpmath.isinf(low()), mpmath.isinf(high())]
        if all(infinite):
            zero = lambda: mpmath.mpf(0)
            return self.integral(of, by, low, zero) + self.integral(of, by, zero, high)
        if infinite[0]:
            next_to = lambda: high() + mpmath.sign(low())
            found = between(next_to, high) - beyond(next_to, low())
        elif infinite[1]:
            next_to = lambda: low() + mpmath.sign(high())
            found = between(low, next_to) + beyond(next_to, high())
        else:
            found = between(low, high)
        self.bound.pop(by, None)
        return found

    def root(self, of, index):
        if mpmath.im(of) == 0 and mpmath.re(of) < 0 and not self.s.complex and index % 2 == 0 and not self.anywhere:
            raise Elsewhere
        return root(of, index, self.s.complex)

    def power(self, base, exponent):
        if mpmath.im(base) == 0 and mpmath.re(base) < 0 and exponent != mpmath.nint(exponent) and not self.anywhere:
            raise Elsewhere
        return mpmath.power(base, exponent)

    # by the logarithms that define them: on their cuts, mpmath takes other values

    def arsinh(self, z):
        return mpmath.log(z + mpmath.sqrt(z * z + 1))

    def arcosh(self, z):
        product = mpmath.sqrt(z - 1) * mpmath.sqrt(z + 1) if self.s.complex else self.root(z * z - 1, 2)
        return mpmath.log(z + product)

    def artanh(self, z):
        return mpmath.log((1 + z) / (1 - z)) / 2

    def unknown(self, name, impact, order, at):
        """An unknown function: a polynomial and an exponential; declared derivatives are its derivatives."""
        names = {meaning[1]: n for n, meaning in enumerate(self.s.functions) if meaning[0] == "line"}
        if impact is None and name in names:
            # the function of which this one is a derivative, if no function is its own
            before = {g: f for f, g in self.s.derivatives.items()}
            first, met = names[name], set()
            while first in before and first not in met:
                met.add(first)
                first, order = before[first], order + 1
            if first in met:
                return self.draw("a function that is its own derivative") * mpmath.exp(at)
            name = self.s.functions[first][1]
        shape = [self.draw((name, impact, n)) for n in range(6)]
        total = shape[0] * mpmath.exp(shape[1] * at) * shape[1] ** order
        for n, coefficient in enumerate(shape[2:], 1):
            if n >= order:
                total += coefficient * mpmath.ff(n, order) * at ** (n - order)
        return total

    def partial(self, of, by):
        return self.draw("derivative of %s by %s" % (of, by))

    def slope(self, of, by, images):
        """Along one map: of what it says outright a difference in three times the digits."""
        if of not in images:
            return self.partial(of, by)
        here, digits = self.draw(by), mpmath.mp.dps

        def image(value):
            self.numbers[by] = value
            return images[of](self)

        with mpmath.workdps(3 * digits):
            step = mpmath.mpf(10) ** -digits
            difference = (image(here + step) - image(here - step)) / (2 * step)
        self.numbers[by] = here
        return difference

    def derivative(self, of, by):
        """Along the maps, by the chain rule where impacts lie between."""
        here = [found for found in self.maps.values() if found[1] and by in found[1]]
        if any(of in starts for _, starts, _ in here):
            return mpmath.mpf(of == by)
        # where both lead there, the statement knows by a symbol of its own that the derivative is not along what is said outright
        known = {tuple(self.s.symbols[n][0] for n in meaning[1:]) for _, meaning in self.s.symbols if meaning[0] == "partial"}
        here.sort(key=lambda found: (of in found[2]) == ((of, by) in known))
        for ends, _, images in here:
            if of in ends:
                return self.slope(of, by, images)
        ends, _, images = here[0]
        return mpmath.fsum(self.derivative(of, n) * self.slope(n, by, images) for n in ends)

    def matrix(self, name):
        first, second, images = self.maps[name]
        if second:
            return mpmath.matrix([[self.slope(of, by, images) for by in second] for of in first])
        product = self.matrix(first[0])
        for factor in first[1:]:
            product = product * self.matrix(factor)
        return product

    def invariant(self, kind, name):
        if not self.maps:
            return self.draw("%s(%s)" % (kind, name))
        matrix = self.matrix(name)
        return mpmath.det(matrix) if kind == "Det" else mpmath.fsum(matrix[n, n] for n in range(matrix.rows))


def check_translation(statement, readings):
    """Each given and each goal is what is printed, at random points."""
    compared = {}
    for label, definitions, formula in readings["formulas"]:
        definitions = {**readings["abbreviations"], **definitions}
        near, seeds = [], []
        for seed in range(80):
            try:
                near.append(formula(Values(statement, seed, definitions, readings["maps"])))
                seeds.append(seed)
            except (Elsewhere, ZeroDivisionError):
                continue
            if len(near) == 3:
                break
        wanted = [(n, term) for n, (given, _, term, _) in enumerate(statement.givens) if given == label]
        if label == "":
            wanted = [(-1 - n, term) for n, (_, term) in enumerate(statement.goals)]
        if label == "beside the claim":
            wanted = [(("beside", term), term) for term in statement.beside]
        # of what stands beside the claim, signs are read both ways
        found = not wanted or label == "beside the claim"

        def is_same(term):
            own = [Values(statement, seed) for seed in seeds]
            own = [statement.evaluate(term, values.symbol, values.value) for values in own]
            share = max(mpmath.mpf(10) ** -30, MARGIN * statement.apart)
            return near and all(abs(a - b) <= share * (1 + abs(a) + abs(b)) for a, b in zip(near, own))

        for number, term in wanted:
            compared.setdefault(number, False)
            if is_same(term):
                compared[number] = found = True
        # what is given twice is among the givens once, under the label that it has first
        found = found or (label != "" and any(is_same(term) for _, _, term, _ in statement.givens))
        require(found, "the formula (%s) is not what was checked" % (label or "the claim"))
    for term in sorted(set(statement.beside)):
        require(compared.pop(("beside", term), False), "what was taken as written beside the claim is printed nowhere")
    for number in [number for number in compared if isinstance(number, tuple)]:
        del compared[number]
    for number, found in compared.items():
        if number >= 0 and statement.givens[number][0].startswith("the domain of"):
            continue  # its own conditions stand beside those of its formula
        name = "the claim" if number < 0 else statement.givens[number][0]
        require(found, "what was checked as (%s) is printed nowhere" % name)
    return len(compared)


def check_domains(statement, readings):
    """Nothing is given as the domain of a formula but what the formula needs to have a value."""
    s = statement
    law_terms = [of for _, _, _, law in s.givens if law for _, of in law["conditions"]]
    terms = [term for _, _, term, _ in s.givens] + [term for _, term in s.goals] + law_terms + s.beside
    needed = set(s.domain(*terms))
    for inner in s.inside(*terms, *s.definitions.values()):
        node = s.nodes[inner]
        # a fractional exponent is read of a base that is not negative, among complex numbers any other of one that is not 0
        if node[0] == "realpower":
            needed.add((NONZERO if s.complex else NONNEGATIVE, node[1]))
            if s.nodes[node[1]] == ("number", Fraction(0)) and not s.complex:
                needed.add((POSITIVE, node[2]))
        elif node[0] == "root" and not s.complex:
            needed.add((NONNEGATIVE, node[2]))
    stated = {label for label, _, _ in readings["formulas"]}
    for label, holds, term, _ in s.givens:
        # beside a formula with conditions of its own, these stand under the same label
        if label.startswith("the domain of") and label not in stated:
            require((holds, term) in needed, "more is given as %s than it needs" % label)


# --- all of it -------------------------------------------------------------------------------------------------------


# --- letters that need not commute -----------------------------------------------------------------------------------


def words_product(*words):
    """The product of words: each the powers of what commutes, and what keeps its place, as [name, is transposed]."""
    powers, letters = {}, []
    for scalars, others in words:
        for name, power in scalars:
            powers[name] = powers.get(name, 0) + power
        letters.extend((name, bool(turned)) for name, turned in others)
    return tuple(sorted((name, power) for name, power in powers.items() if power)), tuple(letters)


def words_sum(terms):
    total = {}
    for coefficient, word in terms:
        total[word] = total.get(word, 0) + coefficient
    return {word: coefficient for word, coefficient in total.items() if coefficient}


def words_value(words, point):
    total = Fraction(0)
    for (scalars, letters), coefficient in words.items():
        for name, power in scalars:
            coefficient *= point[name] ** power
        for name, _ in letters:
            coefficient *= point[name]
        total += coefficient
    return total


def check_words(data):
    """Each claim is its line, a sum of multiples of what is given and of lines before; what is given holds of numbers."""

    def read(terms):
        return words_sum((Fraction(number), words_product((scalars, letters))) for number, scalars, letters in terms)

    def turned(words):
        return {(scalars, tuple((name, not is_turned) for name, is_turned in reversed(letters))): coefficient for (scalars, letters), coefficient in words.items()}

    claims, givens = [read(claim) for claim in data["claims"]], [read(given) for given in data["givens"]]
    every = [word for words in claims + givens for word in words]
    arrows = any("\\vec" in name or "overrightarrow" in name for _, letters in every for name, _ in letters)
    divided = {name for scalars, _ in every for name, power in scalars if power < 0}
    lines = []
    for number, line in enumerate(data["lines"]):
        terms = []
        for coefficient, front, kind, source, behind in line:
            require(not arrows or not (front[1] or behind[1]), "line %d multiplies by a word what has vectors" % number)
            new = {name for scalars, _ in (front, behind) for name, power in scalars if power < 0} - divided
            require(not new, "line %d divides by what nothing else does" % number)
            of = lines[source] if kind == "line" else givens[source]
            of = turned(of) if kind == "transposed" else of
            terms.extend((Fraction(coefficient) * own, words_product(front, word, behind)) for word, own in of.items())
        lines.append(words_sum(terms))
    require(claims and len(claims) == len(data["claim_lines"]), "there is not one line for each claim")
    for claim, line in zip(claims, data["claim_lines"]):
        require(lines[line] == claim, "a line is not the claim")
    point = {name: Fraction(value) for name, value in data["point"].items()}
    for given in givens:
        require(words_value(given, point) == 0, "what is given does not hold at the point")
    for claim in claims:
        words_value(claim, point)
    return "proved: what is claimed is a combination of what is given, in %d lines" % len(lines)


def check(data, readings=None):
    """Refuses what is not shown; else says in a sentence what is."""
    if "words" in data:
        return check_words(data["words"])
    mpmath.mp.dps = DIGITS
    sys.setrecursionlimit(20000)
    statement = Statement(data)
    said = ""
    if readings:
        said = "; %d formulas are as printed" % check_translation(statement, readings)
        check_domains(statement, readings)
    if data["verdict"] == "proved":
        proof = check_proof(statement.copy(data["proof"]), data["proof"])
        point = Point(statement.copy(data["point"]), data["point"])
        for term in proof.excluded:
            copied = {}
            for inner in proof.s.inside(term):
                node = proof.s.nodes[inner]
                copied[inner] = point.s.add(with_parts(node, [copied[part] for part in parts(node)]))
            require(point.holds(NONZERO, copied[term]), "the point lies in a set that the proof excludes")
        return "proved: every step follows, and the premises hold at the point" + said
    if data["verdict"] == "nowhere":
        check_contradiction(statement.copy(data["proof"]), data["proof"])
        premises = statement.copy(data["point"])
        premises.givens = [given for given in premises.givens if given[0] != "the domain of the claim"]
        Point(premises, data["point"])
        return "refuted: defined nowhere, while the premises hold at the point" + said
    point = Point(statement.copy(data["point"]), data["point"])
    require(point.fails(), "the claim holds at the point")
    return "refuted: the premises hold at the point, and the claim fails" + said


def answer(work):
    try:
        return "accepted: " + work()
    except Refused as refusal:
        return "refused: %s" % refusal
    except (KeyError, IndexError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError, MemoryError, OSError) as error:
        return "refused: %s: %s" % (type(error).__name__, error)


def checksum(lines):
    """FNV-1a of the lines, which tells of accidents, not of forgery."""
    total = 0xCBF29CE484222325
    for byte in lines.encode():
        total = (total ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return "%016x" % total


def main(data, readings, file, guard, sum_of_lines):
    """Checks that the file is whole, then what it says. Only where both hold does the program end with 0."""

    def work():
        with open(file, encoding="utf-8") as lines:
            before, _, last = lines.read().rpartition('if __name__ == "__main__": main(')
        require(checksum(before) == sum_of_lines and last.count("\n") <= 1, "this file is not as it was written")
        return check(data, readings)

    said = answer(work)
    print(said, flush=True)
    if not said.startswith("accepted"):
        sys.exit(1)
    atexit.unregister(guard)
