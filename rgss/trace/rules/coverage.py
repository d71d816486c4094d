"""Rules of coverage: each need has a requirement, a measure and an element, and each of these has a need."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.requirements import LinkKind
from rgss.trace.model import MeasureKind, MeasureTrace, TraceModel
from rgss.trace.rules.rule import ModelRule, Violation


def _orphans(model: TraceModel) -> Iterator[Violation]:
    answering = _derived_from_needs(model)
    for requirement in model.requirements.system:
        if requirement.id not in answering:
            message = f"system requirement {requirement.id!r} derives from no stakeholder requirement"
            yield Violation(subject=requirement.id, message=message, hint="name its parent under 'derived_from'")


def _childless(model: TraceModel) -> Iterator[Violation]:
    for need in model.requirements.stakeholder:
        if not model.sources(need.id, LinkKind.DERIVE):
            message = f"no system requirement derives from stakeholder requirement {need.id!r}"
            yield Violation(subject=need.id, message=message, hint="name it under 'derived_from' of one that does")


def _unmeasured(model: TraceModel) -> Iterator[Violation]:
    effectiveness = {measure.id for measure in _of_kind(model, MeasureKind.MOE)}
    for need in model.requirements.stakeholder:
        if effectiveness.isdisjoint(model.sources(need.id, LinkKind.TRACE)):
            message = f"no measure of effectiveness traces to stakeholder requirement {need.id!r}"
            yield Violation(subject=need.id, message=message, hint="name it under 'traces' of one that does")


def _aimless(model: TraceModel) -> Iterator[Violation]:
    needs = {need.id for need in model.requirements.stakeholder}
    for measure in _of_kind(model, MeasureKind.MOE):
        if needs.isdisjoint(measure.traces):
            message = f"measure of effectiveness {measure.id!r} traces to no stakeholder requirement"
            yield Violation(subject=measure, message=message, hint="name one under 'traces'")


def _without_performance(model: TraceModel) -> Iterator[Violation]:
    contributed = {target for measure in model.measures for target in measure.contributes_to}
    for measure in _of_kind(model, MeasureKind.MOE):
        if measure.id not in contributed and not measure.observed:
            message = f"no other measure contributes to measure of effectiveness {measure.id!r}"
            yield Violation(subject=measure, message=message, hint="compute it from one, or from the trials themselves")


def _contributing_to_nothing(model: TraceModel) -> Iterator[Violation]:
    for measure in _of_kind(model, MeasureKind.MOP):
        if not measure.contributes_to:
            message = f"measure of performance {measure.id!r} contributes to no measure of effectiveness"
            yield Violation(subject=measure, message=message, hint="use it in one, or make it supplementary")


def _unallocated(model: TraceModel) -> Iterator[Violation]:
    for requirement in model.requirements.system:
        if not requirement.satisfied_by:
            message = f"system requirement {requirement.id!r} is satisfied by no block or behaviour"
            yield Violation(subject=requirement.id, message=message, hint="name one under 'satisfied_by'")


def _unallocated_behaviours(model: TraceModel) -> Iterator[Violation]:
    for behaviour in model.requirements.architecture.behaviours:
        if not behaviour.allocated_to:
            message = f"behaviour {behaviour.id!r} is allocated to no block"
            yield Violation(subject=behaviour.id, message=message, hint="name one under 'allocated_to'")


def _idle_elements(model: TraceModel) -> Iterator[Violation]:
    for element in model.requirements.architecture.elements:
        if not model.targets(element.id, LinkKind.SATISFY):
            yield Violation(subject=element.id, message=f"{element.id!r} satisfies no system requirement")


def _derived_from_needs(model: TraceModel) -> set[str]:
    """Everything that derives from a need over any number of steps, found from the needs downwards."""
    reached = {need.id for need in model.requirements.stakeholder}
    queue = list(reached)
    while queue:
        fresh = [source for source in model.sources(queue.pop(), LinkKind.DERIVE) if source not in reached]
        reached.update(fresh)
        queue.extend(fresh)
    return reached


def _of_kind(model: TraceModel, kind: MeasureKind) -> Iterator[MeasureTrace]:
    return (measure for measure in model.measures if measure.kind is kind)


RULES: tuple[ModelRule, ...] = (
    ModelRule(
        id="trace.orphan",
        severity=Severity.ERROR,
        explanation="A system requirement derives from a stakeholder requirement; otherwise no stakeholder needs it.",
        check=_orphans,
    ),
    ModelRule(
        id="trace.childless",
        severity=Severity.ERROR,
        explanation="A system requirement derives from each stakeholder requirement; otherwise it is not addressed.",
        check=_childless,
    ),
    ModelRule(
        id="trace.no-moe",
        severity=Severity.ERROR,
        explanation=(
            "A measure of effectiveness traces to each stakeholder requirement; otherwise the choice of a "
            "design ignores it."
        ),
        check=_unmeasured,
    ),
    ModelRule(
        id="trace.moe-without-need",
        of_elements=False,
        severity=Severity.ERROR,
        explanation=(
            "A measure of effectiveness traces to a stakeholder requirement; otherwise designs are "
            "compared by something that no stakeholder needs."
        ),
        check=_aimless,
    ),
    ModelRule(
        id="trace.moe-without-mop",
        of_elements=False,
        severity=Severity.ERROR,
        explanation=(
            "A measure of effectiveness is computed from measures of performance or of effectiveness, or observed "
            "in the trials themselves; otherwise it has no value."
        ),
        check=_without_performance,
    ),
    ModelRule(
        id="trace.mop-without-moe",
        of_elements=False,
        severity=Severity.WARNING,
        explanation=(
            "A measure of performance contributes to a measure of effectiveness; otherwise it has no effect on the "
            "decision."
        ),
        check=_contributing_to_nothing,
    ),
    ModelRule(
        id="trace.unallocated",
        severity=Severity.ERROR,
        explanation="A block or a behaviour satisfies each system requirement; otherwise nothing realises it.",
        check=_unallocated,
    ),
    ModelRule(
        id="trace.unallocated-behaviour",
        severity=Severity.WARNING,
        explanation="Each behaviour is allocated to a block; otherwise it is open which part performs it.",
        check=_unallocated_behaviours,
    ),
    ModelRule(
        id="trace.idle-element",
        severity=Severity.INFO,
        explanation="A block or a behaviour that satisfies no requirement is allowed, and listed.",
        check=_idle_elements,
    ),
)
