"""A traceability report, a chain or an impact as the content of files, in any registered format."""

from __future__ import annotations

from collections.abc import Mapping

from rgss.reports.tables import Table
from rgss.reports.trace.formats import Selection, selected_tables, trace_format
from rgss.reports.trace.report import TraceReport
from rgss.trace.views import Chain, Impact


def tables_of(report: TraceReport, file_format: str, *, gaps_only: bool = False, table: str = "") -> tuple[Table, ...]:
    """Tables of a report for a format.

    Args:
        report: The report.
        file_format: Name of a registered format that consists of tables.
        gaps_only: True for gaps only.
        table: Name of the only table; empty for all.

    Raises:
        DefinitionError: The format or the table is unknown.
    """
    selection = Selection(gaps_only=gaps_only, table=table)
    return selected_tables(report, selection, widest_grid=trace_format(file_format).widest_grid)


def trace_files(
    report: TraceReport,
    found: Chain | Impact | None,
    file_format: str,
    *,
    gaps_only: bool = False,
    table: str = "",
) -> Mapping[str, bytes]:
    """The content of each file by its name in a folder.

    Args:
        report: The report of the project.
        found: The chain or the impact of an id; None for the report itself.
        file_format: Name of a registered format.
        gaps_only: True for gaps only.
        table: Name of the only table; empty for all.

    Raises:
        DefinitionError: The format or the table is unknown, or a package is not installed.
    """
    chosen = trace_format(file_format)
    if found is not None:
        return {f"{_stem(found)}{chosen.suffix}": chosen.write_found(found, report)}
    if chosen.tables_of_a_file == 1:
        tables = tables_of(report, file_format, gaps_only=gaps_only, table=table)
        parts = (Selection(gaps_only=gaps_only, table=one.name) for one in tables)
        return {f"{part.table}{chosen.suffix}": chosen.write_report(report, part) for part in parts}
    return {f"trace{chosen.suffix}": chosen.write_report(report, Selection(gaps_only=gaps_only, table=table))}


def _stem(found: Chain | Impact) -> str:
    safe = "".join(sign if sign.isalnum() or sign in "-_." else "_" for sign in found.id)[:80]
    return f"{type(found).__name__.lower()}-{safe}"
