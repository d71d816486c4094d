"""Traceability as text for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.reports.trace.formats.format import Selection, TraceFormat

if TYPE_CHECKING:
    from rgss.reports.trace.report import TraceReport
    from rgss.trace.views import Chain, Impact


def _report(report: TraceReport, selection: Selection) -> bytes:
    from rgss.reports.trace.terminal import report_lines

    return _text(report_lines(report, gaps_only=selection.gaps_only, table=selection.table))


def _found(found: Chain | Impact, report: TraceReport) -> bytes:  # noqa: ARG001
    from rgss.reports.trace.terminal import found_lines

    return _text(found_lines(found))


def _text(lines: list[str]) -> bytes:
    return ("\n".join(lines) + "\n").encode("utf-8")


TEXT = TraceFormat(
    name="text",
    suffix=".txt",
    title="a text file",
    write_report=_report,
    write_found=_found,
    # On a terminal, matrices are lists of links.
    widest_grid=1,
    is_for_terminals=True,
)
