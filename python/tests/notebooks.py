"""Runs the notebooks and compares what they print with what is kept in them.

    python notebooks.py NOTEBOOK...

Pictures are drawn, and not compared. With BLESS=1, what they print and draw is kept in place of what was.
"""

import difflib
import os
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError


def printed(cell):
    """What a cell says on standard output, and what its last line comes to where that is no picture."""
    outputs = cell.get("outputs", [])
    values = (output["data"] for output in outputs if "data" in output)
    texts = (value["text/plain"] for value in values if not any(kind.startswith("image/") for kind in value))
    said = "".join(output["text"] for output in outputs if output.get("name") == "stdout")
    return "\n".join([said, *texts])


def run(path):
    """The notebook with what it prints now."""
    notebook = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        NotebookClient(notebook, timeout=600, resources={"metadata": {"path": folder}}).execute()
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)  # its times
    return notebook


def differences(kept, now):
    """Lines in which what is printed differs from what is kept."""
    for before, after in zip(kept.cells, now.cells):
        lines = (printed(cell).splitlines() for cell in (before, after))
        yield from difflib.unified_diff(*lines, f"kept in {before.id}", "printed now", lineterm="")


def main(paths):
    failed = False
    for path in map(Path, paths):
        try:
            now = run(path)
        except CellExecutionError as error:
            sys.exit(f"{path}: {error}")
        if os.environ.get("BLESS"):
            nbformat.write(now, path)
            continue
        found = list(differences(nbformat.read(path, as_version=4), now))
        failed |= bool(found)
        print(path, *(found or ["prints what is kept in it"]), sep="\n" if found else ": ")
    if failed:
        sys.exit("a notebook prints something else than it did; BLESS=1 keeps what it prints now")


if __name__ == "__main__":
    main(sys.argv[1:])
