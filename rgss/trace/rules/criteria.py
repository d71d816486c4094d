"""Rules of verification: each requirement is decidable, and its text agrees with its criterion."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rgss.currencies import without_currency
from rgss.findings import Severity
from rgss.quantities import dimension, possible_magnitudes, same_dimension
from rgss.requirements import Criterion, Requirement, VerificationMethod
from rgss.trace.model import MeasureTrace, TraceModel
from rgss.trace.rules.rule import ModelRule, Violation
from rgss.trace.sentences import TextQuantity, bound_of, is_in_trailing_condition, quantities_in, response_start


def _without_method(model: TraceModel) -> Iterator[Violation]:
    for requirement in model.requirements.system:
        if requirement.verification is None:
            methods = ", ".join(method.value for method in VerificationMethod)
            message = f"system requirement {requirement.id!r} has no verification method"
            yield Violation(subject=requirement.id, message=message, hint=f"give 'verification' one of {methods}")


def _without_criterion(model: TraceModel) -> Iterator[Violation]:
    for requirement in model.requirements.system:
        analysed = requirement.verification is VerificationMethod.ANALYSIS
        if analysed and requirement.criterion is None and not requirement.criterion_exemption:
            message = f"system requirement {requirement.id!r} is verified by analysis, but has no criterion"
            hint = "give it a 'criterion', or say under 'criterion_exemption' why it has none"
            yield Violation(subject=requirement.id, message=message, hint=hint, at=("verification",))


def _without_success(model: TraceModel) -> Iterator[Violation]:
    for requirement in model.requirements.system:
        decided = requirement.criterion is not None or requirement.success or requirement.criterion_exemption
        method = requirement.verification
        if not decided and method is not None and method is not VerificationMethod.ANALYSIS:
            message = (
                f"system requirement {requirement.id!r} is verified by {method.value}, but has no success criterion"
            )
            hint = "say under 'success' what is to be seen, or give it a 'criterion'"
            yield Violation(subject=requirement.id, message=message, hint=hint, at=("verification",))


def _unplanned(model: TraceModel) -> Iterator[Violation]:
    for requirement in model.requirements.system:
        missing = [
            name for name, value in (("facility", requirement.facility), ("phase", requirement.phase)) if not value
        ]
        if missing and requirement.verification is not None:
            message = f"the verification of {requirement.id!r} has no {' and no '.join(missing)}"
            hint = "the verification matrix says where and when"
            yield Violation(subject=requirement.id, message=message, hint=hint, at=("verification",))


def _unknown_measures(model: TraceModel) -> Iterator[Violation]:
    known = {measure.id: None for measure in model.measures}
    for requirement, criterion in _criteria(model):
        if criterion.measure not in known:
            message = f"criterion of {requirement.id!r} bounds {criterion.measure!r}, which is not a measure"
            hint = f"known measures: {', '.join(known)}"
            yield Violation(subject=requirement.id, message=message, hint=hint, at=("criterion", "measure"))


def _wrong_units(model: TraceModel) -> Iterator[Violation]:
    measures: dict[str, MeasureTrace] = {measure.id: measure for measure in reversed(model.measures)}
    for requirement, criterion in _criteria(model):
        measure = measures.get(criterion.measure)
        if measure is not None and not same_dimension(criterion.unit, measure.unit):
            message = (
                f"criterion of {requirement.id!r} has the unit {criterion.unit!r}, "
                f"but {measure.id!r} is measured in {measure.unit!r}"
            )
            hint = f"give the threshold in {measure.unit} or a unit that converts to it"
            yield Violation(subject=requirement.id, message=message, hint=hint, at=("criterion", "threshold"))


def _contradicting_numbers(model: TraceModel) -> Iterator[Violation]:
    for requirement, criterion in _criteria(model):
        stated = [quantity for quantity in quantities_in(requirement.text) if _is_comparable(quantity, criterion)]
        if stated and not any(_equal(quantity, criterion) for quantity in stated):
            texts = ", ".join(repr(quantity.text) for quantity in stated)
            message = f"text of {requirement.id!r} says {texts}, but its criterion says {str(criterion)!r}"
            yield Violation(subject=requirement.id, message=message, hint="make them agree", at=("text",))


def _contradicting_comparisons(model: TraceModel) -> Iterator[Violation]:
    for requirement, criterion in _criteria(model):
        is_lower_bound = criterion.comparison.is_lower_bound
        # A quantity in a condition, such as 'If the force exceeds 10 N', is not a required value.
        start = response_start(requirement.text)
        for quantity in quantities_in(requirement.text):
            in_condition = quantity.start < start or is_in_trailing_condition(requirement.text, quantity.start, start)
            if in_condition or not _is_comparable(quantity, criterion):
                continue
            bound = bound_of(requirement.text, quantity) if _equal(quantity, criterion) else None
            if bound is not None and bound.is_lower is not is_lower_bound:
                message = f"text of {requirement.id!r} says {bound.text!r}, but its criterion says {str(criterion)!r}"
                yield Violation(subject=requirement.id, message=message, hint="make them agree", at=("text",))
                break


def _criteria(model: TraceModel) -> Iterator[tuple[Requirement, Criterion]]:
    for requirement in model.requirements.system:
        if requirement.criterion is not None:
            yield requirement, requirement.criterion


def _is_comparable(quantity: TextQuantity, criterion: Criterion) -> bool:
    """True if a quantity has the dimension of the threshold; an amount of money in any currency."""
    return without_currency(dimension(quantity.unit)) == without_currency(dimension(criterion.unit))


def _equal(quantity: TextQuantity, criterion: Criterion) -> bool:
    """True if a quantity may be the threshold, in one of its readings."""
    return any(
        math.isclose(magnitude, criterion.threshold, rel_tol=1e-9, abs_tol=1e-12)
        for value in quantity.values
        for magnitude in possible_magnitudes(value, quantity.unit, criterion.unit)
    )


RULES: tuple[ModelRule, ...] = (
    ModelRule(
        id="trace.no-method",
        severity=Severity.ERROR,
        explanation="Each system requirement has a verification method; otherwise its verdict is undefined.",
        check=_without_method,
    ),
    ModelRule(
        id="trace.no-criterion",
        severity=Severity.ERROR,
        explanation=(
            "A requirement that is verified by analysis has a criterion, or a stated reason for having none; "
            "otherwise the analysis cannot end in a verdict."
        ),
        check=_without_criterion,
    ),
    ModelRule(
        id="trace.no-success",
        severity=Severity.ERROR,
        explanation=(
            "A requirement that is verified by test, inspection or demonstration says what success looks like, in "
            "words or by a criterion; otherwise whoever verifies it decides that too."
        ),
        check=_without_success,
    ),
    ModelRule(
        id="trace.unplanned",
        severity=Severity.INFO,
        explanation="A verification has a facility and a phase, as the verification matrix lists them.",
        check=_unplanned,
    ),
    ModelRule(
        id="trace.unknown-measure",
        fixed=True,
        severity=Severity.ERROR,
        explanation="A criterion bounds a measure that is defined.",
        check=_unknown_measures,
    ),
    ModelRule(
        id="trace.criterion-unit",
        fixed=True,
        severity=Severity.ERROR,
        explanation="A threshold has a unit of the dimension that its measure has.",
        check=_wrong_units,
    ),
    ModelRule(
        id="trace.contradicting-number",
        severity=Severity.ERROR,
        explanation=(
            "Where a requirement's text states a number of its criterion's dimension, it is the threshold; an amount "
            "in another currency is not. A number is read whole, and '1,500' or '1 500' in each of its meanings."
        ),
        check=_contradicting_numbers,
    ),
    ModelRule(
        id="trace.contradicting-comparison",
        severity=Severity.ERROR,
        explanation=(
            "Where a requirement's text bounds the threshold in words, such as 'at least', the criterion bounds it on "
            "the same side. Words whose side depends on the quantity, such as 'up to' and 'or better', are passed over."
        ),
        check=_contradicting_comparisons,
    ),
)
