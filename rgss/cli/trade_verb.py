"""``rgss trade``: the decision, and why."""

from __future__ import annotations

import argparse
from typing import Any

from rgss.cli.options import add_fidelity, add_replicates, add_study, chosen_project

HELP = "decide which variant is best, and say why"
EXAMPLE = "rgss trade --json > decision.json"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    add_replicates(parser)
    add_fidelity(parser)


def run(options: argparse.Namespace) -> int:
    """Decide; 1 if no variant meets every requirement."""
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import print_json
    from rgss.cli.sweep_verb import shown_path
    from rgss.evidence import EvidenceStore
    from rgss.studies.choosing import choose, double_counting
    from rgss.studies.measuring import measure_variants
    from rgss.tradeoff import decision_to_json

    project = chosen_project(options)
    label = shown_path(project.evidence)
    with EvidenceStore.open(project.evidence, create=False, label=label) as store:
        measured = measure_variants(project, store)
    decision = choose(project, measured)
    overlaps = double_counting(project)
    if options.json:
        document: dict[str, Any] = decision_to_json(decision)
        document["double_counting"] = [{"whole": overlap.whole, "part": overlap.part} for overlap in overlaps]
        document["evidence"] = label
        print_json(document)
    else:
        _show(project, measured, decision, overlaps, label)
    return CLEAN if decision.chosen is not None else FINDINGS


def _show(project: Any, measured: Any, decision: Any, overlaps: Any, evidence: str) -> None:
    from rgss.cli.output import number, print_table

    by_id = {entry.variant.id: entry for entry in measured}
    total = len(measured)
    trials = sum(len(entry.records) for entry in measured)
    print(f"Study {project.study.id}: {total} variants, {trials} trials\n")
    if decision.chosen is None:
        print("No variant meets every requirement.")
        conflicts = decision.conflicts
        rows = [[c.requirement, _criterion(project, c.requirement), str(c.excluded)] for c in conflicts.excluded_by]
        print_table(["requirement", "asks for", "excludes"], rows, right=(2,))
        print(f"\nThese cannot be met together: {', '.join(conflicts.minimal_conflict)}.")
        print(
            f"Nearest: variant {conflicts.nearest.variant}, which violates {', '.join(conflicts.nearest.requirements)}."
        )
        print(f"Evidence: {evidence}")
        return
    shown = [variant for variant in (decision.chosen, decision.runner_up) if variant is not None]
    values = {ranked.variant: ranked.value for ranked in decision.ranking}
    heads = ["chosen", "runner-up"][: len(shown)]
    rows = [["variant", "", "", *(str(variant) for variant in shown)]]
    for definition in project.designs.parameters:
        cells = [str(by_id[variant].variant.parameters[definition.id]) for variant in shown]
        varies = len({str(entry.variant.parameters[definition.id]) for entry in measured}) > 1
        if varies:
            rows.append([definition.name.replace("_", " "), definition.unit, "", *cells])
    weights = {anchors.measure: anchors.weight for anchors in project.study.values}
    for measure, weight in weights.items():
        estimates = [by_id[variant].estimates[measure] for variant in shown]
        rows.append([measure, estimates[0].unit, f"{weight:.2f}", *(number(e.value) for e in estimates)])
    rows.append(["value", "", "", *(f"{values[variant]:.4f}" for variant in shown)])
    print_table(["", "unit", "weight", *heads], rows, right=(2, 3, 4))
    print()
    _explain(project, decision)
    for overlap in overlaps:
        print(f"Caution: {overlap.whole} contains {overlap.part}, so {overlap.part} counts twice.")
    certificate = decision.certificate
    agrees = "agrees" if certificate.enumeration_agrees else "DISAGREES"
    print(
        f"Certificate: {certificate.status.value} by {certificate.solver}, gap {number(certificate.gap)}; "
        f"enumeration of all {total} variants {agrees}."
    )
    print(f"Evidence: {evidence}")


def _explain(project: Any, decision: Any) -> None:
    feasible = len(decision.ranking)
    print(f"Variant {decision.chosen} has the highest value of the {feasible} variants that meet every requirement.")
    others = [variant for variant in decision.ties if variant != decision.chosen]
    if others:
        print(f"Variants {', '.join(map(str, others))} have the same value; the smallest id is chosen.")
    if decision.runner_up is not None and decision.runner_up_contributions:
        gains = sorted(
            (
                (mine.contribution - theirs.contribution, mine.measure)
                for mine, theirs in zip(decision.chosen_contributions, decision.runner_up_contributions, strict=True)
            ),
            key=lambda gain: -abs(gain[0]),
        )
        told = ", ".join(f"{measure} {gain:+.4f}" for gain, measure in gains if abs(gain) > 5e-5)
        print(f"It leads the runner-up {decision.runner_up} by: {told or 'less than rounding shows'}.")
    if decision.excluded_better:
        better = decision.excluded_better
        ids = ", ".join(str(entry.variant) for entry in better[:6]) + (" …" if len(better) > 6 else "")
        print(f"{len(better)} variants would be worth more but violate a requirement: {ids}")
        for count in decision.deciding_requirements:
            print(f"  {count.requirement} ({_criterion(project, count.requirement)}) excludes {count.excluded} of them")
    else:
        print("No requirement excludes a variant of higher value.")


def _criterion(project: Any, requirement: str) -> str:
    if requirement.startswith("evidence:"):
        return "evidence"
    return str(project.requirements.requirement(requirement).criterion)
