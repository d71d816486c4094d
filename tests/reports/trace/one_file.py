"""The one file that a report, a chain or an impact is written into."""

from __future__ import annotations

from rgss.reports.trace.files import trace_files


def only_file(report, found, file_format, **options) -> bytes:
    """Content of the file; found is None for the report itself."""
    (content,) = trace_files(report, found, file_format, **options).values()
    return content
