"""Registry of the formats of the traceability report: a new one is a module and a line here."""

from __future__ import annotations

from rgss.errors import DefinitionError
from rgss.reports.trace.formats.csv_tables import CSV
from rgss.reports.trace.formats.excel import EXCEL
from rgss.reports.trace.formats.format import TraceFormat
from rgss.reports.trace.formats.json_file import JSON
from rgss.reports.trace.formats.markdown import MARKDOWN
from rgss.reports.trace.formats.page import HTML
from rgss.reports.trace.formats.text import TEXT

TRACE_FORMATS: tuple[TraceFormat, ...] = (TEXT, HTML, MARKDOWN, CSV, EXCEL, JSON)
"""All formats, in the order in which they are listed."""


def trace_format(name: str) -> TraceFormat:
    """The format with a name.

    Raises:
        DefinitionError: The name is unknown.
    """
    for one in TRACE_FORMATS:
        if one.name == name:
            return one
    raise DefinitionError(
        f"unknown format {name!r}", hint=f"choose one of {', '.join(one.name for one in TRACE_FORMATS)}"
    )
