"""``rgss init``: a new project to begin with."""

from __future__ import annotations

import argparse
from pathlib import Path

HELP = "make a new project: one scene, four designs, requirements that trace to them"
EXAMPLE = "rgss init my_project"
MORE_EXAMPLES = (("rgss init", "in the current folder, which keeps what it has"),)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path(), metavar="FOLDER", help="the new folder (default: this one)"
    )


def run(options: argparse.Namespace) -> int:
    """Write the files and name the next commands."""
    import shlex

    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json
    from rgss.errors import DefinitionError
    from rgss.studies import write_scaffold

    folder: Path = options.folder
    if options.project is not None:
        raise DefinitionError("--project names a project that is there", hint=f"rgss init {options.project}")
    files = write_scaffold(folder)
    if options.json:
        print_json({"folder": str(folder), "files": list(files)})
        return CLEAN
    print(f"A project of {len(files)} files is in {folder.resolve().name}/; its README.md says what each is for. Next:")
    print()
    if folder.resolve() != Path.cwd():
        print(f"  cd {shlex.quote(str(folder))}")
    print("  rgss check     # are the files sound?")
    print("  rgss sweep     # run the trials in simulation")
    print("  rgss trade     # which design is best, and why")
    return CLEAN
