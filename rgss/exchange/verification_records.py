"""Verification records in exchange files: written and compared, not read, since 'rgss verify' makes them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from rgss.exchange.attributes import Attribute, Form
from rgss.exchange.content import Content
from rgss.exchange.files import problem
from rgss.findings import Severity
from rgss.measures import StaleCause, Verdict
from rgss.requirements import RecordedResult
from rgss.trace.evidence import RecordEvidence

RECORD_ATTRIBUTES: tuple[Attribute, ...] = (
    Attribute(
        name="verification_result",
        path=("verification_result",),
        form=Form.CHOICE,
        choices=tuple(result.value for result in RecordedResult),
    ),
    Attribute(
        name="verification_state",
        path=("verification_state",),
        form=Form.CHOICE,
        choices=("holds", Verdict.STALE.value),
    ),
    Attribute(name="verified_by", path=("verified_by",), form=Form.LINE),
    Attribute(name="verified_on", path=("verified_on",), form=Form.LINE),
    Attribute(name="verification_evidence", path=("verification_evidence",), form=Form.PROSE),
)
"""Attributes of a system requirement that its verification record gives."""

_STATED = ("verification_result", "verified_by", "verified_on")
"""The attributes that the record itself states; the others follow from the present files of the project."""


def record_cells(records: Mapping[str, RecordEvidence]) -> Mapping[str, Mapping[str, str]]:
    """The attributes that verification records give to requirements, as texts."""
    return {
        name: {
            "verification_result": found.record.result.value,
            "verification_state": Verdict.STALE.value if found.causes else "holds",
            "verified_by": found.record.by,
            "verified_on": found.record.date,
            "verification_evidence": "\n".join(evidence_lines(found)),
        }
        for name, found in records.items()
    }


def evidence_lines(found: RecordEvidence) -> Iterator[str]:
    """Basis of a verification record, line by line: its note, its files, and what has changed since."""
    if found.record.note:
        yield found.record.note
    for file, digest in sorted(found.record.files.items()):
        yield f"{file} (SHA-256 {digest}){': changed since' if file in found.changed else ''}"
    if StaleCause.REQUIREMENT in found.causes:
        yield "The requirement has changed since."


def with_records_compared(foreign: Content, own: Mapping[str, Mapping[str, str]]) -> Content:
    """Content of a file with a loss for each verification record that the project does not have as the file states it.

    Args:
        foreign: The file.
        own: The records of the project, from `record_cells`.
    """
    losses = []
    for name, cells in foreign.records.items():
        stated = [cells.get(key, "").strip() for key in _STATED]
        if any(stated) and stated != [own.get(name, {}).get(key, "") for key in _STATED]:
            said = ", ".join(filter(None, stated))
            message = f"the verification of {name} in the file ({said}) is not the project's record"
            hint = f"an import reads no records; 'rgss verify {name}' makes one"
            losses.append(problem(foreign.file, "record", message, hint=hint, severity=Severity.WARNING))
    return replace(foreign, losses=(*foreign.losses, *losses))
