#!/usr/bin/env python3
"""Counts the rows of public documents that `PROGRAM audit` calls suspect, and how many of these are misprints.

Usage: suspects.py PROGRAM DIRECTORY

DIRECTORY holds copies of the repositories of suspects-documents.csv, each at OWNER+NAME, at the commit that the list
gives. Every document in it is audited: a file .tex, .md, .qmd, .Rmd or .ipynb of fewer than 150,000 characters with ten
equals signs and a display. A document that takes more than 90 s is skipped and named. A suspect row is looked up in
suspects.csv, which says whether it is a misprint, and why not; one that is not listed there is printed as new."""
import csv
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).parent
ENDINGS = {".tex", ".md", ".qmd", ".Rmd", ".ipynb"}
csv.field_size_limit(10**9)


def is_document(path):
    """Returns true if a file is a document of the measurement."""
    if path.suffix not in ENDINGS or not path.is_file():
        return False
    text = path.read_text(errors="replace")
    return len(text) < 150_000 and text.count("=") >= 10 and ("\\begin{" in text or "$$" in text)


def audit(program, path):
    """Returns the rows of a document, or None if it takes too long."""
    command = ["nice", "-n", "10", "timeout", "90", program, "audit", str(path), "--format", "csv"]
    run = subprocess.run(command, capture_output=True, text=True)
    return None if run.returncode == 124 else list(csv.DictReader(run.stdout.splitlines(keepends=True)))


def main(program, directory):
    with open(HERE / "suspects.csv", newline="", encoding="utf-8") as file:
        judged = {(row["repository"], row["path"], row["line"]): row["judged"] for row in csv.DictReader(file)}
    with open(HERE / "suspects-documents.csv", newline="", encoding="utf-8") as file:
        names = [row["repository"] for row in csv.DictReader(file)]
    roots = {name: Path(directory) / name.replace("/", "+") for name in names}
    documents = [(name, path) for name, root in roots.items() for path in sorted(root.rglob("*")) if is_document(path)]
    with ThreadPoolExecutor(2) as pool:
        audited = pool.map(lambda document: audit(program, document[1]), documents)
        verdicts, judgements, skipped = Counter(), Counter(), 0
        for (name, path), rows in zip(documents, audited):
            if rows is None:
                skipped += 1
                print("too slow:", path)
            for row in rows or []:
                verdicts[row["verdict"]] += 1
                if row["verdict"] == "suspect":
                    line = row["place"].rsplit(":", 1)[0]
                    judgement = judged.get((name, str(path.relative_to(roots[name])), line), "new")
                    judgements[judgement] += 1
                    print(f"{judgement}: {path}:{line}: {row['repair'].split(' ;; ')[0]}", flush=True)
    print(f"{len(documents) - skipped} documents, {skipped} too slow; {sum(verdicts.values())} rows: {dict(verdicts)}")
    print(f"suspects: {dict(judgements)}")


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) == 3 else sys.exit(__doc__)
