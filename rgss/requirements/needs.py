"""Needs of the stakeholders."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.requirements.attributes import NeedKind, Priority, Status
from rgss.requirements.exemption import Exemption


@dataclass(frozen=True, slots=True, kw_only=True)
class StakeholderNeed:
    """One stakeholder requirement.

    Attributes:
        id: Its id, such as ``STK-006``.
        kind: The part of the system that it speaks of.
        text: The sentence, in EARS form.
        rationale: Reason for it.
        source: Where it comes from.
        priority: How much it matters.
        status: How far it has come.
        owner: The role that answers for it.
        parent: Id of the stakeholder requirement that contains it; None at the top.
        exemptions: The rules that it may break, and why.
    """

    id: str
    kind: NeedKind
    text: str
    rationale: str
    source: str
    priority: Priority
    status: Status
    owner: str
    parent: str | None = None
    exemptions: tuple[Exemption, ...] = ()
