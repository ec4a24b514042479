#!/usr/bin/env python3
"""Mutants of crates/kernel/src, drawn by seed, with tests/formulas/kernel.rs as the judge.

    tests/formulas/kernel/mutants.py COUNT [SEED]      in a copy of the tree; prints the survivors

A mutant changes one operator, constant or condition of one line outside tests and comments.
"""
import os, pathlib, random, re, signal, subprocess, sys
from subprocess import DEVNULL

COUNT, SEED = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
RULES = [
    (r" == ", " != "), (r" != ", " == "), (r" && ", " || "), (r" \|\| ", " && "), (r" > ", " >= "), (r" < ", " <= "),
    (r"if !", "if "), (r"\(!", "("), (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r" \+ 1\b", ""), (r" - 1\b", " + 1"),
    (r"% 2 == 1", "% 2 == 0"), (r"% 2 == 0", "% 2 == 1"), (r"\.all\(", ".any("), (r"\.any\(", ".all("),
    (r"^(\s*)self\.(defined|need|reals|real|real_arc|same|within|exists|check_\w+|is_in_domain)\((.*)\)\?;$", r"\1"),
    (r"\bPositive\b", "NonNegative"), (r"\bNonzero\b", "Zero"), (r"\.negated\(\)", ""), (r"\bSin\b", "Cos"), (r"-1\b", "1"),
    (r"^(\s*)return (refused|Err)\(.*\);$", r"\1"), (r"conditions\.extend\(.*\);", ""), (r"\.is_some\(\)", ".is_none()"),
]
files = sorted(pathlib.Path("crates/kernel/src").glob("*.rs"))
places = []
for path in files:
    for number, line in enumerate(path.read_text().split("\n")):
        if line.strip().startswith(("//", "use ", "#", "pub use", "///", "//!")):
            continue
        code = line.split("//")[0]
        for rule, (pattern, by) in enumerate(RULES):
            for found in re.finditer(pattern, code):
                places.append((path, number, rule, found.start()))
draw = random.Random(SEED)
draw.shuffle(places)
flags = ["--test", "formulas", "kernel", "-q"]
killed = survived = unbuilt = 0
for path, number, rule, start in places:
    if killed + survived == COUNT:
        break
    text = path.read_text()
    lines = text.split("\n")
    pattern, by = RULES[rule]
    before = lines[number]
    matched = [f for f in re.finditer(pattern, before) if f.start() == start]
    if not matched:
        continue
    lines[number] = before[:start] + matched[0].expand(by) + before[matched[0].end():]
    path.write_text("\n".join(lines))
    try:
        build = subprocess.run(["cargo", "test", *flags, "--no-run"], capture_output=True, text=True)
        if build.returncode != 0:
            unbuilt += 1
            continue
        try:
            judge = subprocess.Popen(["cargo", "test", *flags], stdout=DEVNULL, stderr=DEVNULL, start_new_session=True)
            passed = judge.wait(timeout=240) == 0
        except subprocess.TimeoutExpired:
            # a mutant may loop for ever, in a child of cargo
            os.killpg(judge.pid, signal.SIGKILL)
            passed = False
        if passed:
            survived += 1
            print(f"survived: {path}:{number + 1}\n  - {before.strip()}\n  + {lines[number].strip()}", flush=True)
        else:
            killed += 1
    finally:
        path.write_text(text)
print(f"{killed} killed, {survived} survived, {unbuilt} not built", flush=True)
