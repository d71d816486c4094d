"""Tables of a report, a chain or an impact for the formats that consist of tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.reports.tables import Table
    from rgss.reports.trace.formats.format import Selection
    from rgss.reports.trace.report import TraceReport
    from rgss.trace.views import Chain, Impact


def selected_tables(report: TraceReport, selection: Selection, *, widest_grid: int) -> tuple[Table, ...]:
    """Tables of a report.

    Args:
        report: The report.
        selection: The part of it.
        widest_grid: Most columns of a matrix that is a grid, not a list of links.

    Raises:
        DefinitionError: There is no such table.
    """
    from rgss.reports.tables import chosen_table
    from rgss.reports.trace.tables import report_tables

    return chosen_table(report_tables(report, widest_grid=widest_grid, gaps_only=selection.gaps_only), selection.table)


def found_table(found: Chain | Impact) -> Table:
    """A chain or an impact as a table."""
    from rgss.reports.trace.tables import chain_table, impact_table
    from rgss.trace.views import Chain

    return chain_table(found) if isinstance(found, Chain) else impact_table(found)
