"""Runs every proof script below a folder, each in a process of its own; says which refuse, and how many accept.

A process begins with SymPy and mpmath imported, so that this costs no more than to run all in one.
"""

import concurrent.futures
import os
import pathlib
import runpy
import sys
import traceback

import mpmath  # noqa: F401
import sympy.polys.rings  # noqa: F401


def status(script):
    """Returns the exit status of a script and what it prints."""
    out, into = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(out)
        os.dup2(into, 1)
        os.dup2(into, 2)
        code = 0
        try:
            runpy.run_path(str(script), run_name="__main__")
        except SystemExit as end:
            code = end.code
        except BaseException:
            traceback.print_exc()
            code = 1
        # what a script registered for its end is run too
        import atexit

        atexit._run_exitfuncs()
        sys.stdout.flush()
        os._exit(code if isinstance(code, int) else 1)
    os.close(into)
    with os.fdopen(out, errors="replace") as said:
        text = said.read()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), text.strip()


def main():
    scripts = sorted(pathlib.Path(sys.argv[1]).rglob("*.py"))
    refused = []
    # a thread only waits for its child
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for script, (code, said) in zip(scripts, pool.map(status, scripts)):
            if code != 0:
                refused.append(f"{script}: {said}")
    print(*refused, f"{len(scripts) - len(refused)} proofs and counterexamples accepted by Python", sep="\n")
    sys.exit(1 if refused or len(refused) == len(scripts) else 0)


if __name__ == "__main__":
    main()
