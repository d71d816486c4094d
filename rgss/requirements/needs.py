"""Stakeholder needs."""

from __future__ import annotations

from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, Text
from rgss.requirements.attributes import NeedKind, Priority, Status
from rgss.requirements.exemption import Exemption


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class StakeholderNeed:
    """A stakeholder requirement in ``stakeholder.yaml``."""

    id: Identifier
    kind: NeedKind
    parent: Identifier | None = None
    text: Text
    rationale: Text
    source: Text
    priority: Priority
    status: Status
    owner: Text
    exempt: tuple[Exemption, ...] = ()
