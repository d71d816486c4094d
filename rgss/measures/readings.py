"""Alternative interpretations of a measure's source, and the simulated counterpart of an equation measure."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from rgss.documents import LoadedDocument
from rgss.errors import DefinitionError
from rgss.findings import Finding
from rgss.measures.definitions import Alternative, EstimateRule, Measure, MeasureSet
from rgss.measures.dependencies import evaluation_order, transitive_use
from rgss.measures.document import AlternativeEntry, MeasureEntry, MeasuresDocument
from rgss.measures.expressions import Expression
from rgss.measures.parsing import parse_expression
from rgss.quantities import dimension

FindingsOf = Callable[[LoadedDocument[MeasuresDocument]], Sequence[Finding]]

_NOT_ASKED = "measures.contribution"
"""Rules that do not apply to alternatives, which may omit contributing measures."""


def with_readings(
    measures: MeasureSet, loaded: LoadedDocument[MeasuresDocument], findings_of: FindingsOf
) -> MeasureSet | list[Finding]:
    """Measures with their alternatives and simulated counterparts, or every problem of these.

    Args:
        measures: The consistent measures.
        loaded: The file's entries with their positions.
        findings_of: Function that finds the problems of definitions; each alternative is checked as if in the file.
    """
    findings: list[Finding] = []
    found: dict[str, Measure] = {}
    for index, entry in enumerate(loaded.value.measures):
        findings += _twin_findings(measures, loaded, index, entry)
        parsed = [_expression(entry, one) for one in entry.alternatives]
        findings += _alternative_findings(measures, loaded, index, parsed, findings_of)
        alternatives = tuple(
            Alternative(
                id=one.id,
                expression=expression,
                estimate=_estimate(measures, entry, one, expression),
                rationale=one.rationale,
            )
            for one, expression in zip(entry.alternatives, parsed, strict=True)
            if expression is not None
        )
        found[entry.id] = replace(
            measures.measure(entry.id), simulated_as=entry.simulated_as, alternatives=alternatives
        )
    if findings:
        return findings
    return replace(
        measures,
        measures=tuple(found[one.id] for one in measures.measures),
        evaluation_order=tuple(found[one.id] for one in measures.evaluation_order),
    )


def with_alternative(measures: MeasureSet, measure: str, alternative: str) -> MeasureSet:
    """Measures with an alternative of one of them; dependent measures follow.

    Raises:
        DefinitionError: The measure or alternative is unknown, or measures would depend on each other in a cycle.
    """
    read = measures.measure(measure)
    known = {one.id: one for one in read.alternatives}
    if alternative not in known:
        named = f"alternatives: {', '.join(known)}" if known else f"{measure} has no alternatives"
        raise DefinitionError(f"measure {measure!r} has no alternative {alternative!r}", hint=named)
    chosen = known[alternative]
    changed = replace(read, expression=chosen.expression, estimate=chosen.estimate)
    by_id = {one.id: changed if one.id == measure else one for one in measures.measures}
    names = {name: one.expression.names for name, one in by_id.items()}
    order, cycles = evaluation_order(
        {name: [other for other in used if other in by_id] for name, used in names.items()}
    )
    if cycles:
        raise DefinitionError(
            f"measures would depend on each other in a cycle: {' → '.join(cycles[0])}",
            hint="use one alternative at a time",
        )
    return replace(
        measures,
        measures=tuple(by_id.values()),
        evaluation_order=tuple(by_id[name] for name in order),
        used=transitive_use(names, order),
    )


def _expression(entry: MeasureEntry, alternative: AlternativeEntry) -> Expression | None:
    """Expression of an alternative, its own or the measure's; None if it is invalid, which has a finding."""
    parsed = parse_expression(alternative.expression or entry.expression)
    return parsed if isinstance(parsed, Expression) else None


def _estimate(
    measures: MeasureSet, entry: MeasureEntry, alternative: AlternativeEntry, expression: Expression | None
) -> EstimateRule | None:
    """Estimate of an alternative: its own, or that of the measure if its expression has symbols from trials."""
    if alternative.estimate is not None or alternative.expression is None:
        return alternative.estimate or entry.estimate
    if expression is None or entry.id in _observed(measures, entry.id, expression):
        return entry.estimate
    return None


def _observed(measures: MeasureSet, measure: str, expression: Expression) -> frozenset[str]:
    """Ids of the measures that vary from trial to trial with another expression of one, as far as symbols are known."""
    known = {one.id: one.expression.names for one in measures.measures} | {measure: expression.names}
    fixed = {one.id for one in measures.constants} | {one.id for one in measures.design_inputs}
    follows: set[str] = set()
    # A measure follows from the design if all of its symbols do; on a cycle none does.
    while found := {name for name, used in known.items() if name not in follows and {*used} <= fixed | follows}:
        follows |= found
    return frozenset(known) - follows


def _twin_findings(
    measures: MeasureSet, loaded: LoadedDocument[MeasuresDocument], index: int, entry: MeasureEntry
) -> Iterator[Finding]:
    twin = entry.simulated_as
    if twin is None:
        return
    location = ("measures", index, "simulated_as")
    known = {one.id: one for one in measures.measures}
    problem, hint = "", ""
    if twin not in known or twin == entry.id:
        problem, hint = f"{twin!r} is not another measure", "name a measure that is computed from trials"
    elif dimension(known[twin].unit) != dimension(entry.unit):
        problem = f"{twin!r} is measured in {known[twin].unit!r}, {entry.id!r} in {entry.unit!r}"
        hint = "name a measure of the same quantity"
    elif known[twin].estimate is None:
        problem = f"{twin!r} depends only on the design, not on simulation"
        hint = "name a measure that is computed from trials"
    elif known[twin].length is not None and known[twin].summary is None:
        problem = f"{twin!r} is a row"
    if problem:
        yield loaded.document.finding("measures.simulated-as", problem, location, hint=hint)


def _alternative_findings(
    measures: MeasureSet,
    loaded: LoadedDocument[MeasuresDocument],
    index: int,
    parsed: Sequence[Expression | None],
    findings_of: FindingsOf,
) -> Iterator[Finding]:
    entry = loaded.value.measures[index]
    seen: set[str] = set()
    for place, (alternative, expression) in enumerate(zip(entry.alternatives, parsed, strict=True)):
        location = ("measures", index, "alternatives", place)
        name = f"alternative {alternative.id!r} of {entry.id!r}"
        if alternative.id in seen:
            yield loaded.document.finding("measures.alternative", f"{name} is defined twice", (*location, "id"))
        seen.add(alternative.id)
        if alternative.expression is None and alternative.estimate is None:
            hint = "give it an 'expression', an 'estimate' or both"
            yield loaded.document.finding("measures.alternative", f"{name} changes nothing", location, hint=hint)
            continue
        key = "estimate" if alternative.expression is None else "expression"
        for problem in findings_of(_read_as(measures, loaded, index, alternative, expression)):
            if problem.rule != _NOT_ASKED:
                yield loaded.document.finding(problem.rule, f"{name}: {problem.message}", (*location, key))


def _read_as(
    measures: MeasureSet,
    loaded: LoadedDocument[MeasuresDocument],
    index: int,
    alternative: AlternativeEntry,
    expression: Expression | None,
) -> LoadedDocument[MeasuresDocument]:
    """Entries with the alternative in place of the measure's definition."""
    entry = loaded.value.measures[index]
    changes = {
        "expression": alternative.expression or entry.expression,
        "estimate": _estimate(measures, entry, alternative, expression),
    }
    entries = list(loaded.value.measures)
    entries[index] = entry.model_copy(update=changes)
    if expression is not None:
        # What depends on it may follow from the design too, and has nothing to estimate then.
        kept = {*_observed(measures, entry.id, expression), entry.id}
        entries = [one if one.id in kept else one.model_copy(update={"estimate": None}) for one in entries]
    return replace(loaded, value=loaded.value.model_copy(update={"measures": tuple(entries)}))
