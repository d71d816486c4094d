"""The YAML form of a study."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from rgss.documents import (
    DocumentModel,
    Identifier,
    Text,
)
from rgss.findings import shown
from rgss.scenes.uncertainty import CaseEntry, CorrelationEntry, DistributionEntry, QuantityName
from rgss.studies.assumptions_section import StudyAssumptionEntry
from rgss.studies.motion import ControlEntry, PhysicsEntry, TimingEntry
from rgss.studies.planning import PlanningEntry
from rgss.studies.promotion import Promotion
from rgss.studies.regression import RegressionEntry
from rgss.studies.trade_off import TradeOffEntry
from rgss.studies.until_section import UntilDecidedEntry

MOST_REPLICATES = 10_000
"""Trials of each variant that a study may have."""

_FIDELITIES = ("kinematic", "dynamic", "contact")


def _read_fidelity(value: Any) -> tuple[str, ...]:
    if value in _FIDELITIES:
        return (str(value),)
    if isinstance(value, list) and len(value) == 2 and value[0] == "kinematic" and value[1] in _FIDELITIES[1:]:
        return tuple(value)
    known = ", ".join(f"'{name}'" for name in _FIDELITIES)
    message = f"{shown(str(value))} is not one of {known}, nor [kinematic, contact]"
    raise PydanticCustomError("quantity", "{message}", {"message": message, "hint": "write 'contact'"})


FidelityField = Annotated[
    tuple[str, ...],
    PlainValidator(_read_fidelity),
    WithJsonSchema(
        {
            "anyOf": [
                {"enum": list(_FIDELITIES)},
                {
                    "type": "array",
                    "prefixItems": [{"const": "kinematic"}, {"enum": list(_FIDELITIES[1:])}],
                    "minItems": 2,
                },
            ],
            "description": "How much physics a trial has; of two, the first screens and the second decides.",
        }
    ),
]
"""One fidelity, or that which screens and that which decides."""


MoveName = Literal["planned", "straight", "joint"]


class StudyDocument(DocumentModel):
    """A study file; other files are named relative to the project."""

    study: Identifier
    requirements: Text = "requirements"
    design_space: Text
    catalogue: Text
    scene: Text
    task: Text | None = None
    seed: Annotated[int, Field(ge=0, le=2**31 - 1)]
    replicates: Annotated[int, Field(ge=1, le=MOST_REPLICATES)]
    fidelity: FidelityField = ("contact",)
    promotion: Promotion | None = None
    until_decided: UntilDecidedEntry | None = None
    planning: PlanningEntry
    moves: dict[Text, MoveName] = Field(default_factory=dict)
    timing: TimingEntry = TimingEntry()
    control: ControlEntry = ControlEntry()
    physics: PhysicsEntry
    nominal: bool = False
    uncertainty: dict[QuantityName, DistributionEntry] = Field(default_factory=dict)
    correlations: tuple[CorrelationEntry, ...] = ()
    workload: tuple[CaseEntry, ...] = ()
    trade_off: TradeOffEntry
    regression: RegressionEntry | None = None
    assumptions: tuple[StudyAssumptionEntry, ...] = ()
