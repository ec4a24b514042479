"""Evaluates TeX formulas at points: the measurement's own reading, which shares nothing with the program.

Letters are real numbers of both signs, and `f(...)` in one reading a product, in another an unknown function of its
arguments; `a/bc` is (a/b)c or a/(bc). A sum or an integral is an unknown linear functional of its body.
"""
import hashlib, itertools, math, random, re

READINGS = list(itertools.product([False, True], repeat=2))  # letters before brackets are functions; a/bc is a/(bc)
DISPLAY = re.compile(r"\\begin\{((?:equation|align|alignat|gather|multline|eqnarray|displaymath|flalign)\*?)\}.*?"
                     r"\\end\{\1\}|\$\$.*?\$\$|\\\[.*?\\\]|```\{?math\}?.*?```", re.S)
TOKEN = re.compile(r"%[^\n]*|(?m:^ *:\w+:[^\n]*)|\$\$(?: *\([\w:-]*\))?|\\\\(?:\s*\[[^]]*m\])?|\\(?:begin|end)\{\w+\*?\}|\\(?:left|right)\."
                   r"|\\(?:label|tag)\{[^}]*\}|```(?:\{?math\}?)?|\\[a-zA-Z]+|\\.|\S", re.S)
SKIP = re.compile(r"(%.+|:.+:.*|\$\$.*|\\(begin|end)\{(equation|align|alignat|gather|multline|eqnarray|displaymath|flalign"
                  r"|split|aligned|gathered)\*?\}|\\(left|right)\.?|\\(label|tag)\{.*|```.*|\\[][,!:>; ]|[&~]|\\(displaystyle"
                  r"|limits|nonumber|notag|[bB]igg?[lr]?|quad|qquad))", re.S)
BREAKS = set(r"""= , ; < > \le \leq \ge \geq \approx \equiv \to \Rightarrow \implies \iff \Leftrightarrow \sim \in \propto \neq
\ne \simeq \rightarrow \text \mbox \quad \qquad \Longrightarrow \leqslant \geqslant \ll \gg \Longleftrightarrow""".split())
GREEK = {"\\" + name for name in """alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta kappa lambda mu nu xi rho
sigma tau phi varphi chi psi omega Gamma Delta Theta Lambda Xi Sigma Phi Psi Omega ell pi hbar
varOmega varPhi varTheta varPi varLambda varrho""".split()}
ALIASES = {r"\mathd": "d", r"\dif": "d", r"\mathe": "e", r"\dd": "d", r"\mathscr": r"\mathcal", r"\wh": r"\hat", r"\bb": r"\mathbb"}
FUNCTIONS = {"\\" + name: getattr(math, name, None) for name in "sin cos tan exp log sinh cosh tanh".split()}
FUNCTIONS |= {r"\ln": math.log, r"\arctan": math.atan, r"\cot": lambda x: 1 / math.tan(x), r"\sec": lambda x: 1 / math.cos(x)}
ACCENTS = set(r"\dot \ddot \hat \bar \tilde \mathcal \mathrm \widehat \widetilde \overline \operatorname \mathbb".split())
OPEN, CLOSE = ["(", "[", "{", r"\{"], [")", "]", "}", r"\}"]


class Unread(Exception):
    """What is not known here."""


class Token(str):
    """A token with its place in the document."""


def chains(text):
    """Yields each chain of the displays as a list of [relation, tokens of the side behind it]."""
    for display in DISPLAY.finditer(text):
        chain, depth, fresh = [["", []]], 0, False
        for match in TOKEN.finditer(text, *display.span()):
            token = Token(ALIASES.get(match[0], match[0]))
            token.start, token.end = match.span()
            if token.startswith("\\\\"):
                fresh |= depth == 0 and "multline" not in (display[1] or "")
                continue
            if token in BREAKS and depth == 0 and not (token[1:] in ("quad", "qquad") and (fresh or not chain[-1][1])):
                chain.append([token, []])
                fresh = False
            elif not SKIP.fullmatch(token):
                if fresh and token not in ("+", "-", r"\cdot", r"\times"):
                    yield chain
                    chain = [["", []]]
                fresh = False
                depth += (token in OPEN or token.startswith(r"\begin")) - (token in CLOSE or token.startswith(r"\end"))
                chain[-1][1].append(token)
        for side in chain:
            while side[1] and side[1][-1] == ".":
                side[1].pop()
        yield chain


class Reader:
    """Evaluates one side at a point; `names` are the letters that it has met."""

    def __init__(self, tokens, point, reading, definitions=(), bound=()):
        self.tokens, self.at, self.point, self.reading, self.names = tokens, 0, point, reading, set()
        self.definitions, self.bound = dict(definitions), dict(bound)

    def value(self):
        value = self.sum()
        if self.peek():
            raise Unread(self.peek())
        return value

    def inner(self, tokens, bound=(), without=None):
        definitions = {name: side for name, side in self.definitions.items() if name != without}
        reader = Reader(tokens, self.point, self.reading, definitions, {**self.bound, **dict(bound)})
        value = reader.value()
        self.names |= reader.names
        return value

    def peek(self, *wanted):
        token = self.tokens[self.at] if self.at < len(self.tokens) else ""
        return token in wanted if wanted else token

    def next(self):
        if not self.peek():
            raise Unread("end")
        self.at += 1
        return self.tokens[self.at - 1]

    def group(self):
        """Takes an argument: one token, or those between brackets."""
        token, depth, start = self.next(), 1, self.at
        if token not in OPEN:
            return [token]
        while depth:
            token = self.next()
            depth += (token in OPEN) - (token in CLOSE)
        return self.tokens[start:self.at - 1]

    def sum(self):
        value, sign = 0.0, 1
        while True:
            while self.peek("+", "-"):
                sign *= -1 if self.next() == "-" else 1
            value, sign = value + sign * self.product(), 1
            if not self.peek("+", "-"):
                return value

    def product(self):
        value = self.factor()
        while self.peek() and not self.peek("+", "-", *CLOSE):
            if self.peek("/"):
                self.next()
                below = self.factor()
                while self.reading[1] and (self.peek().isalpha() or self.peek() in GREEK):
                    below *= self.factor()
                value /= below
            else:
                self.at += self.peek(r"\cdot", r"\times", "*")
                value *= self.factor()
        return value

    def factor(self):
        value = self.base()
        while self.peek("^"):
            self.next()
            value = value ** self.inner(self.group())
            if isinstance(value, complex):
                raise ValueError("not real")
        return value

    def base(self):
        token = self.peek()
        if token in OPEN:
            return self.inner(self.group())
        if self.next().isdigit():
            while self.peek().isdigit() or self.peek(".") and self.tokens[self.at + 1:] and self.tokens[self.at + 1].isdigit():
                token += self.next()
            return float(token)
        if token in (r"\frac", r"\dfrac", r"\tfrac"):
            above, below = self.group(), self.group()
            derivative = above[:1] == below[:1] and above[:1] in (["d"], [r"\partial"], [r"\mathrm"])
            return self.letter("".join(above) + "/" + "".join(below)) if derivative else self.inner(above) / self.inner(below)
        if token == r"\sqrt":
            root = self.inner(self.group()) if self.peek("[") else 2
            return math.exp(math.log(self.inner(self.group())) / root)
        if token in FUNCTIONS:
            return self.function(FUNCTIONS[token])
        if token in (r"\sum", r"\int"):
            return self.functional(token)
        if token == "e" and self.peek("^"):
            return math.e
        if token == r"\pi" and not self.peek("_", "(", "^"):
            return math.pi
        if token in ACCENTS:
            return self.letter(token + " ".join(self.group()))
        if token.isascii() and token.isalpha() or token in GREEK:
            return self.letter(token)
        raise Unread(token)

    def function(self, call):
        power = 1
        if self.peek("^"):
            self.next()
            power = self.inner(self.group())
            if power < 0:
                raise Unread("inverse function")
        if self.peek() in OPEN:
            return call(self.inner(self.group())) ** power
        value = self.factor()
        while self.peek().isalnum() or self.peek() in GREEK:
            value *= self.factor()
        return call(value) ** power

    def functional(self, token):
        """Weighs the body of a sum or an integral, at three places of its variable, by what the limits decide."""
        limits = []
        while self.peek("_", "^"):
            limits.append(self.next() + "".join(self.group()))
        start, depth = self.at, 0
        while self.peek() and not (depth == 0 and (self.peek(*CLOSE) or self.peek("+", "-") and self.at > start)):
            depth += self.peek(*OPEN) - self.peek(*CLOSE)
            self.at += 1
        body, name = self.tokens[start:self.at], limits[0][1:2] if limits else ""
        if token == r"\int":
            places = [k for k, letter in enumerate(body[:-1]) if letter == "d"]
            if not places:
                raise Unread("integral")
            name, body = body[places[-1] + 1], body[:places[-1]] + body[places[-1] + 2:] or ["1"]
        key = token + " ".join(sorted(limits))
        self.names.add(key)
        return sum(noise(key, k) * self.inner(body, {name: noise(k)}) for k in range(3))

    def letter(self, name):
        places = []
        while self.peek("_", "^", "'"):
            mark, back = self.next(), self.at - 1
            inside = self.group() if mark != "'" else []
            if "".join(inside) in ("T", r"\top", r"\prime", r"\dagger", r"\intercal"):
                raise Unread("matrix")
            if mark == "^" and not ("".join(inside) in ("*", r"\star", r"\ast", "+", "-") or inside[:1] == ["("] and inside[-1:] == [")"]):
                self.at = back
                break
            places += [self.bound[token] for token in inside if token in self.bound]
            name += mark + "".join(inside)
        if not self.reading[0] and name[0] in "fgh" and self.peek("("):
            raise Unread("a function as a factor")
        if (self.reading[0] or name[:8] in (r"\mathbb ", r"\mathrm ", r"\operat")) and self.peek("(", "[", r"\{"):
            parts, depth = [[]], 0
            for token in self.group():
                depth += (token in OPEN) - (token in CLOSE)
                if depth == 0 and token in (",", "|", ";", r"\mid", r"\vert", ":"):
                    name += token
                    parts.append([])
                else:
                    parts[-1].append(token)
            places += [round(self.inner(part), 9) for part in parts]
        if name in self.bound:
            return self.bound[name]
        if name in self.definitions and not places:
            return self.inner(self.definitions[name], without=name)
        self.names.add(name)
        return noise(name, places, self.point)


def noise(*key):
    """Returns a number of either sign that the key alone decides."""
    draw = random.Random(hashlib.sha256(repr(key).encode()).digest())
    return draw.choice([-1, 1]) * draw.uniform(0.4, 2.2)


def holds(left, right, reading, definitions=()):
    """Whether both sides agree at five points; None where fewer than three of forty are finite or a side is not read."""
    found = 0
    for point in range(40):
        try:
            a, b = (Reader(side, point, reading, definitions).value() for side in (left, right))
        except (ValueError, ArithmeticError):
            continue
        except (Unread, RecursionError):
            return None
        if not abs(a - b) <= 1e-8 * max(abs(a), abs(b), 1e-4):
            return False
        found += 1
        if found == 5:
            return True
    return True if found >= 3 else None


def lone_letter(side):
    """Returns the name of the letter that a side consists of."""
    reader = Reader(side, 0, (True, False))
    try:
        value = reader.value()
    except (Unread, ArithmeticError, ValueError):
        return None
    return next((name for name in reader.names if len(reader.names) == 1 and value == noise(name, [], 0)), None)
