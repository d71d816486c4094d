"""Section on screening of a study: the first fidelity, and the designs that go on from there."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.documents import Document
from rgss.evidence import Fidelity
from rgss.findings import Finding
from rgss.studies.document import StudyDocument


@dataclass(frozen=True, slots=True, kw_only=True)
class Promotion:
    """Rule for the designs that are tried again at a higher fidelity.

    A design that provably misses a requirement is never among them, whatever the bounds; with
    neither of the two bounds every other design is.

    Attributes:
        keep: How many of the others go on, the best by their value; None for no such bound.
        within: How much less than the best value theirs may be; None for no such bound.
    """

    keep: int | None = None
    within: float | None = None

    def __str__(self) -> str:
        parts = ["requirements: possible"]
        if self.keep is not None:
            parts.append(f"keep: {self.keep}")
        if self.within is not None:
            parts.append(f"within: {self.within:g}")
        return ", ".join(parts)


@dataclass(frozen=True, slots=True, kw_only=True)
class Screening:
    """The trials that come before those which decide.

    Attributes:
        fidelity: How much physics they have.
        promotion: Which designs go on from them.
    """

    fidelity: Fidelity
    promotion: Promotion


def read_screening(entry: StudyDocument, document: Document, findings: list[Finding]) -> Screening | None:
    """Screening as the study's file states it; None if all its designs are tried at one fidelity.

    Args:
        entry: The content of the file.
        document: The file.
        findings: Takes what is wrong.
    """
    if len(entry.fidelity) == 1:
        if entry.promotion is not None:
            findings.append(
                document.finding(
                    "study.promotion",
                    "there is a promotion, and one fidelity alone",
                    ("promotion",),
                    hint="write 'fidelity: [kinematic, contact]', or remove 'promotion'",
                    at_key=True,
                )
            )
        return None
    if entry.planning.clock != "counted":
        findings.append(
            document.finding(
                "study.promotion",
                "by a wall clock one fidelity's planning proves nothing about another's",
                ("planning", "clock"),
                hint="write 'clock: counted', or one fidelity",
            )
        )
    within = None if entry.promotion is None else entry.promotion.within
    if within is not None and not 0.0 <= within <= 1.0:
        findings.append(
            document.finding(
                "study.promotion",
                "within is a share of the value, from 0 to 1",
                ("promotion", "within"),
                hint="write a number such as 0.05",
            )
        )
    return Screening(
        fidelity=Fidelity(entry.fidelity[0]),
        promotion=Promotion(keep=None if entry.promotion is None else entry.promotion.keep, within=within),
    )
