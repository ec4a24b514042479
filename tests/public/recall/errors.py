"""Makes errors in a side of a link: signs, factors, exponents, indices, dropped terms, swapped letters."""
from tex import ACCENTS, CLOSE, GREEK, OPEN


def zones(side):
    """Returns for each token whether it stands in a subscript, an exponent, a name with an accent, or in neither."""
    zone = [""] * len(side)
    for at, token in enumerate(side[:-1]):
        if token in ("_", "^") or token in ACCENTS:
            depth = 0
            for end in range(at + 1, len(side)):
                depth += (side[end] in OPEN) - (side[end] in CLOSE)
                zone[end] += token[-1]
                if depth <= 0:
                    break
    return zone


def terms(side):
    """Yields each term of each sum as (start, end), with its sign."""
    starts, found = [[0]], []
    for at, token in enumerate(side + [")"]):
        if token in OPEN:
            starts.append([at + 1])
        elif token in ("+", "-") and at > starts[-1][-1]:
            starts[-1].append(at)
        elif token in CLOSE and starts:
            cuts = starts.pop() + [at]
            if len(cuts) > 2:
                found += [(cuts[0], cuts[1] + (side[cuts[1]] == "+")), *zip(cuts[1:], cuts[2:])]
    return found


def edits(side, kind, both, rng):
    """Returns the errors of a kind that can be made in a side, each a list of (first token, last token, new text)."""
    zone, found = zones(side), []
    known = lambda token: token.isalpha() and token not in "deE" or token in GREEK
    letter = lambda at: not zone[at] and known(side[at])
    indices = sorted({index for other in both for mark, index in zip(other, other[1:]) if mark == "_" and index.isalnum()})
    letters = sorted({token for other in both for token in other if known(token)})
    for at, token in enumerate(side):
        before, after = side[at - 1] if at else "", side[at + 1] if at + 1 < len(side) else ""
        if kind == "sign" and token in ("+", "-") and "_" not in zone[at] and (zone[at] == "" or after not in ("}", "")):
            found.append([(at, at, "" if before in ("", *OPEN) else "-" if token == "+" else "+")])
        elif kind == "factor" and not zone[at]:
            if token.isdigit() and not before.isdigit() and before != "." and not after.isdigit() and after != ".":
                found.append([(at, at, str(int(token) + rng.choice([1, 2])))])
            elif letter(at) and not before.isdigit() and before in ("", "+", "-", *OPEN) and after not in ("(", "'"):
                found.append([(at, at, rng.choice("23") + " " + token)])
        elif kind == "exponent" and not zone[at]:
            if token == "^" and after.isdigit():
                found += [[(at + 1, at + 1, str(int(after) + 1))], [(at, at + 1, "")]]
            elif letter(at) and after not in ("^", "_", "'", "(", "") and before not in (r"\frac", "d"):
                found.append([(at, at, token + "^2")])
        elif kind == "index" and token == "_" and before not in (r"\sum", r"\int"):
            inside = at + 1 + (after in OPEN)
            if side[inside].isalnum():
                others = sorted({*indices} - {side[inside]}) or sorted({*"012"} - {side[inside]})
                found.append([(inside, inside, rng.choice(others))])
        elif kind == "letters" and letter(at) and before != "d":
            others = [k for k in range(at) if letter(k) and side[k] != token and side[k - 1:k] != ["d"]]
            if rng.random() < 0.5 and others:
                other = rng.choice(others)
                found.append([(other, other, token), (at, at, side[other])])
            elif set(letters) - {token}:
                found.append([(at, at, rng.choice(sorted(set(letters) - {token})))])
    if kind == "dropped":
        found = [[(start, end - 1, "")] for start, end in terms(side) if not zone[start] and end > start]
    rng.shuffle(found)
    return found
