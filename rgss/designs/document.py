"""Document model of a design space."""

from __future__ import annotations

from pydantic import Field

from rgss.designs.compatibility import Limit
from rgss.designs.fields import ConditionsField, ScalarField
from rgss.designs.parameters import ParameterKind
from rgss.designs.sampling import SamplingMethod
from rgss.designs.settable_quantities import SettableField
from rgss.documents import DocumentModel, Identifier, Text, UnitText


class ParameterModel(DocumentModel):
    """Design parameter: a quantity with a unit, a count, or the name of a component."""

    id: Identifier
    name: Identifier
    symbol: Text
    kind: ParameterKind = ParameterKind.QUANTITY
    unit: UnitText | None = None
    role: Identifier | None = None
    sets: SettableField | None = None
    description: Text
    assumption: Text | None = None


class LevelModel(DocumentModel):
    """Level of a factor."""

    id: Identifier
    sets: dict[Identifier, ScalarField]


class FactorModel(DocumentModel):
    """Factor: parameters that vary together over ``levels``, or one that varies in a ``range``."""

    id: Identifier
    name: Text
    levels: tuple[LevelModel, ...] | None = None
    parameter: Identifier | None = None
    range: tuple[ScalarField, ...] | None = None
    resolution: ScalarField | None = None


class SampleModel(DocumentModel):
    """Sample of a design space, instead of the full factorial."""

    method: SamplingMethod
    size: int = Field(ge=1, le=65_536)
    seed: int = Field(ge=0, le=2**31 - 1)


class RuleModel(DocumentModel):
    """Rule: ``exclude``; or ``require``, ``limit`` or ``constraint``, each with or without ``when``."""

    id: Identifier
    rationale: Text
    when: ConditionsField | None = None
    require: ConditionsField | None = None
    limit: Limit | None = None
    constraint: Text | None = None
    exclude: ConditionsField | None = None


class DesignSpaceModel(DocumentModel):
    """The file ``designs/grasping_system.yaml``."""

    parameters: tuple[ParameterModel, ...] = Field(min_length=1)
    constants: dict[Identifier, ScalarField] = Field(default_factory=dict)
    factors: tuple[FactorModel, ...] = ()
    sample: SampleModel | None = None
    rules: tuple[RuleModel, ...] = ()
