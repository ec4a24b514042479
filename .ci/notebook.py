"""Executes every notebook of examples/ where it lies; skips with a word where nothing can execute it."""

import pathlib
import sys

try:
    import nbclient
    import nbformat
except ImportError as error:
    sys.exit(print(f"notebooks are not executed: {error}", file=sys.stderr))

for path in sorted(pathlib.Path("examples").glob("*.ipynb")):
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=600, resources={"metadata": {"path": path.parent}}).execute()
    print(f"{path}: {len(notebook.cells)} cells executed")
