"""``rgss import``: requirements from a file of another tool; shows the changes, and applies them on request."""

from __future__ import annotations

import argparse
import sys
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.import_names import add_names, import_names
from rgss.cli.options import STUDY_HELP

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from rgss.cli.import_names import ImportNames
    from rgss.exchange import Content, ElementChange, FileChange, Part
    from rgss.studies import Project

HELP = "show what a file of another tool would change in the requirements, and apply it on request"
EXAMPLE = "rgss import xlsx requirements.xlsx --apply"
MORE_EXAMPLES = (("rgss import csv requirements.csv", "show what would change, and change nothing"),)
UNDOES_IMPORTS = True
FORMATS = ("reqif", "csv", "xlsx")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument("format", choices=FORMATS, metavar="FORMAT", help=f"one of {', '.join(FORMATS)}")
    parser.add_argument("file", type=Path, metavar="FILE", help="the file to read")
    parser.add_argument("--apply", action="store_true", help="write the changes into the project's YAML files")
    parser.add_argument("--remove", action="store_true", help="with --apply: also remove what the file lacks")
    add_names(parser)
    parser.add_argument("--study", metavar="STUDY", help=STUDY_HELP)


def run(options: argparse.Namespace) -> int:
    """Report and, on request, apply; 1 if the project then differs from the file, or content of it is lost."""
    from rgss.errors import DefinitionError
    from rgss.exchange import has_journal, importing, undone
    from rgss.studies import find_project

    if options.remove and not options.apply:
        raise DefinitionError("--remove goes with --apply", hint="without --apply nothing is written")
    folder = find_project(options.project)
    # A comparison alone needs no lock, unless an interrupted import has to be undone.
    changes_files = options.apply or has_journal(folder)
    with importing(folder) if changes_files else nullcontext():
        restored = undone(folder) if changes_files else ()
        if restored:
            print(f"an import that was interrupted is undone in {', '.join(restored)}", file=sys.stderr)
        return _imported(folder, options)


def _imported(folder: Path, options: argparse.Namespace) -> int:
    from rgss.cli.import_report import print_notes, print_report, report_as_json
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import print_json
    from rgss.errors import DocumentError
    from rgss.exchange import (
        compare,
        content_of,
        contents_of,
        planned,
        record_cells,
        rehearsed,
        with_absent_links,
        with_measures_compared,
        with_records_compared,
        written,
    )
    from rgss.studies import FOLDERS, load_project
    from rgss.trace.evidence import evidence_of_records

    contents = contents_of(folder)
    project = load_project(folder, options.study)
    given = import_names(options)
    foreign = _read(project, options, given)
    own = content_of(project.requirements)
    if options.format == "reqif":
        foreign = with_absent_links(own, foreign, remove=options.remove)
        foreign = with_measures_compared(foreign, {one.id: one.definition for one in project.measures.measures})
        foreign = with_records_compared(foreign, record_cells(evidence_of_records(project.requirements, folder)))
    try:
        changes = compare(own, foreign, given.assumed)
    except DocumentError:
        if not options.json:
            print_notes(foreign)
        raise
    files: Sequence[FileChange] = planned(
        folder, project.requirements, changes, remove=options.remove, contents=contents
    )
    try:
        rehearsed(folder, files, lambda copy: _check(copy, options, changes, own), folders=FOLDERS)
    except DocumentError as error:
        if not options.json:
            print_report(changes, foreign)
        after = [replace(each, message=f"after the import: {each.message}") for each in error.findings]
        raise DocumentError(after) from error
    if options.apply:
        written(folder, files)
    if options.json:
        print_json(report_as_json(changes, foreign, files, applied=options.apply))
    else:
        print_report(changes, foreign)
        print(_outcome(changes, foreign, files, options))
    return CLEAN if _is_taken_over(changes, foreign, options) else FINDINGS


def _is_taken_over(changes: Sequence[ElementChange], foreign: Content, options: argparse.Namespace) -> bool:
    """True if the project states what the file states, and nothing of it is lost."""
    from rgss.exchange import ChangeKind

    taken = bool(foreign.rows or foreign.measures) and not foreign.losses
    done = options.apply and (options.remove or all(change.kind is not ChangeKind.REMOVED for change in changes))
    return taken and bool(done or not changes)


def _read(project: Project, options: argparse.Namespace, given: ImportNames) -> Content:
    """The file with the names and values of rgss.

    Raises:
        DefinitionError: It has none of the attributes that are mapped on the command line.
        DocumentError: It cannot be read.
    """
    from rgss.errors import DefinitionError
    from rgss.exchange import part_of, with_values_mapped

    known: Mapping[str, Part] = {element.id: part_of(element) for element in project.requirements.elements}
    names, part = given.names, given.assumed.part
    if options.format == "reqif":
        from rgss.exchange.reqif import read_reqif

        foreign = read_reqif(options.file, known=known, part=part, names=names)
    else:
        from rgss.exchange.tables import ForeignTable, read_csv, read_excel

        is_foreign = names.is_given or part is not None
        table = ForeignTable(names=names, part=part, known=known) if is_foreign else None
        foreign = (read_excel if options.format == "xlsx" else read_csv)(options.file, table)
    absent = names.unknown(foreign.names)
    if wrong := next((name for name in given.typed if name in absent), None):
        raise DefinitionError(f"--map: the file has no {wrong!r}", hint=f"it has {', '.join(map(repr, foreign.names))}")
    _require_relations(foreign, given)
    return with_values_mapped(foreign, names)


def _require_relations(foreign: Content, given: ImportNames) -> None:
    """Require that the file has the types of relations that are mapped on the command line.

    Raises:
        DefinitionError: It lacks one.
    """
    from rgss.errors import DefinitionError

    present = {" ".join(each.split()).casefold() for each in foreign.relations}
    for name in given.typed_relations:
        if " ".join(name.split()).casefold() not in present:
            known = ", ".join(map(repr, foreign.relations)) or "none"
            raise DefinitionError(f"--map-relation: the file has no relations {name!r}", hint=f"it has {known}")


def _check(copy: Path, options: argparse.Namespace, changes: Sequence[ElementChange], before: Content) -> None:
    """Load the changed project, and check that it has the changes.

    Raises:
        DocumentError: It cannot be loaded.
        DefinitionError: It differs from them.
    """
    from rgss.errors import DefinitionError
    from rgss.exchange import content_of, not_as_planned
    from rgss.studies import load_project

    study = None if options.study is None else str(options.study)
    after = content_of(load_project(copy, study).requirements)
    wrong = not_as_planned(changes, before, after, remove=options.remove)
    if wrong:
        raise DefinitionError(
            f"the change to {wrong[0]!r} cannot be written into its file in its present form",
            hint="edit the YAML by hand",
        )


def _outcome(
    changes: Sequence[ElementChange], foreign: Content, files: Sequence[FileChange], options: argparse.Namespace
) -> str:
    from rgss.exchange import ChangeKind

    if not changes:
        taken = foreign.rows or foreign.measures
        why = "the notes above say why" if foreign.notes else "it holds no element"
        return "No changes." if taken else f"Nothing of the file was imported: {why}."
    counts = {kind: sum(change.kind is kind for change in changes) for kind in ChangeKind}
    said = ", ".join(f"{count} {kind.value}" for kind, count in counts.items())
    gone = counts[ChangeKind.REMOVED]
    if not options.apply:
        written = "--apply writes it" + (f", and keeps what the file lacks without --remove: {gone}" if gone else "")
        return f"{said}; nothing is written ({written})."
    kept = f"; what the file lacks is kept: {gone} (--remove removes it)" if gone and not options.remove else ""
    names = [file.name for file in files if file.new is not None]
    removed = [file.name for file in files if file.new is None]
    into = [f"written into {', '.join(names)}"] if names else []
    into += [f"removed the empty {', '.join(removed)}"] if removed else []
    return f"{said}; {'; '.join(into) or 'nothing to write'}{kept}."
