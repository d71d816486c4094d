"""``rgss schema``: JSON Schemas of the YAML documents, for editors."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.studies import DocumentKind

from rgss.counted import counted

HELP = "write JSON Schemas of the YAML documents, for completion and checks in editors"
FITTED = False
EXAMPLE = "rgss schema --out schemas --headers"
MORE_EXAMPLES = (
    ("rgss schema", "list the kinds of documents"),
    ("rgss schema scene > scene.schema.json", "one schema"),
)
DOCUMENTS = (
    "stakeholder",
    "system",
    "architecture",
    "measures",
    "rules",
    "reviews",
    "verifications",
    "design-space",
    "catalogue",
    "scene",
    "robot",
    "calibration",
    "excitation",
    "gripper",
    "parallel-gripper",
    "vacuum-gripper",
    "linkage-gripper",
    "task",
    "study",
    "mapping",
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument(
        "document", nargs="?", choices=DOCUMENTS, metavar="DOCUMENT", help=f"one of {', '.join(DOCUMENTS)}"
    )
    parser.add_argument("--out", type=Path, metavar="FOLDER", help="write the schemas into this folder")
    parser.add_argument(
        "--headers",
        action="store_true",
        help="with --out: add the line that names its schema to the top of every document of the project",
    )


def run(options: argparse.Namespace) -> int:
    """Print one schema, write the schemas, or list the kinds of documents."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json, print_table
    from rgss.errors import DefinitionError

    if options.headers and (options.out is None or options.document is not None):
        raise DefinitionError("--headers needs --out and no DOCUMENT", hint="rgss schema --out schemas --headers")
    if options.project is not None and not options.headers:
        raise DefinitionError("--project goes with --headers", hint="omit it; schemas are alike in all projects")
    if options.out is not None:
        return _write(options)
    if options.document is not None:
        print_json(_kind(options.document).schema())
    elif options.json:
        print_json({"documents": [{"id": kind.id, "title": kind.title, "place": kind.place} for kind in _kinds()]})
    else:
        print_table(("document", "what it is", "where"), [(kind.id, kind.title, kind.place) for kind in _kinds()])
    return CLEAN


def _kinds() -> tuple[DocumentKind, ...]:
    """The documents of a project, and those that other verbs read beside it."""
    from rgss.exchange import MAPPING_KIND
    from rgss.studies import DOCUMENT_KINDS

    return (*DOCUMENT_KINDS, MAPPING_KIND)


def _kind(name: str) -> DocumentKind:
    return next(kind for kind in _kinds() if kind.id == name)


def _write(options: argparse.Namespace) -> int:
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json, shown_path
    from rgss.studies import find_project, write_headers, write_schemas

    project = find_project(options.project) if options.headers else None
    kinds = _kinds() if options.document is None else (_kind(options.document),)
    files = write_schemas(options.out, kinds)
    headed = () if project is None else write_headers(project.resolve(), options.out.resolve())
    if options.json:
        print_json({"schemas": [str(path) for path in files], "headed": [shown_path(path) for path in headed]})
        return CLEAN
    print(f"{counted(len(files), 'schema')} in {shown_path(options.out)}")
    if project is not None:
        if not headed:
            print("every document of the project names its schema already")
        else:
            said = "1 document has" if len(headed) == 1 else f"{len(headed)} documents have"
            print(f"{said} a new first line that names the schema")
    return CLEAN
