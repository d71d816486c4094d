"""Evidence of verification records: what a person found, and whether it still holds."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from rgss.documents import chunks_of
from rgss.measures import StaleCause, Verdict
from rgss.requirements import RequirementSet, VerificationRecord
from rgss.trace.evidence.digest import verification_digest

LARGEST_FILE_BYTES = 256 * 1024 * 1024


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordEvidence:
    """The verification record of one requirement.

    Attributes:
        requirement: Its id.
        record: What was found, by whom and when.
        causes: Causes of staleness since; empty if there are none.
        changed: The files of the record that are another content now, or gone.
    """

    requirement: str
    record: VerificationRecord
    causes: tuple[StaleCause, ...] = ()
    changed: tuple[str, ...] = ()

    @property
    def verdict(self) -> Verdict:
        """Result of the verification; stale if the requirement or a file has changed since."""
        return Verdict.STALE if self.causes else Verdict(self.record.result.value)


def evidence_of_records(requirements: RequirementSet, project: Path) -> Mapping[str, RecordEvidence]:
    """The verification records of a project's requirements, each compared with what it is a record of.

    Args:
        requirements: The requirements with their records; a record of an id that is gone is left out.
        project: The project's folder, to which the files of the records are relative.

    Returns:
        The evidence by id of the requirement, in the order of the requirements.
    """
    found = {}
    for requirement in requirements.system:
        record = requirements.records.get(requirement.id)
        if record is None:
            continue
        changed = tuple(name for name, before in record.files.items() if _digest_now(project, name) != before)
        causes = [StaleCause.REQUIREMENT] if record.requirement != verification_digest(requirement) else []
        found[requirement.id] = RecordEvidence(
            requirement=requirement.id,
            record=record,
            causes=(*causes, StaleCause.FILES) if changed else tuple(causes),
            changed=changed,
        )
    return MappingProxyType(found)


def content_of_file(path: Path) -> str:
    """SHA-256 of a file's content.

    Raises:
        OSError: It cannot be read, is not a regular file, or is larger than is read.
    """
    content = hashlib.sha256()
    for chunk in chunks_of(path, largest=LARGEST_FILE_BYTES):
        content.update(chunk)
    return content.hexdigest()


def _digest_now(project: Path, name: str) -> str | None:
    try:
        return content_of_file(project / name)
    except (OSError, ValueError):
        return None
