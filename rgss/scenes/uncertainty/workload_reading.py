"""Reader of the cases of a workload from its document model."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes.uncertainty.document import CaseEntry
from rgss.scenes.uncertainty.workload import Case, Workload

_POSITIVE = ("mass", "radius", "height", "friction")


def read_workload(entries: Sequence[CaseEntry], document: Document, findings: list[Finding]) -> Workload:
    """Read the workload of a study.

    Args:
        entries: The cases.
        document: The file, for positions, with ``workload``.
        findings: List to which findings are added.
    """
    seen: set[str] = set()
    for index, entry in enumerate(entries):
        if entry.case in seen:
            message = f"case {entry.case!r} is taken by an earlier one"
            findings.append(document.finding("workload.duplicate-case", message, ("workload", index, "case")))
        seen.add(entry.case)
        for key in _POSITIVE:
            value = getattr(entry, key)
            if value is not None and value <= 0.0:
                message = f"{key} must be greater than zero"
                findings.append(document.finding("workload.not-positive", message, ("workload", index, key)))
    return Workload(
        cases=tuple(
            Case(
                id=entry.case,
                replicates=entry.replicates,
                mass_kg=entry.mass,
                radius_m=entry.radius,
                height_m=entry.height,
                friction=entry.friction,
            )
            for entry in entries
        )
    )
