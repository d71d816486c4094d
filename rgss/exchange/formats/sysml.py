"""Requirements, measures and architecture as SysML v2."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.exchange.formats.format import ExportFormat
from rgss.exchange.formats.requirement_counts import model_counts

if TYPE_CHECKING:
    from rgss.studies import Project


def _write(project: Project, path: Path, evidence: str) -> Mapping[str, int]:  # noqa: ARG001
    from rgss.documents import write_output
    from rgss.exchange.sysml import sysml_text
    from rgss.trace.evidence import evidence_of_records

    records = evidence_of_records(project.requirements, project.folder)
    text = sysml_text(project.requirements, project.measures, title=project.study.id, records=records)
    write_output(path, text.encode("utf-8"))
    return model_counts(project)


SYSML = ExportFormat(name="sysml", write=_write)
