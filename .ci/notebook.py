"""Executes every notebook of examples/ where it lies; skips with a message where nothing can execute it.

A notebook is committed with its outputs. That it runs is checked here, not that its outputs are the same: times differ.
With `--write` the outputs are replaced.
"""

import pathlib
import sys

try:
    import nbclient
    import nbformat
except ImportError as error:
    sys.exit(print(f"notebooks are not executed: {error}", file=sys.stderr))

MOST_BYTES = 400_000

for path in sorted(pathlib.Path("examples").glob("*.ipynb")):
    notebook = nbformat.read(path, as_version=4)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    is_executed = all(cell.execution_count for cell in code)
    nbclient.NotebookClient(notebook, timeout=600, resources={"metadata": {"path": path.parent}}).execute()
    print(f"{path}: {len(notebook.cells)} cells executed")
    if "--write" in sys.argv[1:]:
        for cell in code:
            cell.metadata.pop("execution", None)  # when it was executed
        notebook.metadata["language_info"] = {"name": "python"}
        nbformat.write(notebook, path)
    elif not is_executed:
        sys.exit(f"{path} is committed without outputs; write them by: python .ci/notebook.py --write")
    if path.stat().st_size > MOST_BYTES:
        sys.exit(f"{path} has {path.stat().st_size} bytes, of which {MOST_BYTES} are allowed; show less")
