"""The decision as a page that a person can read: what, why, and on what it stands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rgss.cli.trade.conflicts import print_conflicts
from rgss.cli.trade.words import amount, ids_text, percent, variants_text

if TYPE_CHECKING:
    from rgss.assessment import VariantMeasures
    from rgss.studies import Project
    from rgss.tradeoff import Contribution, Decision, PortfolioDecision


def print_heading(project: Project, measured: Sequence[VariantMeasures]) -> None:
    """Say what was compared."""
    trials = sum(len(entry.records) for entry in measured)
    print(f"Study {project.study.id}: {len(measured)} variants, {trials} trials\n")


def print_decision(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> None:
    """Show the chosen variant beside the runner-up, and say why; or why nothing can be chosen."""
    if decision.chosen is None:
        print_conflicts(decision)
        return
    _print_comparison(project, measured, decision)
    print("\nWhy")
    _print_reasons(project, measured, decision)


def print_cautions(project: Project, decision: Decision) -> None:
    """Say what a reader should not overlook: double counting, weights that decide nothing."""
    from rgss.decision import double_counting, shared_measures

    for overlap in double_counting(project):
        instead = f" {overlap.instead} could be valued instead of {overlap.whole}." if overlap.instead else ""
        print(f"Caution: {overlap.whole} contains {overlap.part}, so {overlap.part} counts twice.{instead}")
    for shared in shared_measures(project):
        print(f"Caution: {shared.first} and {shared.second} both stand on {', '.join(shared.parts)}.")
    for flat in decision.flat_measures:
        among = "feasible variants" if flat.among_feasible else "variants"
        print(f"Caution: {flat.measure} is the same for all {among}, so its weight of {flat.weight:g} decides nothing.")


def print_certificate(decision: Decision, evidence: str) -> None:
    """Show what the decision is proven by, and its evidence."""
    from rgss.cli.output import number
    from rgss.tradeoff import Agreement, CheckKind

    certificate = decision.certificate
    compared = {
        Agreement.AGREED: f"enumeration of all {certificate.alternatives} variants agrees",
        Agreement.DISAGREED: f"enumeration of all {certificate.alternatives} variants DISAGREES",
        Agreement.NOT_ENUMERATED: "not enumerated",
    }[certificate.enumeration_agrees]
    print(
        f"Certificate: {certificate.status.value} by {certificate.solver}, gap {number(certificate.gap)}; {compared}."
    )
    for check in certificate.checks:
        if not check.agrees or check.kind is CheckKind.INDEPENDENT_SOLVER:
            print(f"Check: {check.text}.")
    print(f"Evidence: {evidence}")


def print_portfolio(fleet: PortfolioDecision) -> None:
    """Show a portfolio of designs and who serves which study."""
    from rgss.cli.output import number, print_table
    from rgss.tradeoff import CheckKind, DecisionStatus

    print("\nFleet")
    cut = "" if fleet.cut is None else f" ({fleet.cut.value})"
    if fleet.status is DecisionStatus.UNDECIDED:
        print(f"No fleet that serves every study was found{cut}, nor that there is none was proved.")
        return
    if fleet.objective is None:
        print(f"No fleet of this size serves every study; by itself unserved: {', '.join(fleet.unserved) or 'none'}.")
        return
    print(f"{', '.join(fleet.members)} together serve every study; value {number(fleet.objective)}.")
    rows = [[one.task, one.member, str(one.variant), number(one.value)] for one in fleet.assignments]
    print_table(["study", "served by", "variant", "value"], rows, right=(2, 3))
    sizes = ", ".join(f"{size}: {number(best)}" for size, best in enumerate(fleet.by_size, start=1))
    print(f"Value with at most so many members: {sizes}.")
    proof = "proven best"
    if fleet.status is DecisionStatus.BEST_FOUND:
        proof = f"best found, not proven best: another one can be better by at most {number(fleet.gap)}{cut}"
    elif fleet.cut is not None:
        proof += f"; of fewer members not every value is{cut}"
    print(f"Certificate: {proof}; enumeration of all fleets: {fleet.enumeration_agrees.value}.")
    for check in fleet.checks:
        if not check.agrees or check.kind is CheckKind.INDEPENDENT_SOLVER:
            print(f"Check: {check.text}.")


def _print_comparison(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> None:
    from rgss.cli.output import number, print_table

    by_id = {entry.variant.id: entry for entry in measured}
    shown = [variant for variant in (decision.chosen, decision.runner_up) if variant is not None]
    values = {ranked.variant: ranked for ranked in decision.ranking}
    rows = [["variant", "", "", *(str(variant) for variant in shown)]]
    for definition in project.designs.parameters:
        cells = [str(by_id[variant].variant.parameters[definition.id]) for variant in shown]
        if len({str(entry.variant.parameters[definition.id]) for entry in measured}) > 1:
            rows.append([definition.name.replace("_", " "), definition.unit, "", *cells])
    for measure, weight in project.study.trade_off.weighting.weights.items():
        estimates = [by_id[variant].estimates[measure] for variant in shown]
        rows.append([measure, estimates[0].unit, f"{weight:.2f}", *(number(one.value) for one in estimates)])
    rows.append(["value", "", "", *(_value(values[variant].value) for variant in shown)])
    if decision.program != "additive":
        for place, objective in enumerate(decision.objectives):
            if objective != "value":
                cells = [number(values[variant].objectives[place]) for variant in shown]
                rows.append([f"{place + 1}. {objective}", "", "", *cells])
    print_table(["", "unit", "weight", *["chosen", "runner-up"][: len(shown)]], rows, right=(2, 3, 4))


def _print_reasons(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> None:
    feasible = decision.counts.feasible
    best = (
        "has the highest value"
        if decision.program == "additive"
        else f"is the choice of the {decision.program} program"
    )
    every = "is the one variant" if feasible == 1 else f"of the {feasible} variants"
    meets = "that meets" if feasible == 1 else "that meet"
    print(f"Variant {decision.chosen} {best} {every} {meets} every requirement.")
    others = [variant for variant in decision.ties if variant != decision.chosen]
    if others:
        print(f"Variants {', '.join(map(str, others))} have the same value; the smallest id is chosen.")
    if decision.near_ties:
        margin = project.study.trade_off.practical_margin
        print(f"Within the practical margin of {margin:g} of it: {variants_text(decision.near_ties)}.")
    if decision.runner_up is not None and decision.runner_up_contributions:
        told = _lead(decision.chosen_contributions, decision.runner_up_contributions)
        print(f"It leads the runner-up {decision.runner_up} by: {told}.")
    _print_excluded(decision)
    _print_closest_limits(project, measured, decision)


def _print_excluded(decision: Decision) -> None:
    if not decision.excluded_better:
        print("No requirement excludes a variant of higher value.")
        return
    count = decision.counts.excluded_better
    ids = ids_text(one.variant for one in decision.excluded_better)
    print(f"{count} variant{'s' if count > 1 else ''} would be worth more but violate a requirement: {ids}")
    for each in decision.deciding_requirements:
        print(f"  {each.requirement} ({decision.demands[each.requirement]}) excludes {each.excluded} of them")


def _print_closest_limits(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> None:
    """The thresholds that the choice comes closest to, as a share of the threshold."""
    from rgss.decision import trade_problem
    from rgss.tradeoff.problem import tabulated
    from rgss.tradeoff.programs import condition_column

    problem = trade_problem(project, measured)
    table = tabulated(problem.alternatives)
    row = table.row_of(decision.chosen or 0)
    margins = []
    for condition in problem.conditions:
        statistic = float(condition_column(condition, table)[row])
        margin = condition.sense.margin(statistic, condition.limit)
        margins.append((margin / (abs(condition.limit) or 1.0), condition, statistic))
    close = [
        f"{condition.requirement} ({condition.demand}) at {amount(statistic, condition.limit_unit)}, "
        f"{percent(max(0.0, margin))} inside"
        for margin, condition, statistic in sorted(margins, key=lambda one: one[0])[:2]
    ]
    if close:
        print(f"Closest limits: {'; '.join(close)}.")


def _lead(mine: Sequence[Contribution], theirs: Sequence[Contribution]) -> str:
    gains = sorted(
        ((one.contribution - other.contribution, one.measure) for one, other in zip(mine, theirs, strict=True)),
        key=lambda gain: -abs(gain[0]),
    )
    told = ", ".join(f"{measure} {gain:+.4f}" for gain, measure in gains if abs(gain) > 5e-5)
    return told or "less than rounding shows"


def _value(value: float | None) -> str:
    return "–" if value is None else f"{value:.4f}"
