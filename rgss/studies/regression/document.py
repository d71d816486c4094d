"""Document models of the section ``regression`` of a study."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema

from rgss.documents import Dimensionless, DocumentModel, Identifier, Text, number_as_text
from rgss.regression import MOST_SEEDS
from rgss.trials import METRICS, PHASE_METRICS

MarginText = Annotated[
    str,
    BeforeValidator(number_as_text),
    Field(min_length=1, max_length=60),
    WithJsonSchema({"type": ["string", "number"], "minLength": 1, "description": "A quantity, such as 0.2 s."}),
]


GuardableName = Annotated[
    Identifier,
    Field(
        json_schema_extra={
            "oneOf": [
                {"const": name, "description": f"{metric.meaning} [{metric.unit}]"}
                for name, metric in sorted({**PHASE_METRICS, **METRICS}.items())
                if metric.length is None or (name in PHASE_METRICS and metric.length_in_phase is None)
            ]
        }
    ),
]
"""A metric that is a single number, of the trial or of phases."""


class RegressionRunEntry(DocumentModel):
    """Trials that are watched."""

    id: Identifier
    fidelity: Literal["kinematic", "dynamic", "contact"]
    variants: Text
    replicates: Annotated[int, Field(ge=2, le=MOST_SEEDS)]
    batch: Annotated[int, Field(ge=1, le=MOST_SEEDS)] | None = None
    cap: Annotated[int, Field(ge=2, le=MOST_SEEDS)] | None = None


class RegressionMetricEntry(DocumentModel):
    """A metric that is guarded."""

    metric: GuardableName
    runs: Annotated[tuple[Identifier, ...], Field(min_length=1)] | None = None
    phases: Literal["all"] | Annotated[tuple[Identifier, ...], Field(min_length=1)] | None = None
    better: Literal["higher", "lower", "neither"]
    margin: MarginText
    at_least: MarginText | None = None


class RegressionEntry(DocumentModel):
    """The guard of a study's metrics."""

    error_rate: Dimensionless = 0.05
    runs: Annotated[tuple[RegressionRunEntry, ...], Field(min_length=1)]
    metrics: Annotated[tuple[RegressionMetricEntry, ...], Field(min_length=1)]
    decision: Identifier | None = None
