"""A traceability report, a chain or an impact in each format, as the content of files."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from rgss.errors import DefinitionError
from rgss.reports.diagrams import diagrams_of, drawings_for_page, missing_diagrams
from rgss.reports.table_files import to_csv, to_excel, to_markdown
from rgss.reports.tables import Table, chosen_table
from rgss.reports.trace.html import chain_to_html, impact_to_html, report_to_html
from rgss.reports.trace.json_document import chain_to_json, impact_to_json, report_to_json
from rgss.reports.trace.report import TraceReport
from rgss.reports.trace.tables import chain_table, impact_table, report_tables
from rgss.trace.views import Chain, Impact

WIDEST_GRIDS = {"md": 20, "csv": 300, "xlsx": 300}
"""A matrix with more columns is written as a list of links."""


def report_file(report: TraceReport, file_format: str, *, gaps_only: bool = False, table: str = "") -> bytes:
    """A report as the content of one file.

    Args:
        report: The report.
        file_format: ``html``, ``md``, ``csv``, ``xlsx`` or ``json``.
        gaps_only: Only what is open.
        table: Name of the only table; empty for all. A CSV file holds one.

    Raises:
        DefinitionError: There is no such table, or a package is not installed.
    """
    if file_format == "html":
        return _page(report, gaps_only=gaps_only)
    if file_format == "json":
        return as_json(report_to_json(report, gaps_only=gaps_only))
    tables = tables_of(report, file_format, gaps_only=gaps_only, table=table)
    return _tables_file(tables, file_format, title=report.title)


def tables_of(report: TraceReport, file_format: str, *, gaps_only: bool = False, table: str = "") -> tuple[Table, ...]:
    """The tables of a report as a format writes them.

    Args:
        report: The report.
        file_format: ``md``, ``csv`` or ``xlsx``.
        gaps_only: Only what is open.
        table: Name of the only table; empty for all.

    Raises:
        DefinitionError: There is no such table.
    """
    return chosen_table(report_tables(report, widest_grid=WIDEST_GRIDS[file_format], gaps_only=gaps_only), table)


def found_file(found: Chain | Impact, report: TraceReport, file_format: str) -> bytes:
    """A chain or an impact as the content of one file.

    Args:
        found: The chain or the impact.
        report: The report of the same project, for the texts.
        file_format: ``html``, ``md``, ``csv``, ``xlsx`` or ``json``.

    Raises:
        DefinitionError: A package is not installed.
    """
    if isinstance(found, Chain):
        if file_format == "html":
            return chain_to_html(found).encode("utf-8")
        if file_format == "json":
            return as_json(chain_to_json(found))
        return _tables_file([chain_table(found)], file_format, title=f"Chain of {found.id}")
    if file_format == "html":
        return impact_to_html(found, report).encode("utf-8")
    if file_format == "json":
        return as_json(impact_to_json(found))
    return _tables_file([impact_table(found)], file_format, title=f"What a change to {found.id} touches")


def as_json(document: Any) -> bytes:
    """Plain data as the text of a JSON file."""
    return (json.dumps(document, indent=2, allow_nan=False, ensure_ascii=False) + "\n").encode("utf-8")


def _page(report: TraceReport, *, gaps_only: bool) -> bytes:
    drawings: list[dict[str, Any]] = []
    notice = ""
    if not gaps_only:
        try:
            drawings = drawings_for_page(diagrams_of(report.model.requirements))
            notice = missing_diagrams(report.model.requirements)
        except DefinitionError as error:
            notice = f"The diagrams are left out: {error}."
    page = report_to_html(report, gaps_only=gaps_only, drawings=drawings, drawings_notice=notice)
    return page.encode("utf-8", "replace")


def _tables_file(tables: Sequence[Table], file_format: str, *, title: str) -> bytes:
    if file_format == "xlsx":
        return to_excel(tables)
    if file_format == "md":
        return to_markdown(tables, title=title).encode("utf-8")
    (table,) = tables
    # The mark tells spreadsheets that it is UTF-8.
    return to_csv(table).encode("utf-8-sig")
