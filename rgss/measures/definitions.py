"""Definitions in a measures file: constants, inputs, equations, assumptions and measures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Annotated

from pydantic import BeforeValidator, Field, WithJsonSchema

from rgss.currencies import CODES, currency_dimension
from rgss.documents import DocumentModel, Identifier, QuantityText, Text, UnitText, number_as_text
from rgss.errors import DefinitionError
from rgss.measures.estimators import Estimator, Population, Summary
from rgss.measures.expressions import Expression
from rgss.measures.ranges import Range
from rgss.quantities import dimension

_NEVER_NEGATIVE = tuple(((name, 1.0),) for name in ("time", "mass", *map(currency_dimension, CODES)))


class MeasureKind(str, Enum):
    """Kind of a measure: effectiveness (for stakeholders), performance (for engineers) or supplementary."""

    EFFECTIVENESS = "moe"
    PERFORMANCE = "mop"
    SUPPLEMENTARY = "supplementary"


class Direction(str, Enum):
    """Preferred direction of a measure."""

    HIGHER = "higher"
    LOWER = "lower"
    NONE = "none"


@dataclass(frozen=True, slots=True, kw_only=True)
class Constant:
    """Number that is the same for every design.

    Attributes:
        id: Its symbol.
        value: Its value in SI.
        unit: Its display unit.
        definition: Its definition.
        source: Its source; empty when it is an assumption.
    """

    id: str
    value: float
    unit: str
    definition: str
    source: str


class InputSymbol(DocumentModel):
    """Symbol with a value from a design, a component or a trial, in SI.

    With ``of_design`` trials compute it only from the design, independently of seed and draws, so that it is the same
    in all.
    """

    id: Identifier
    source: Identifier
    unit: UnitText
    length: Annotated[int, Field(ge=1, le=1000)] | None = None
    of_design: bool = False
    definition: Text

    @property
    def from_trial(self) -> bool:
        """True if it varies from trial to trial."""
        return self.source.startswith("trial.")

    @property
    def metric(self) -> str:
        """Name of its value in its source, such as ``path_length_m``."""
        return self.source.split(".", 1)[1]


class Assumption(DocumentModel):
    """Decision on a point that the sources leave open."""

    id: Identifier
    statement: Text
    rationale: Text
    concerns: tuple[Text, ...]


class Equation(DocumentModel):
    """Numbered relation realised by measures; its number is a text, since the number 4.10 would equal 4.1."""

    id: Text
    relation: Text
    note: Text | None = None


NumberOrQuantityText = Annotated[
    QuantityText,
    BeforeValidator(number_as_text),
    WithJsonSchema(
        {"type": ["string", "number"], "minLength": 1, "maxLength": 60, "description": "A quantity, or a pure number."}
    ),
]
"""A value such as ``"9.81 m/s^2"``; a pure number may be bare."""


class EstimateRule(DocumentModel):
    """Estimator of a measure, its population, and the bounds of the trial values."""

    statistic: Estimator
    over: Population
    least: NumberOrQuantityText | None = None
    most: NumberOrQuantityText | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternative:
    """Alternative interpretation of a measure's source.

    Attributes:
        id: Its name among the measure's alternatives.
        expression: The expression that replaces the measure's.
        estimate: Estimate from trial values; None if it depends only on the design.
        rationale: Reason for this interpretation of the source.
    """

    id: str
    expression: Expression
    estimate: EstimateRule | None
    rationale: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Measure:
    """Quantity by which designs are compared.

    Attributes:
        id: Its id, which is also its symbol in expressions.
        kind: Its kind.
        name: Its name.
        definition: Its definition.
        unit: Its unit.
        si_per_unit: Value of that unit in SI.
        expression: Its value from constants, inputs and other measures.
        equation: The equation that it realises; None if none is published.
        better: Preferred direction.
        traces: Stakeholder needs that it measures.
        contributes_to: Measures of effectiveness that it contributes to.
        estimate: Estimate from trial values; None if it depends only on the design.
        summary: Reduction of a row to one number; None for a single number.
        length: The number of its entries; None for a single number.
        simulated_as: The measure of the same quantity from simulation; None if there is none.
        alternatives: Alternative interpretations of its source.
        least: The least possible trial value, in its unit; None if not declared.
        most: The greatest possible trial value; None if not declared.
    """

    id: str
    kind: MeasureKind
    name: str
    definition: str
    unit: str
    si_per_unit: float
    expression: Expression
    equation: str | None
    better: Direction
    traces: tuple[str, ...]
    contributes_to: tuple[str, ...]
    estimate: EstimateRule | None
    summary: Summary | None
    length: int | None
    simulated_as: str | None = None
    alternatives: tuple[Alternative, ...] = ()
    least: float | None = None
    most: float | None = None

    @property
    def is_never_negative(self) -> bool:
        """True if its unit is one of time, mass or money, whose values are not negative."""
        return dimension(self.unit) in _NEVER_NEGATIVE

    @property
    def from_trials(self) -> bool:
        """True if it varies from trial to trial."""
        return self.estimate is not None


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasureSet:
    """Consistent set of all measures of a project.

    Attributes:
        constants: The constants, in the order of the file.
        inputs: The input symbols, in the order of the file.
        assumptions: The assumptions, in the order of the file.
        equations: The equations, in the order of the file.
        measures: The measures, in the order of the file.
        evaluation_order: The measures in topological order.
        used: For each measure, the measures, inputs and constants on which it depends, directly or not.
        metric_ranges: Ranges of metrics of trials, in SI; a metric that is absent may have any value.
        trial_inputs: The inputs from trials, each with its metric, in the order of the file.
        trial_ranges: The range of each of them, by its symbol, in SI.
        design_inputs: The other inputs, in the order of the file.
        trial_measures: The measures that vary from trial to trial, in topological order.
        design_measures: The other measures, in topological order.
        noisy: Ids of the measures whose estimates further trials may change: not those of ``of_design`` inputs alone.
    """

    constants: tuple[Constant, ...]
    inputs: tuple[InputSymbol, ...]
    assumptions: tuple[Assumption, ...]
    equations: tuple[Equation, ...]
    measures: tuple[Measure, ...]
    evaluation_order: tuple[Measure, ...]
    used: Mapping[str, frozenset[str]]
    metric_ranges: Mapping[str, Range] = field(default_factory=dict)
    trial_inputs: tuple[tuple[str, InputSymbol], ...] = field(init=False, repr=False, compare=False)
    trial_ranges: Mapping[str, Range] = field(init=False, repr=False, compare=False)
    design_inputs: tuple[InputSymbol, ...] = field(init=False, repr=False, compare=False)
    trial_measures: tuple[Measure, ...] = field(init=False, repr=False, compare=False)
    design_measures: tuple[Measure, ...] = field(init=False, repr=False, compare=False)
    noisy: frozenset[str] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Sort inputs and measures once: measures are evaluated for each trial of each design."""
        inputs = tuple((one.metric, one) for one in self.inputs if one.from_trial)
        varying = {symbol.id for _, symbol in inputs if not symbol.of_design}
        order = self.evaluation_order
        derived = {
            "trial_inputs": inputs,
            "trial_ranges": {
                symbol.id: replace(self.metric_ranges.get(metric, Range()), length=symbol.length)
                for metric, symbol in inputs
            },
            "design_inputs": tuple(symbol for symbol in self.inputs if not symbol.from_trial),
            "trial_measures": tuple(measure for measure in order if measure.from_trials),
            "design_measures": tuple(measure for measure in order if not measure.from_trials),
            "noisy": frozenset(
                one.id
                for one in order
                if one.estimate is not None
                and (one.estimate.statistic is not Estimator.MEAN or not varying.isdisjoint(self.used[one.id]))
            ),
        }
        for name, value in derived.items():
            object.__setattr__(self, name, value)

    def measure(self, id: str) -> Measure:  # noqa: A002 - the domain's word
        """Measure by id.

        Raises:
            DefinitionError: The id is unknown.
        """
        for measure in self.measures:
            if measure.id == id:
                return measure
        raise DefinitionError(
            f"no measure {id!r} is defined", hint=f"measures: {', '.join(measure.id for measure in self.measures)}"
        )

    def of_kind(self, kind: MeasureKind) -> tuple[Measure, ...]:
        """The measures of a kind, in the order of the file."""
        return tuple(measure for measure in self.measures if measure.kind is kind)

    def dependencies(self, id: str) -> tuple[str, ...]:  # noqa: A002 - the domain's word
        """Ids of all measures on which a measure depends, directly or not, in evaluation order.

        Valuing both a measure and one of its dependencies counts the same effect twice.

        Raises:
            DefinitionError: The measure is unknown.
        """
        used = self.used[self.measure(id).id]
        return tuple(other.id for other in self.evaluation_order if other.id in used)

    def sources(self, id: str) -> tuple[str, ...]:  # noqa: A002 - the domain's word
        """Sources on which a measure depends, directly or not, such as ``design.tool_speed``.

        Raises:
            DefinitionError: The measure is unknown.
        """
        used = self.used[self.measure(id).id]
        return tuple(symbol.source for symbol in self.inputs if symbol.id in used)

    def assumptions_of(self, id: str) -> tuple[Assumption, ...]:  # noqa: A002 - the domain's word
        """Assumptions on which a measure depends, directly or not.

        Raises:
            DefinitionError: The measure is unknown.
        """
        reached = {id, *self.used[self.measure(id).id]}
        equations = {measure.equation for measure in self.measures if measure.id in reached}
        return tuple(assumption for assumption in self.assumptions if (reached | equations) & {*assumption.concerns})
