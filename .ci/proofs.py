"""Checks all proof data below a folder; says which are refused, and how many are accepted.

Of the files `check.py` leaves at most one in fourteen out, or cannot tell.
"""

import concurrent.futures
import os
import pathlib
import subprocess
import sys

# one in eighteen, as measured in December 2026, and some room for a sheet of maps more
MOST_LEFT_OUT = 14
LEFT_OUT = (": left out: ", "too close to 0 to tell")


def said(checker, files):
    """The lines of the checker on files."""
    ran = subprocess.run([sys.executable, checker, *files], capture_output=True, text=True)
    lines = ran.stdout.splitlines()
    if len(lines) != len(files):
        lines.append(f"{checker}: {len(lines)} answers on {len(files)} files: {ran.stderr}")
    return lines


def main():
    folder = pathlib.Path(sys.argv[1])
    checker = next(folder.rglob("check.py"))
    files = sorted(path for path in folder.rglob("*.json") if path.name != "schema.json")
    parts = [files[n : n + 50] for n in range(0, len(files), 50)]
    # a thread only waits for its process
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        lines = [line for part in pool.map(lambda part: said(checker, part), parts) for line in part]
    others = [line for line in lines if ": accepted: " not in line]
    refused = [line for line in others if not any(words in line for words in LEFT_OUT)]
    left_out, accepted = len(others) - len(refused), len(lines) - len(others)
    print(*refused, f"{accepted} proofs and counterexamples accepted by Python, {left_out} left out", sep="\n")
    sys.exit(1 if refused or not accepted or left_out * MOST_LEFT_OUT > len(files) else 0)


if __name__ == "__main__":
    main()
