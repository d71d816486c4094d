"""Rules of verification: each requirement can be decided, and says the same in words and numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rgss.errors import QuantityError
from rgss.findings import Severity
from rgss.quantities import conversion_factor, same_dimension
from rgss.requirements import Criterion, Requirement, VerificationMethod
from rgss.trace.measure_trace import MeasureTrace
from rgss.trace.model import TraceModel
from rgss.trace.rule import Breach, Rule
from rgss.trace.text_quantities import TextQuantity, quantities_in


def _without_method(model: TraceModel) -> Iterator[Breach]:
    for requirement in model.requirements.system:
        if requirement.verification is None:
            methods = ", ".join(method.value for method in VerificationMethod)
            message = f"system requirement {requirement.id!r} has no verification method"
            yield Breach(subject=requirement.id, message=message, hint=f"give 'verification' one of {methods}")


def _without_criterion(model: TraceModel) -> Iterator[Breach]:
    for requirement in model.requirements.system:
        analysed = requirement.verification is VerificationMethod.ANALYSIS
        if analysed and requirement.criterion is None and not requirement.criterion_exemption:
            message = f"system requirement {requirement.id!r} is verified by analysis, but has no criterion"
            hint = "give it a 'criterion', or say under 'criterion_exemption' why it has none"
            yield Breach(subject=requirement.id, message=message, hint=hint, at=("verification",))


def _unknown_measures(model: TraceModel) -> Iterator[Breach]:
    known = [measure.id for measure in model.measures]
    for requirement, criterion in _criteria(model):
        if criterion.measure not in known:
            message = f"criterion of {requirement.id!r} bounds {criterion.measure!r}, which is no measure"
            hint = f"known measures: {', '.join(known)}"
            yield Breach(subject=requirement.id, message=message, hint=hint, at=("criterion", "measure"))


def _wrong_units(model: TraceModel) -> Iterator[Breach]:
    measures: dict[str, MeasureTrace] = {measure.id: measure for measure in reversed(model.measures)}
    for requirement, criterion in _criteria(model):
        measure = measures.get(criterion.measure)
        if measure is not None and not same_dimension(criterion.unit, measure.unit):
            message = (
                f"criterion of {requirement.id!r} has the unit {criterion.unit!r}, "
                f"but {measure.id!r} is measured in {measure.unit!r}"
            )
            hint = f"give the threshold in {measure.unit} or a unit that converts to it"
            yield Breach(subject=requirement.id, message=message, hint=hint, at=("criterion", "threshold"))


def _contradicting_numbers(model: TraceModel) -> Iterator[Breach]:
    for requirement, criterion in _criteria(model):
        stated = [
            quantity for quantity in quantities_in(requirement.text) if same_dimension(quantity.unit, criterion.unit)
        ]
        if stated and not any(_equal(quantity, criterion) for quantity in stated):
            texts = ", ".join(repr(quantity.text) for quantity in stated)
            message = f"text of {requirement.id!r} says {texts}, but its criterion says {str(criterion)!r}"
            yield Breach(subject=requirement.id, message=message, hint="make them agree", at=("text",))


def _criteria(model: TraceModel) -> Iterator[tuple[Requirement, Criterion]]:
    for requirement in model.requirements.system:
        if requirement.criterion is not None:
            yield requirement, requirement.criterion


def _equal(quantity: TextQuantity, criterion: Criterion) -> bool:
    try:
        value = quantity.value * conversion_factor(quantity.unit, criterion.unit)
    except QuantityError:
        # Units with an offset zero, such as degrees Celsius, cannot be compared by a factor.
        return False
    return math.isclose(value, criterion.threshold, rel_tol=1e-9, abs_tol=1e-12)


RULES: tuple[Rule, ...] = (
    Rule(
        id="trace.no-method",
        severity=Severity.ERROR,
        explanation="Each system requirement has a verification method; otherwise nobody can say whether it is met.",
        check=_without_method,
    ),
    Rule(
        id="trace.no-criterion",
        severity=Severity.ERROR,
        explanation=(
            "A requirement that is verified by analysis has a criterion, or a stated reason for having none; "
            "otherwise the analysis cannot end in a verdict."
        ),
        check=_without_criterion,
    ),
    Rule(
        id="trace.unknown-measure",
        severity=Severity.ERROR,
        explanation="A criterion bounds a measure that is defined.",
        check=_unknown_measures,
    ),
    Rule(
        id="trace.criterion-unit",
        severity=Severity.ERROR,
        explanation="A threshold has a unit of the dimension that its measure has.",
        check=_wrong_units,
    ),
    Rule(
        id="trace.contradicting-number",
        severity=Severity.ERROR,
        explanation="Where a requirement's text states a number of its criterion's dimension, it is the threshold.",
        check=_contradicting_numbers,
    ),
)
