"""The decision of a report in words and figures: what is chosen, why, and what would change it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rgss.assessment import VariantMeasures
from rgss.decision import ScreeningResult, double_counting, screening_summary, shared_measures, trade_problem
from rgss.decision.robustness import (
    RequirementPrice,
    Robustness,
    assumptions_to_json,
    costs_to_json,
    not_computed_lines,
)
from rgss.reports.study.conflicts import conflict_reasons
from rgss.reports.study.numbers import Plain, plain_number
from rgss.studies import Project
from rgss.trace.views import value_in_words
from rgss.tradeoff import Decision, DecisionStatus, PortfolioDecision
from rgss.tradeoff.problem import Comparison, tabulated
from rgss.tradeoff.programs import condition_column
from rgss.tradeoff.robustness import changes_of_best, step_at

MOST_CONTENDERS = 40
"""So many variants that come first for some weights are told of, the most acceptable first."""

_MOST_LISTED = 6


def decision_part(
    project: Project,
    measured: Sequence[VariantMeasures],
    decision: Decision,
    found: Robustness,
    *,
    screened: ScreeningResult | None,
    fleet: PortfolioDecision | None,
) -> Plain:
    """What is decided and why, what nearly won, and what would change the decision.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        decision: What was decided.
        found: How robust that is.
        screened: What became of the designs in screening; None if there was none.
        fleet: The portfolio that the study asks for; None if it asks for none.
    """
    certificate = decision.certificate
    return {
        "chosen": decision.chosen,
        "runner_up": decision.runner_up,
        "ties": list(decision.ties),
        "near_ties": list(decision.near_ties),
        "program": decision.program,
        "objectives": list(decision.objectives),
        "counts": {"alternatives": decision.counts.alternatives, "feasible": decision.counts.feasible},
        "demands": dict(decision.demands),
        "headline": _headline(decision),
        "reasons": list(_reasons(project, measured, decision)),
        "cautions": list(_cautions(project, decision)),
        "screening": "" if screened is None else screening_summary(screened),
        "fleet": "" if fleet is None else _fleet(fleet),
        "contributions": {
            side: [
                {"measure": one.measure, "value": one.value, "weight": one.weight, "contribution": one.contribution}
                for one in contributions
            ]
            for side, contributions in (
                ("chosen", decision.chosen_contributions),
                ("runner_up", decision.runner_up_contributions),
            )
        },
        "certificate": {
            "status": certificate.status.value,
            "solver": certificate.solver,
            "gap": certificate.gap,
            "alternatives": certificate.alternatives,
            "objective": certificate.objective,
            "objective_recomputed": certificate.objective_recomputed,
            "enumeration_agrees": certificate.enumeration_agrees.value,
            "checks": [check.text for check in certificate.checks],
        },
        "acceptability": _acceptability(found),
        "weight_ranges": _weight_ranges(found),
        "limits": [_limit(found, price) for price in found.prices],
        "assumptions": assumptions_to_json(found),
        "costs": costs_to_json(found),
        "refused": dict(found.refused),
        "not_computed": list(not_computed_lines(found.not_computed)),
    }


def _headline(decision: Decision) -> str:
    counts = decision.counts
    if decision.chosen is None:
        return f"No variant is chosen: none of {counts.alternatives} meets every requirement."
    meet = "meets" if counts.feasible == 1 else "meet"
    return f"Variant {decision.chosen} is chosen: {counts.feasible} of {counts.alternatives} {meet} every requirement."


def _reasons(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> Iterator[str]:
    if decision.chosen is None:
        yield from conflict_reasons(decision)
        return
    additive = decision.program == "additive"
    yield (
        f"It has the highest weighted value of the {decision.counts.feasible} that meet every requirement."
        if additive
        else f"It is the choice of the {decision.program.replace('_', ' ')} program."
    )
    others = [str(variant) for variant in decision.ties if variant != decision.chosen]
    if others:
        yield f"As good: {_listed(others)}; of equals the smallest id is chosen."
    if decision.near_ties:
        margin = project.study.trade_off.practical_margin
        yield f"Within the practical margin of {margin:g} of it: {_listed(list(map(str, decision.near_ties)))}."
    if decision.runner_up is not None and decision.runner_up_contributions:
        gains = [
            (one.contribution - other.contribution, one.measure)
            for one, other in zip(decision.chosen_contributions, decision.runner_up_contributions, strict=True)
        ]
        told = [f"{measure} {gain:+.4f}" for gain, measure in sorted(gains, key=lambda one: -abs(one[0]))]
        shown = [text for text in told if not text.endswith("0.0000")]
        yield f"Over the runner-up, variant {decision.runner_up}, it gains or loses: {', '.join(shown) or 'nothing'}."
    if decision.excluded_better:
        by = ", ".join(f"{one.requirement} excludes {one.excluded}" for one in decision.deciding_requirements)
        yield f"Worth more, but not allowed: {decision.counts.excluded_better} variants ({by})."
    else:
        yield "No requirement excludes a variant of higher value."
    yield from _closest_limits(project, measured, decision)


def _closest_limits(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> Iterator[str]:
    # Of the chosen variant alone, for a trade-off of many takes long to pose.
    problem = trade_problem(project, [entry for entry in measured if entry.variant.id == decision.chosen])
    table = tabulated(problem.alternatives)
    row = table.row_of(decision.chosen or 0)
    margins = []
    for place, condition in enumerate(problem.conditions):
        statistic = float(condition_column(condition, table)[row])
        share = condition.sense.margin(statistic, condition.limit) / (abs(condition.limit) or 1.0)
        margins.append((share, place, condition, statistic))
    for share, _, condition, statistic in sorted(margins)[:2]:
        yield (
            f"Close to a limit: {condition.requirement} asks for {condition.demand}; it has "
            f"{value_in_words(statistic, condition.limit_unit)}, {100.0 * max(0.0, share):.1f} % inside."
        )


def _cautions(project: Project, decision: Decision) -> Iterator[str]:
    for overlap in double_counting(project):
        instead = f" {overlap.instead} could be valued instead of {overlap.whole}." if overlap.instead else ""
        yield f"{overlap.whole} contains {overlap.part}, so {overlap.part} counts twice.{instead}"
    for shared in shared_measures(project):
        yield f"{shared.first} and {shared.second} both stand on {', '.join(shared.parts)}."
    for flat in decision.flat_measures:
        among = "feasible variants" if flat.among_feasible else "variants"
        yield f"{flat.measure} is the same for all {among}, so its weight of {flat.weight:g} decides nothing."


def _fleet(fleet: PortfolioDecision) -> str:
    if fleet.objective is None and fleet.status is DecisionStatus.UNDECIDED:
        return f"No fleet that serves every study was found before the {_cut(fleet)}; there may be one."
    if fleet.objective is None:
        return f"No fleet of this size serves every study; unserved: {', '.join(fleet.unserved) or 'none'}."
    served = "; ".join(f"{one.task} by {one.member} (variant {one.variant})" for one in fleet.assignments)
    text = f"Fleet: {', '.join(fleet.members)} together serve every study: {served}."
    if fleet.status is DecisionStatus.BEST_FOUND:
        text += f" Best found, not proven best: another one can be better by at most {fleet.gap:.4g} ({_cut(fleet)})."
    return text


def _cut(fleet: PortfolioDecision) -> str:
    return "end of the proof" if fleet.cut is None else fleet.cut.value


def _acceptability(found: Robustness) -> Plain | None:
    weighting = found.weighting
    if weighting is None or weighting.acceptability is None:
        return None
    indices = weighting.acceptability
    order = np.lexsort((np.arange(len(found.variants)), -indices.first))
    rows = [int(row) for row in order if indices.first[row] > 0.0]
    return {
        "iterations": indices.iterations,
        "drawn_by": indices.drawn_by.value,
        "with_noise": weighting.with_noise,
        "elicited": weighting.elicited,
        "more": max(0, len(rows) - MOST_CONTENDERS),
        "variants": [
            {
                "variant": found.variants[row],
                "first": plain_number(float(indices.first[row])),
                "error": plain_number(float(indices.rank_errors[row, 0])),
                "confidence": plain_number(float(indices.confidence[row])),
                "feasible": plain_number(float(1.0 - indices.unranked[row])),
                "region": None if weighting.regions is None else plain_number(float(weighting.regions[row].share)),
            }
            for row in rows[:MOST_CONTENDERS]
        ],
    }


def _weight_ranges(found: Robustness) -> list[Plain]:
    if found.weighting is None or found.weighting.ranges is None:
        return []
    return [
        {
            "measure": measure,
            "weight": float(weight),
            "low": plain_number(one.low),
            "high": plain_number(one.high),
            "below": [found.variants[row] for row in one.below],
            "above": [found.variants[row] for row in one.above],
        }
        for measure, weight, one in zip(found.measures, found.weights.tolist(), found.weighting.ranges, strict=True)
    ]


def _limit(found: Robustness, price: RequirementPrice) -> Plain:
    """What the choice would be with a requirement's limit moved to the next change on either side."""
    condition = price.condition
    at_least = condition.sense is Comparison.AT_LEAST
    steps = changes_of_best(price.steps)
    # A quantity that equals the limit up to one part in 10⁹ meets it.
    slack = 1e-9 * max(1.0, abs(condition.limit))
    here = step_at(steps, condition.limit - slack if at_least else condition.limit + slack, at_least=at_least)
    place = steps.index(here)
    looser = steps[place - 1] if place > 0 else None
    tighter = steps[place + 1] if place + 1 < len(steps) else None
    return {
        "requirement": condition.requirement,
        "demand": condition.demand,
        "unit": condition.limit_unit,
        "looser_to": None if looser is None else plain_number(looser.tightest),
        "then": None if looser is None else [found.variants[row] for row in looser.best][:_MOST_LISTED],
        "tighter_beyond": None if tighter is None else plain_number(here.tightest),
        "then_wins": None if tighter is None else [found.variants[row] for row in tighter.best][:_MOST_LISTED],
    }


def _listed(names: Sequence[str]) -> str:
    most = 12
    more = f" and {len(names) - most} more" if len(names) > most else ""
    word = "variant" if len(names) == 1 else "variants"
    return f"{word} {', '.join(names[:most])}{more}"
