"""Where ``rgss trace`` writes, in which format, and what it refuses before it begins."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.safe_output import data_stream
from rgss.errors import DefinitionError

if TYPE_CHECKING:
    from rgss.reports.trace import TraceReport
    from rgss.trace.views import Chain, Impact

FORMATS = ("text", "html", "md", "csv", "xlsx", "json")
TABLES = ("coverage", "gaps", "stakeholder-moe", "system-stakeholder", "system-architecture", "verification")

_ENDINGS = {".txt": "text", ".html": "html", ".md": "md", ".csv": "csv", ".xlsx": "xlsx", ".json": "json"}
_SUFFIXES = {name: ending for ending, name in _ENDINGS.items()}


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceOrder:
    """What is wanted.

    Attributes:
        file_format: One of `FORMATS`.
        output: The file or the folder to write; None to print.
        into_folder: Whether the output is a folder.
        table: The only table; empty for all.
        gaps_only: Only what is open.
        diagrams: The folder for the diagrams; None without them.
        prints: Whether anything is printed but what was written.
    """

    file_format: str
    output: Path | None
    into_folder: bool
    table: str
    gaps_only: bool
    diagrams: Path | None
    prints: bool


def ordered(options: argparse.Namespace) -> TraceOrder:
    """What the options ask for.

    Raises:
        DefinitionError: They contradict each other, or a file cannot be written.
    """
    _refuse_contradictions(options)
    into_folder = options.output is not None and (options.output.is_dir() or not options.output.suffix)
    file_format = _format(options, into_folder=into_folder)
    if file_format == "xlsx" and options.output is None:
        raise DefinitionError("an Excel file cannot be printed", hint="name a file with -o trace.xlsx")
    if options.table is not None and file_format in ("html", "json"):
        raise DefinitionError(
            f"--table does not go with {file_format}, which holds everything", hint="use text, md, csv or xlsx"
        )
    if file_format == "csv" and not into_folder and options.id is None and options.table is None:
        raise DefinitionError(
            "a CSV file holds one table", hint=f"choose one with --table ({', '.join(TABLES)}) or name a folder with -o"
        )
    if options.output is not None and not into_folder:
        _check_file(options.output)
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
    """Print or write what was ordered; files are made as a whole, and only when all of them can be.

    Args:
        order: What is wanted.
        report: The report of the project.
        found: The chain or the impact of an id; None for the report itself.

    Raises:
        DefinitionError: A package is not installed.
        OSError: A file cannot be written.
    """
    if order.prints and order.file_format == "text":
        _print_text(order, report, found)
    elif order.prints:
        ((_, content),) = _contents(order, report, found).items()
        data_stream().write(content.decode("utf-8-sig"))
    elif order.output is not None:
        _write(order, _contents(order, report, found))
    if order.diagrams is not None:
        _write_diagrams(order.diagrams, report, quiet=order.prints)


def _refuse_contradictions(options: argparse.Namespace) -> None:
    if options.id is None and options.impact:
        raise DefinitionError("--impact needs an id", hint="rgss trace SYS-004 --impact")
    for name in ("gaps", "table", "diagrams"):
        if options.id is not None and getattr(options, name):
            raise DefinitionError(f"--{name} does not go with an id", hint="leave one of them away")
    if options.json and (options.output is not None or options.format not in (None, "json")):
        raise DefinitionError("--json prints JSON", hint="for a file use -o FILE.json, for another format --format")


def _format(options: argparse.Namespace, *, into_folder: bool) -> str:
    if options.json:
        return "json"
    if options.output is None:
        return options.format or "text"
    if into_folder:
        if options.format is None:
            raise DefinitionError(
                f"no format is given for the folder {str(options.output)!r}",
                hint=f"add --format with one of {', '.join(FORMATS)}, or name a file such as trace.html",
            )
        return str(options.format)
    by_ending = _ENDINGS.get(options.output.suffix.lower())
    if by_ending is None or options.format not in (None, by_ending):
        # So that nobody writes a report over a file that is something else.
        wanted = _SUFFIXES[options.format] if options.format else ", ".join(_ENDINGS)
        raise DefinitionError(f"{str(options.output)!r} does not end in {wanted}", hint="name the file so")
    return by_ending


def _check_file(path: Path) -> None:
    from rgss.documents import why_not_writable

    problem = why_not_writable(path)
    if problem:
        raise DefinitionError(f"{str(path)!r} cannot be written: {problem}", hint="name a file that can be")


def _contents(order: TraceOrder, report: TraceReport, found: Chain | Impact | None) -> Mapping[str, bytes]:
    """The content of each file by its name in a folder."""
    from rgss.reports.trace import found_file, report_file, tables_of

    suffix = _SUFFIXES[order.file_format]
    if order.file_format == "text":
        return {f"{_stem(found)}{suffix}": ("\n".join(_text_lines(order, report, found)) + "\n").encode("utf-8")}
    if found is not None:
        return {f"{_stem(found)}{suffix}": found_file(found, report, order.file_format)}
    if order.file_format == "csv":
        tables = tables_of(report, "csv", gaps_only=order.gaps_only, table=order.table)
        return {
            f"{table.name}{suffix}": report_file(report, "csv", gaps_only=order.gaps_only, table=table.name)
            for table in tables
        }
    content = report_file(report, order.file_format, gaps_only=order.gaps_only, table=order.table)
    return {f"trace{suffix}": content}


def _stem(found: Chain | Impact | None) -> str:
    if found is None:
        return "trace"
    safe = "".join(sign if sign.isalnum() or sign in "-_." else "_" for sign in found.id)[:80]
    return f"{type(found).__name__.lower()}-{safe}"


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
    files = write_diagrams(diagrams_of(requirements), folder)
    if not quiet:
        print(f"Wrote {len(files)} diagrams into {folder}")
        notice = missing_diagrams(requirements)
        if notice:
            print(notice)


def _print_text(order: TraceOrder, report: TraceReport, found: Chain | Impact | None) -> None:
    for line in _text_lines(order, report, found):
        print(line)


def _text_lines(order: TraceOrder, report: TraceReport, found: Chain | Impact | None) -> list[str]:
    from rgss.reports.trace import chain_lines, impact_lines, table_lines, terminal_tables
    from rgss.trace.views import Chain

    if isinstance(found, Chain):
        return chain_lines(found)
    if found is not None:
        return impact_lines(found)
    tables = terminal_tables(report, gaps_only=order.gaps_only, table=order.table)
    return [report.title, "", *table_lines(tables)]
