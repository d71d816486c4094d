"""Traceability as JSON."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from rgss.reports.trace.formats.format import Selection, TraceFormat

if TYPE_CHECKING:
    from rgss.reports.trace.report import TraceReport
    from rgss.trace.views import Chain, Impact


def _report(report: TraceReport, selection: Selection) -> bytes:
    from rgss.reports.trace.json_document import report_to_json

    return _text(report_to_json(report, gaps_only=selection.gaps_only))


def _found(found: Chain | Impact, report: TraceReport) -> bytes:  # noqa: ARG001
    from rgss.reports.trace.json_document import chain_to_json, impact_to_json
    from rgss.trace.views import Chain

    return _text(chain_to_json(found) if isinstance(found, Chain) else impact_to_json(found))


def _text(document: Any) -> bytes:
    return (json.dumps(document, indent=2, allow_nan=False, ensure_ascii=False) + "\n").encode("utf-8")


JSON = TraceFormat(name="json", suffix=".json", title="a JSON file", write_report=_report, write_found=_found)
