"""Runs every proof script below a folder, each as if alone; says which refuse, and how many accept."""

import contextlib
import io
import pathlib
import runpy
import sys

accepted, refused = 0, []
for script in sorted(pathlib.Path(sys.argv[1]).rglob("*.py")):
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said):
            runpy.run_path(str(script), run_name="__main__")
        accepted += 1
    except SystemExit as end:
        if end.code:
            refused.append(f"{script}: {said.getvalue().strip()}")
        else:
            accepted += 1
print(*refused, f"{accepted} proofs and counterexamples accepted by Python", sep="\n")
sys.exit(1 if refused or not accepted else 0)
