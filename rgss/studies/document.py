"""The YAML form of a study."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from rgss.documents import (
    Dimensionless,
    DocumentModel,
    Hertz,
    Identifier,
    Metres,
    QuantityText,
    Radians,
    Seconds,
    Text,
)

MOST_REPLICATES = 10_000
"""Trials of each variant that a study may have."""


class PlanningEntry(DocumentModel):
    """How moves are planned."""

    clock: Literal["counted", "wall"] = "counted"
    charge_per_check: Seconds
    resolution: Radians
    simplification_checks: Annotated[int, Field(ge=0, le=1_000_000)]
    clearance: Metres


class PhysicsEntry(DocumentModel):
    """How physics is stepped."""

    rate: Hertz
    solver_iterations: Annotated[int, Field(ge=1, le=10_000)]


class ValueEntry(DocumentModel):
    """What a measure is worth: its weight, and the quantities worth 0 and 1."""

    measure: Identifier
    weight: Dimensionless
    worst: QuantityText | float | int
    best: QuantityText | float | int


class TradeOffEntry(DocumentModel):
    """How designs are compared."""

    values: Annotated[tuple[ValueEntry, ...], Field(min_length=1)]


class AssumptionEntry(DocumentModel):
    """What was assumed, and why."""

    about: Text
    rationale: Text


class StudyDocument(DocumentModel):
    """A study file; other files are named relative to the project."""

    study: Identifier
    design_space: Text
    catalogue: Text
    scene: Text
    seed: Annotated[int, Field(ge=0, le=2**31 - 1)]
    replicates: Annotated[int, Field(ge=1, le=MOST_REPLICATES)]
    fidelity: Literal["kinematic", "dynamic", "contact"] = "contact"
    planning: PlanningEntry
    physics: PhysicsEntry
    trade_off: TradeOffEntry
    assumptions: tuple[AssumptionEntry, ...] = ()
