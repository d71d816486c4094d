"""Traceability as an HTML page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rgss.errors import DefinitionError
from rgss.reports.trace.formats.format import Selection, TraceFormat

if TYPE_CHECKING:
    from rgss.reports.trace.report import TraceReport
    from rgss.trace.views import Chain, Impact


def _report(report: TraceReport, selection: Selection) -> bytes:
    from rgss.reports.diagrams import diagrams_of, drawings_for_page, missing_diagrams
    from rgss.reports.trace.html import report_to_html

    drawings: list[dict[str, Any]] = []
    notice = ""
    if not selection.gaps_only:
        try:
            drawings = drawings_for_page(diagrams_of(report.model.requirements, report.definitions))
            notice = missing_diagrams(report.model.requirements)
        except DefinitionError as error:
            notice = f"The diagrams are left out: {error}."
    page = report_to_html(report, gaps_only=selection.gaps_only, drawings=drawings, drawings_notice=notice)
    return page.encode("utf-8", "replace")


def _found(found: Chain | Impact, report: TraceReport) -> bytes:
    from rgss.reports.trace.html import chain_to_html, impact_to_html
    from rgss.trace.views import Chain

    page = chain_to_html(found) if isinstance(found, Chain) else impact_to_html(found, report)
    return page.encode("utf-8")


HTML = TraceFormat(name="html", suffix=".html", title="an HTML page", write_report=_report, write_found=_found)
