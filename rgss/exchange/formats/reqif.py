"""Requirements and architecture as ReqIF, or as an archive of it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.exchange.formats.format import ExportFormat
from rgss.exchange.formats.requirement_counts import model_counts, requirements_content

if TYPE_CHECKING:
    from rgss.studies import Project


def _write(project: Project, path: Path, evidence: str) -> Mapping[str, int]:  # noqa: ARG001
    from rgss.documents import write_output
    from rgss.exchange.reqif import ARCHIVE_ENDING, archive_of, reqif_text

    text = reqif_text(requirements_content(project), title=f"Requirements of the study {project.study.id}")
    in_archive = path.suffix.lower() == ARCHIVE_ENDING
    write_output(path, archive_of(text, f"{path.stem}.reqif") if in_archive else text.encode("utf-8"))
    return model_counts(project)


REQIF = ExportFormat(name="reqif", write=_write)
