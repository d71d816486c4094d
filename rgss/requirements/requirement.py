"""System requirements."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.requirements.attributes import (
    Priority,
    RequirementGroup,
    Status,
    VerificationMethod,
    VerificationPhase,
)
from rgss.requirements.criterion import Criterion
from rgss.requirements.exemption import Exemption


@dataclass(frozen=True, slots=True, kw_only=True)
class Requirement:
    """One system requirement.

    Attributes:
        id: Its id, such as ``SYS-012``.
        group: The subsystem that it concerns.
        text: The sentence, in EARS form.
        rationale: Reason for it.
        source: Where it comes from.
        derived_from: Ids of the requirements that it derives from, its parents.
        satisfied_by: Ids of the blocks and behaviours that satisfy it, its allocation.
        verification: How it is verified; None while that is open.
        criterion: The bound that decides whether it is met; None if there is none.
        criterion_exemption: Why it is analysed without a criterion; empty unless it is.
        priority: Its priority.
        status: How far it has come.
        owner: The role that answers for it.
        parent: Id of the system requirement that contains it; None at the top.
        traces: Ids of needs and requirements that it goes back to without deriving from them.
        success: The success criterion in words, where no measure decides; empty where one does.
        facility: Where it is verified; empty while that is open.
        phase: When it is verified; None while that is open.
        exemptions: The rules that it may break, and why.
    """

    id: str
    group: RequirementGroup
    text: str
    rationale: str
    source: str
    derived_from: tuple[str, ...]
    satisfied_by: tuple[str, ...]
    verification: VerificationMethod | None
    criterion: Criterion | None
    criterion_exemption: str
    priority: Priority
    status: Status
    owner: str
    parent: str | None = None
    traces: tuple[str, ...] = ()
    success: str = ""
    facility: str = ""
    phase: VerificationPhase | None = None
    exemptions: tuple[Exemption, ...] = ()
