"""Section on screening of a study: the first fidelity, and the designs that go on from there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Annotated, Literal

from pydantic import Field
from pydantic.dataclasses import dataclass as document_dataclass

from rgss.documents import STRICT, Dimensionless, Document
from rgss.evidence import Fidelity
from rgss.findings import Finding


@document_dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Promotion:
    """Rule for the designs that are tried again at a higher fidelity.

    A design that provably misses a requirement is never among them, whatever the bounds; with
    neither of the two bounds every other design is.

    Attributes:
        requirements: The condition that always holds: every requirement may still be met.
        keep: Number of the others that go on, the best by their value; None for no such bound.
        within: Largest difference to the best value; None for no such bound.
    """

    requirements: Literal["possible"] | None = field(default=None, compare=False)
    keep: Annotated[int, Field(ge=1)] | None = None
    within: Dimensionless | None = None

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
        fidelity: Their fidelity.
        promotion: Rule for the designs that go on from them.
    """

    fidelity: Fidelity
    promotion: Promotion


def read_screening(
    fidelities: Sequence[str],
    promotion: Promotion | None,
    document: Document,
    findings: list[Finding],
    *,
    clock: str,
) -> Screening | None:
    """Screening as the study's file states it; None if all its designs are tried at one fidelity.

    Args:
        fidelities: One fidelity, or that which screens and that which decides.
        promotion: The section; None if there is none.
        document: The file.
        findings: Collects the problems.
        clock: Kind of the planning clock.
    """
    if len(fidelities) == 1:
        if promotion is not None:
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
    if clock != "counted":
        findings.append(
            document.finding(
                "study.promotion",
                "by a wall clock one fidelity's planning proves nothing about another's",
                ("planning", "clock"),
                hint="write 'clock: counted', or one fidelity",
            )
        )
    promotion = Promotion() if promotion is None else promotion
    within = promotion.within
    if within is not None and not 0.0 <= within <= 1.0:
        findings.append(
            document.finding(
                "study.promotion",
                "within is a share of the value, from 0 to 1",
                ("promotion", "within"),
                hint="write a number such as 0.05",
            )
        )
    return Screening(fidelity=Fidelity(fidelities[0]), promotion=promotion)
