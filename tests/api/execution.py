"""Runs a notebook and writes it with its outputs in one form: ``python execution.py NOTEBOOK SOCKETS``.

A process of its own, because the client of a kernel leaves sockets open; the kernel is reached through files.
"""

from __future__ import annotations

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from traitlets.config import Config

LONGEST_S = 600  # of one cell, after which it is given up; no result depends on it
METADATA = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


def main() -> None:
    """Run the notebook in its folder."""
    path, sockets = Path(sys.argv[1]), Path(sys.argv[2])
    read = nbformat.read(path, as_version=4)
    reached = Config({"KernelManager": {"transport": "ipc", "ip": str(sockets / "s")}})
    resources = {"metadata": {"path": str(path.parent)}}
    NotebookClient(read, config=reached, kernel_name="python3", timeout=LONGEST_S, resources=resources).execute()
    read.metadata = nbformat.from_dict(METADATA)
    for cell in read.cells:
        cell.metadata = {}
    path.write_text(nbformat.writes(read) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
