"""Requirements as a table: CSV, or an Excel file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.exchange.formats.format import ExportFormat
from rgss.exchange.formats.requirement_counts import requirement_counts, requirements_content

if TYPE_CHECKING:
    from rgss.studies import Project


def _write_csv(project: Project, path: Path, evidence: str) -> Mapping[str, int]:  # noqa: ARG001
    from rgss.documents import write_output
    from rgss.exchange.tables import csv_text

    # Excel recognises UTF-8 by its byte order mark.
    write_output(path, csv_text(requirements_content(project)).encode("utf-8-sig"))
    return requirement_counts(project)


def _write_excel(project: Project, path: Path, evidence: str) -> Mapping[str, int]:  # noqa: ARG001
    from rgss.documents import write_output
    from rgss.exchange.tables import excel_bytes

    write_output(path, excel_bytes(requirements_content(project)))
    return requirement_counts(project)


CSV = ExportFormat(name="csv", write=_write_csv)
EXCEL = ExportFormat(name="xlsx", write=_write_excel)
