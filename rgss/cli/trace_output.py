"""Output of ``rgss trace``: request by the options, and writing."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.safe_output import data_stream
from rgss.errors import DefinitionError
from rgss.reports.trace import TRACE_FORMATS, TraceFormat, trace_format

if TYPE_CHECKING:
    from rgss.reports.trace import TraceReport
    from rgss.trace.views import Chain, Impact

TABLES = ("coverage", "gaps", "stakeholder-moe", "system-stakeholder", "system-architecture", "verification")


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceOrder:
    """Requested output: files to write, or text to print.

    Attributes:
        file_format: The format.
        output: The file or the folder to write; None to print.
        into_folder: Whether the output is a folder.
        table: The only table to show; empty for all.
        gaps_only: True to show gaps only.
        diagrams: The folder for the diagrams; None without them.
        prints: True if more is printed than the names of written files.
    """

    file_format: TraceFormat
    output: Path | None
    into_folder: bool
    table: str
    gaps_only: bool
    diagrams: Path | None
    prints: bool


def ordered(options: argparse.Namespace) -> TraceOrder:
    """The output that the options request.

    Raises:
        DefinitionError: They exclude each other, or a file cannot be written.
    """
    from rgss.cli.output import require_writable

    _refuse_contradictions(options)
    into_folder = options.output is not None and (options.output.is_dir() or not options.output.suffix)
    file_format = _format(options, into_folder=into_folder)
    if not file_format.is_printable and options.output is None:
        raise DefinitionError(
            f"{file_format.title} cannot be printed", hint=f"name a file with -o trace{file_format.suffix}"
        )
    if options.table is not None and not file_format.has_tables:
        *others, last = (one.name for one in TRACE_FORMATS if one.has_tables)
        raise DefinitionError(
            f"--table does not go with {file_format.name}, which holds everything",
            hint=f"use {', '.join(others)} or {last}",
        )
    single = file_format.tables_of_a_file == 1
    if single and not into_folder and options.id is None and options.table is None:
        raise DefinitionError(
            f"{file_format.title} holds one table",
            hint=f"choose one with --table ({', '.join(TABLES)}) or name a folder with -o",
        )
    if options.output is not None and not into_folder:
        require_writable(options.output)
    for folder in (options.output if into_folder else None, options.diagrams):
        if folder is not None and folder.exists() and not folder.is_dir():
            raise DefinitionError(f"{str(folder)!r} is a file, not a folder", hint="name another folder")
    return TraceOrder(
        file_format=file_format,
        output=options.output,
        into_folder=into_folder,
        table=options.table or "",
        gaps_only=options.gaps,
        diagrams=options.diagrams,
        prints=options.output is None and (options.diagrams is None or options.format is not None or options.json),
    )


def deliver(order: TraceOrder, report: TraceReport, found: Chain | Impact | None) -> None:
    """Print or write the requested output; files are written atomically, and only if all of them can be.

    Args:
        order: The requested output.
        report: The report of the project.
        found: The chain or the impact of an id; None for the report itself.

    Raises:
        DefinitionError: A package is not installed.
        OSError: A file cannot be written.
    """
    if order.prints and order.file_format.is_for_terminals:
        from rgss.cli.output import print_lines
        from rgss.reports.trace import found_lines, report_lines

        print_lines(
            report_lines(report, gaps_only=order.gaps_only, table=order.table) if found is None else found_lines(found)
        )
    elif order.prints:
        ((_, content),) = _contents(order, report, found).items()
        # An escape in a JSON document keeps its meaning.
        stream = sys.stdout if order.file_format.name == "json" else data_stream()
        stream.write(content.decode("utf-8-sig"))
    elif order.output is not None:
        _write(order, _contents(order, report, found))
    if order.diagrams is not None:
        _write_diagrams(order.diagrams, report, quiet=order.prints)


def _refuse_contradictions(options: argparse.Namespace) -> None:
    if options.id is None and options.impact:
        raise DefinitionError("--impact needs an id", hint="rgss trace SYS-004 --impact")
    for name in ("gaps", "table", "diagrams"):
        if options.id is not None and getattr(options, name):
            raise DefinitionError(f"--{name} does not go with an id", hint="omit one of them")
    if options.json and (options.output is not None or options.format not in (None, "json")):
        raise DefinitionError("--json prints JSON", hint="for a file use -o FILE.json, for another format --format")


def _format(options: argparse.Namespace, *, into_folder: bool) -> TraceFormat:
    if options.json:
        return trace_format("json")
    if options.output is None:
        return TRACE_FORMATS[0] if options.format is None else trace_format(options.format)
    if into_folder:
        if options.format is None:
            names = ", ".join(one.name for one in TRACE_FORMATS)
            raise DefinitionError(
                f"no format is given for the folder {str(options.output)!r}",
                hint=f"add --format with one of {names}, or name a file such as trace.html",
            )
        return trace_format(options.format)
    suffix = options.output.suffix.lower()
    by_suffix = next((one for one in TRACE_FORMATS if one.suffix == suffix), None)
    if by_suffix is None or options.format not in (None, by_suffix.name):
        # A report must not replace a file that is not a report.
        wanted = ", ".join(one.suffix for one in TRACE_FORMATS if options.format in (None, one.name))
        raise DefinitionError(f"{str(options.output)!r} does not end in {wanted}", hint="use that suffix")
    return by_suffix


def _contents(order: TraceOrder, report: TraceReport, found: Chain | Impact | None) -> Mapping[str, bytes]:
    from rgss.reports.trace import trace_files

    return trace_files(report, found, order.file_format.name, gaps_only=order.gaps_only, table=order.table)


def _write(order: TraceOrder, contents: Mapping[str, bytes]) -> None:
    from rgss.cli.output import announce
    from rgss.documents import replaced_file, require_no_source

    output = order.output
    if output is None:
        return
    if order.into_folder:
        output.mkdir(parents=True, exist_ok=True)
    for name in contents if order.into_folder else ():
        require_no_source(output / name)
    for name, content in contents.items():
        path = output / name if order.into_folder else output
        with replaced_file(path) as part:
            part.write_bytes(content)
        announce(f"Wrote {path}", path)


def _write_diagrams(folder: Path, report: TraceReport, *, quiet: bool) -> None:
    from rgss.reports.diagrams import diagrams_of, missing_diagrams, write_diagrams

    requirements = report.model.requirements
    files = write_diagrams(diagrams_of(requirements, report.definitions), folder)
    if not quiet:
        print(f"Wrote {len(files)} diagrams into {folder}")
        notice = missing_diagrams(requirements)
        if notice:
            print(notice)
