"""Measures how many misprints `audit` finds in public documents, and how often its first repair is right.

A link is two sides of a chain with `=` between them that `tex.py` shows to be equal at every point tried, by itself or
with letters that the document defines before it put in. `recall.py --draw SEED` draws links over all documents and
writes file, line, link (the number of its `=` on the line), kind of error and seed to `links.csv`. `recall.py` makes the
error of each link, shows that it falsifies the link, runs the program (PROGRAM) on the original and on the changed
document (all in DOCUMENTS, flat, as README.md says), prints the shares that were found and restored, and writes each case to `cases.csv` at once. Then it
makes every kind of error in the links that were proved, and in each link by itself, without its document.
"""
import csv, os, random, re, subprocess, sys
from collections import Counter
from errors import edits
from tex import READINGS, chains, holds, lone_letter

DOCS, PROGRAM = os.environ.get("DOCUMENTS", "documents"), os.environ.get("PROGRAM", "vibro-audit")
HERE = os.path.dirname(os.path.abspath(__file__))
KINDS = ["sign", "factor", "exponent", "index", "dropped", "letters"]
WANTED, PER_FILE, FLAGS = 100, 7, ("suspect", "refuted")
NOT_NUMBERS = re.compile("TDG|Topolog|Manifold|METTOP|Cubic")  # groups and spaces, whose letters are no numbers
OTHER = re.compile(r"\\(sum|int|mathbb|mathrm|operatorname|partial)|[A-Za-z]\s*'|\bE ")


def links(text):
    """Yields each link as (line, its number on the line, chain, position in it, what was defined before it)."""
    definitions, twice, count = {}, set(), Counter()
    for chain in chains(text):
        first = lone_letter(chain[0][1])
        for at, (relation, side) in enumerate(chain[1:]):
            if relation != "=" or not side or not chain[at][1]:
                continue
            line = text.count("\n", 0, side[0].start) + 1
            count[line] += 1
            yield line, count[line], chain, at, definitions
            if at == 0 and first:
                twice |= {first} & set(definitions)
                definitions = {name: body for name, body in {**definitions, first: side}.items() if name not in twice}


def readings(left, right, definitions):
    """Returns the readings in which a link holds and the definitions that it needs, nothing if it is one text."""
    if "".join(left) == "".join(right):
        return [], {}
    restated = any(lone_letter(side) or "".join(side).isdigit() for side in (left, right))
    for known in ({}, definitions) if definitions and not restated else ({},):
        found = [reading for reading in READINGS if holds(left, right, reading, known)]
        if found:
            break
    return found, known


def source(text, tokens):
    """Returns the text of a side in one line."""
    return " ".join(text[tokens[0].start:tokens[-1].end].split())


def break_link(text, link, kind, seed):
    """Returns the changed text, the number of the changed side, and the link as it now is; None if nothing falsifies it."""
    line, number, chain, at, definitions = link
    rng = random.Random(seed)
    pair = [chain[at][1], chain[at + 1][1]]
    true, known = readings(*pair, definitions)
    for side in rng.sample([0, 1], 2):
        for edit in edits(pair[side], kind, pair, rng)[:12]:
            changed = text
            for first, last, new in sorted(edit, reverse=True):
                start, end = pair[side][first].start, pair[side][last].end
                if "\\\\" in changed[start:end] or "\n" in changed[start:end]:
                    break
                space = " " if new[-1:].isalpha() and changed[end].isalpha() else ""
                changed = changed[:start] + new + space + changed[end:]
            else:
                now = next((item for item in links(changed) if item[:2] == (line, number)), None)
                if now and all(holds(now[2][at][1], now[2][at + 1][1], reading, known) is False for reading in true):
                    return changed, at + side, now
    return None


def audit(text, suffix):
    """Returns the program's rows on a document, each with its place as (line, column), and how the run ended."""
    path = os.path.join(DOCS, f".recall-{os.getpid()}{suffix}")
    with open(path, "w") as file:
        file.write(text)
    try:
        run = subprocess.run(["nice", "-n", "15", "timeout", "60", PROGRAM, "audit", path, "--format", "csv"], capture_output=True, text=True)
    finally:
        os.remove(path)
    rows = [dict(row, at=tuple(map(int, row["place"].split(":")[-2:]))) for row in csv.DictReader(run.stdout.splitlines()) if row["place"]]
    error = next((line.split(": ", 2)[-1] for line in run.stderr.splitlines() if line.startswith("error")), f"exit {run.returncode}")
    return sorted(rows, key=lambda row: row["at"]), error


def row_of(rows, text, chain, at):
    """Returns the row of the link between two sides of a chain: the last one that does not begin behind its relation."""
    end, start = chain[at][1][-1].end, chain[at + 1][1][0].start
    relation = max(text.rfind("=", end, start), end)
    place = (text.count("\n", 0, relation) + 1, relation - text.rfind("\n", 0, relation))
    return next((row for row in reversed(rows) if row["at"] <= place), None)


def restores(repair, chain, changed, definitions):
    """Whether a repair's sides are those of an original link that ends or begins with the changed side, and whether it is true."""
    parsed = next(chains(f"\\[{repair.strip('$ ')}\\]"))
    if len(parsed) != 2:
        return "unread", False
    sides = [side for _, side in parsed]
    same = lambda one, two: "".join(one) == "".join(two) or any(holds(one, two, reading) for reading in READINGS)
    pairs = [(chain[k][1], chain[k + 1][1]) for k in (changed - 1, changed) if 0 <= k < len(chain) - 1]
    return any(same(sides[0], left) and same(sides[1], right) for left, right in pairs), bool(readings(*sides, definitions)[0])


def draw(seed):
    """Draws true links over all documents and gives each a kind of error, the rarest that it can have."""
    rng, found, kinds, per_file = random.Random(seed), [], Counter(), Counter()
    for name in sorted(os.listdir(DOCS)):
        if NOT_NUMBERS.search(name) or name.startswith("."):
            continue
        text = open(os.path.join(DOCS, name)).read()
        found += [(name, link) for link in links(text) if readings(link[2][link[3]][1], link[2][link[3] + 1][1], link[4])[0]]
    rng.shuffle(found)
    drawn = []
    for name, link in found:
        if len(drawn) < WANTED and per_file[name] < PER_FILE:
            text = open(os.path.join(DOCS, name)).read()
            for kind in sorted(KINDS, key=lambda kind: (kinds[kind], rng.random())):
                chance = rng.randrange(10**6)
                if break_link(text, link, kind, chance):
                    drawn.append((name, link[0], link[1], kind, chance))
                    kinds[kind] += 1
                    per_file[name] += 1
                    break
    print(len(found), "links hold;", len(drawn), "are drawn from", len(per_file), "files:", dict(kinds))
    with open(os.path.join(HERE, "links.csv"), "w", newline="") as file:
        csv.writer(file).writerows([("file", "line", "link", "kind", "seed"), *sorted(drawn)])


def run_case(row, originals, alone=False):
    """Makes the error of a row of `links.csv`, in its document or in one that holds nothing but the link as the second
    row of a chain, runs the program before and after, and returns what it said; None if no such error can be made."""
    text, suffix, key = open(os.path.join(DOCS, row["file"])).read(), os.path.splitext(row["file"])[1], row["file"]
    link = next(item for item in links(text) if item[:2] == (int(row["line"]), int(row["link"])))
    if alone:
        text = "\\begin{align}\nQ &= %s \\\\\n&= %s\n\\end{align}\n" % tuple(source(text, link[2][link[3] + k][1]) for k in (0, 1))
        suffix, key, link = ".tex", text, ([*links(text), None, None])[1]
        if not link or not readings(link[2][1][1], link[2][2][1], {})[0]:
            return None
    before = originals[key] = originals.get(key) or audit(text, suffix)
    broken = break_link(text, link, row["kind"], int(row["seed"]))
    if not broken:
        return None
    changed, side, now = broken
    (rows, error), chain, at = audit(changed, suffix), link[2], link[3]
    is_link = lambda sides, k: 0 <= k < len(sides) - 1 and sides[k][1] and sides[k + 1][1]
    touched = [row_of(rows, changed, now[2], k) for k in (side - 1, side) if is_link(now[2], k)]
    flagged = next((hit for hit in touched if hit and hit["verdict"] in FLAGS), None)
    own_before, own = row_of(before[0], text, chain, at), flagged or row_of(rows, changed, now[2], at)
    already = {hit["at"][0] for hit in before[0] if hit["verdict"] in FLAGS}
    repair = (flagged["repair"] if flagged else "").split(" ;; ")[0]
    restored, true = restores(repair, chain, side, link[4]) if repair else ("", "")
    both = [source(text, chain[k][1]) for k in (at, at + 1)]
    shared = sum(row_of(before[0], text, chain, k) is own_before for k in range(len(chain) - 1) if chain[k + 1][0] == "=" and is_link(chain, k))
    return {
        "file": row["file"], "line": row["line"], "kind": row["kind"], "original": " = ".join(both),
        "changed": " = ".join(source(changed, now[2][k][1]) for k in (at, at + 1)),
        "verdict before": own_before["verdict"] if own_before else "none", "verdict after": own["verdict"] if own else "none",
        "repair": repair, "restored": restored, "repair true": true,
        "class": "definitions" if readings(chain[at][1], chain[at + 1][1], link[4])[1] else "other" if OTHER.search(" = ".join(both)) else "plain",
        "row": "several links" if shared > 1 else "an equation" if len(chain) == 2 else "a link",
        "elsewhere": sum(hit["verdict"] in FLAGS and hit not in touched and hit["at"][0] not in already for hit in rows),
        "reason before": own_before["reason"] if own_before else before[1], "reason": own["reason"] if own else error}


def table(cases, columns):
    """Prints the shares flagged and restored, of all cases and by the values of each column."""
    print(f"{'':28}cases  flagged   first repair restores / is true but another")
    groups = [("all", cases)] + [(f"{column}: {value}", [case for case in cases if case[column] == value])
                                 for column in columns for value in sorted({case[column] for case in cases})]
    for name, some in groups:
        hits = [case for case in some if case["verdict after"] in FLAGS]
        exact, other = sum(case["restored"] is True for case in hits), sum(case["restored"] is not True and case["repair true"] is True for case in hits)
        print(f"{name:28}{len(some):5} {len(hits):4} {100 * len(hits) / max(len(some), 1):3.0f}%  {exact:4} / {other}")


def cases_of(wanted, originals, into, alone=False):
    """Runs rows of `links.csv` and writes what came of each to a file as soon as it is known."""
    cases = []
    with open(os.path.join(HERE, into), "w", newline="") as file:
        for row in wanted:
            case = run_case(row, originals, alone)
            if case:
                rows = csv.DictWriter(file, case)
                if not cases:
                    rows.writeheader()
                rows.writerow(case)
                file.flush()
                cases.append(case)
    return cases


def measure():
    originals, listed = {}, list(csv.DictReader(open(os.path.join(HERE, "links.csv"))))
    each_kind = lambda rows: [{**row, "kind": kind} for row in rows for kind in KINDS]
    cases = cases_of(listed, originals, "cases.csv")
    table(cases, ["kind", "class", "row", "verdict before", "verdict after"])
    print("undecided with `fails at` after the error:", sum(case["verdict after"] == "undecided" and "fails at" in case["reason"] for case in cases))
    print("rows elsewhere that became suspect:", sum(case["elsewhere"] for case in cases))
    suspects = [(name, hit["place"]) for name, (rows, _) in originals.items() for hit in rows if hit["verdict"] in FLAGS]
    print("suspects in the", len(originals), "originals:", len(suspects), *suspects)
    proved = [row for row, case in zip(listed, cases) if case["verdict before"] == "proved"]
    print("\nEvery kind of error in the", len(proved), "links that were proved (proved.csv):", flush=True)
    table(cases_of(each_kind(proved), originals, "proved.csv"), ["kind", "row", "verdict after"])
    print("\nEvery kind of error in each link, alone in a document as the second row of a chain (alone.csv):", flush=True)
    alone = cases_of(each_kind(listed), {}, "alone.csv", alone=True)
    table(alone, ["class", "verdict before", "verdict after", "kind"])
    print("of these, proved before the error:")
    table([case for case in alone if case["verdict before"] == "proved"], ["kind"])


if __name__ == "__main__":
    draw(int(sys.argv[2])) if sys.argv[1:2] == ["--draw"] else measure()
