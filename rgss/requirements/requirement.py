"""System requirements."""

from __future__ import annotations

from typing import Annotated

from pydantic import model_validator
from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, ReadFrom, Text
from rgss.requirements.attributes import (
    Priority,
    RequirementGroup,
    Status,
    VerificationMethod,
    VerificationPhase,
)
from rgss.requirements.criterion import Criterion, CriterionFile
from rgss.requirements.exemption import Exemption


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Requirement:
    """A system requirement in ``system.yaml``."""

    id: Identifier
    group: RequirementGroup
    parent: Identifier | None = None
    text: Text
    rationale: Text
    source: Text
    derived_from: tuple[Identifier, ...] = ()
    traces: tuple[Identifier, ...] = ()
    satisfied_by: tuple[Identifier, ...] = ()
    verification: VerificationMethod | None = None
    facility: Text | None = None
    phase: VerificationPhase | None = None
    criterion: Annotated[Criterion, ReadFrom(CriterionFile, CriterionFile.criterion)] | None = None
    criterion_exemption: Text | None = None
    success: Text | None = None
    priority: Priority
    status: Status
    owner: Text
    exempt: tuple[Exemption, ...] = ()

    @model_validator(mode="after")
    def _criterion_or_exemption(self) -> Requirement:
        if self.criterion is not None and self.criterion_exemption is not None:
            raise ValueError("a criterion and an exemption from it exclude each other")
        if self.criterion is not None and self.success is not None:
            raise ValueError("a criterion and a success criterion in words exclude each other")
        return self
