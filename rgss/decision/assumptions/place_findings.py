"""Findings on unknown names among a study's assumptions, alternatives and ranges of inputs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rgss.decision.what_if import assumed_numbers, nearest_names, suppose
from rgss.errors import RgssError
from rgss.findings import Finding, Severity
from rgss.studies import Project

_ALL = "all"


def assumption_findings(project: Project) -> tuple[Finding, ...]:
    """Findings on the alternatives of assumptions and the names of ranges, at their places in the file."""
    return (*_alternative_findings(project), *_range_findings(project))


def _alternative_findings(project: Project) -> Iterator[Finding]:
    for one in project.study.assumptions:
        for alternative, place in zip(one.alternatives, one.places, strict=True):
            try:
                suppose(project, [f"{one.about}={alternative}"])
            except RgssError as error:  # noqa: PERF203 - all problems are reported at once
                message = error.message.removeprefix("--what-if: ")
                yield replace(place, severity=Severity.ERROR, message=message, hint=error.hint)


def _range_findings(project: Project) -> Iterator[Finding]:
    known = input_names(project)
    trade_off = project.study.trade_off
    for one, place in zip(trade_off.sensitivity.ranges, trade_off.range_places, strict=True):
        if one.input not in known:
            message = f"unknown input {one.input!r} of the decision"
            yield replace(place, severity=Severity.ERROR, message=message, hint=nearest_names(one.input, known))


def input_names(project: Project) -> tuple[str, ...]:
    """Names that a range may have: weights, ends and shapes of value functions, thresholds, assumed numbers."""
    trade_off = project.study.trade_off
    measures = list(trade_off.weighting.weights)
    return (
        *(f"weight.{measure}" for measure in measures),
        *(f"value.{one.measure}.{key}" for one in trade_off.valued for key in one.anchors),
        *(f"shape.{measure}" for measure in (*measures, _ALL)),
        *(f"{one.id}.threshold" for one in project.requirements.system if one.criterion is not None),
        *(number.id for number in assumed_numbers(project)),
    )
