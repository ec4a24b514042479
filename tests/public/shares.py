#!/usr/bin/env python3
"""Shares of verdicts that `PROGRAM audit` reaches on public documents with rows marked by hand.

Usage: shares.py PROGRAM DIRECTORY

DIRECTORY holds documents.csv (number, field, repository, commit, path), the documents at
NUMBER-OWNER+NAME/PATH, and rows.csv: rows that follow from what stands before them in their document.
A marked row is the `link`-th one of the program's rows whose place is in the lines `line` to `last`; a
chain that the program prints as one row stands for all its links. A document that the program does not
read, or not within a minute, has no rows, so its marked rows are not found."""
import csv
import re
import subprocess
import sys
import time
from collections import Counter, defaultdict
from pathlib import Path

VERDICTS = ["proved", "given", "undecided", "unread", "suspect", "not found"]


def read(path):
    """Returns the rows of a CSV file as dictionaries."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def audit(program, document):
    """Returns the program's rows of a document and the seconds it took."""
    start = time.monotonic()
    try:
        run = subprocess.run(["nice", "-n", "15", program, "audit", str(document), "--format", "csv"],
                             capture_output=True, text=True, timeout=60)
        rows = list(csv.DictReader(run.stdout.splitlines(keepends=True)))
    except subprocess.TimeoutExpired:
        rows = []
    return rows, time.monotonic() - start


def find(rows, mark):
    """Returns the row of the program that a marked row names, or None; rows of included files have no line here."""
    found = []
    for row in rows:
        place = re.fullmatch(r"(\d+):(\d+)", row["place"])
        if place and int(mark["line"]) <= int(place[1]) <= int(mark["last"]):
            found.append((int(place[1]), int(place[2]), len(found), row))
    found.sort(key=lambda entry: entry[:3])
    return found[min(int(mark["link"]), len(found)) - 1][3] if found else None


def line(name, counts, verdicts):
    """Returns a line of the table: counts and percentages of each verdict."""
    total = sum(counts.values())
    return f"{name:12} {total:5} " + " ".join(f"{counts[v]:5} {100 * counts[v] / max(total, 1):5.1f}%" for v in verdicts)


def main(program, directory):
    directory, marks = Path(directory), defaultdict(list)
    for mark in read(directory / "rows.csv"):
        marks[mark["number"]].append(mark)
    marked, by_kind, everything, slowest = Counter(), defaultdict(Counter), Counter(), (0.0, "")
    for entry in read(directory / "documents.csv"):
        folder = f"{entry['number']}-{entry['repository'].replace('/', '+')}"
        rows, seconds = audit(program, directory / folder / entry["path"])
        slowest = max(slowest, (seconds, entry["number"]))
        everything.update(row["verdict"] for row in rows)
        for mark in marks[entry["number"]]:
            verdict = (find(rows, mark) or {"verdict": "not found"})["verdict"]
            marked[verdict] += 1
            by_kind[mark["kind"]][verdict] += 1
    print(f"{'':12} {'rows':>5} " + " ".join(f"{v:>12}" for v in VERDICTS))
    print(line("marked", marked, VERDICTS))
    print(*(line(kind, by_kind[kind], VERDICTS) for kind in sorted(by_kind)), sep="\n")
    print(line("all rows", everything, VERDICTS[:-1]))
    print(f"rows not unread: {sum(everything.values()) - everything['unread']}")
    print(f"slowest document: {slowest[1]} with {slowest[0]:.1f} s")


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) == 3 else sys.exit(__doc__)
