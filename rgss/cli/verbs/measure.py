"""``rgss measure``: measures and verdicts from evidence."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Container, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from rgss.cli.options import add_evidence_choice, chosen_project

if TYPE_CHECKING:
    from rgss.assessment import VariantMeasures
    from rgss.decision import ScreeningResult
    from rgss.studies import Project

HELP = "estimate the measures of every variant from evidence, with verdicts on the requirements"
PAGED = True
EXAMPLE = "rgss measure --json > measures.json"
MORE_EXAMPLES = (
    ("rgss measure", "the measures of effectiveness and the verdicts of every variant"),
    ("rgss measure --variant 2", "every measure and verdict of one"),
    ("rgss measure --drivers", "the draws that differ between failures and other trials"),
    ("rgss measure --case payload", "by the trials of one case of the workload"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_evidence_choice(parser)
    parser.add_argument("--variant", type=int, metavar="ID", help="only this variant, with every measure")
    parser.add_argument(
        "--drivers", action="store_true", help="only the uncertain quantities that drive each kind of failure"
    )
    parser.add_argument("--case", metavar="NAME", help="only the trials of this case of the workload")
    parser.add_argument("--verdicts", action="store_true", help="only the verdicts, with the reason of a stale one")
    parser.add_argument(
        "--record",
        action="store_true",
        help="record the verdicts on the requirements and measures as they are now, so that later changes show",
    )


def run(options: argparse.Namespace) -> int:
    """Show the measures; a dash marks those without evidence."""
    from rgss.assessment import measured_in_case, read_record, record_verdicts, sequential_seeds
    from rgss.cli.measured import require_store
    from rgss.cli.output import print_json, shown_path
    from rgss.decision import measure_survivors
    from rgss.evidence import EvidenceStore
    from rgss.reports.decision import screening_lines, seeds_sentences

    project = chosen_project(options)
    _check_options(options, project)
    require_store(options, project)
    with EvidenceStore.open(project.evidence, create=False, label=shown_path(project.evidence)) as store:
        recorded = record_verdicts(project, store) if options.record else read_record(project.folder)
        measured, screened = measure_survivors(project, store, recorded=recorded)
    if options.variant is not None:
        if screened is not None:
            _require_not_screened_out(options.variant, screened)
        measured = tuple(entry for entry in measured if entry.variant.id == options.variant)
    if options.case is not None:
        measured = measured_in_case(project, measured, options.case)
    if options.drivers:
        _print_drivers(project, measured, as_json=options.json)
    elif options.json:
        print_json(list(_verdict_rows(measured) if options.verdicts else _measure_rows(measured)))
    else:
        _print_measures(options, project, measured)
        if screened is not None and options.variant is None:
            print("\n" + "\n".join(screening_lines(screened)))
        if lines := list(seeds_sentences(sequential_seeds(project, measured))):
            print("\n" + "\n".join(lines))
    return 0


def _check_options(options: argparse.Namespace, project: Project) -> None:
    from rgss.errors import DefinitionError

    if options.variant is not None:
        project.designs.variant(options.variant)
        if options.record:
            raise DefinitionError("--record needs all variants", hint="omit --variant")
    if options.case is not None and options.record:
        raise DefinitionError("--record needs all trials", hint="omit --case")


def _require_not_screened_out(variant: int, screened: ScreeningResult) -> None:
    from rgss.errors import DefinitionError

    for one in screened.screened_out:
        if one.variant == variant:
            raise DefinitionError(
                f"variant {variant} was screened out: {one.reason}",
                hint=f"'--fidelity {screened.screening.fidelity.value}' shows what is known of it",
            )


def _print_measures(options: argparse.Namespace, project: Project, measured: Sequence[VariantMeasures]) -> None:
    if options.verdicts:
        _print_verdicts(project, measured)
    elif options.variant is not None:
        _print_variant(project, measured[0])
    else:
        _print_all(project, measured)


def _print_drivers(project: Project, measured: Sequence[VariantMeasures], *, as_json: bool) -> None:
    from rgss.assessment import drivers_of_failures, success_by_case
    from rgss.cli.output import print_json, print_lines
    from rgss.reports import case_lines, cases_to_json, driver_lines, drivers_to_json

    records = [record for entry in measured for record in entry.records]
    found = drivers_of_failures(records, carried=project.study.task.carried)
    cases = success_by_case(project, measured)
    if as_json:
        print_json({**drivers_to_json(found), "cases": cases_to_json(cases)})
    else:
        print_lines((*driver_lines(found), *case_lines(cases)))


def _measure_rows(measured: Sequence[VariantMeasures]) -> Iterator[dict[str, Any]]:
    for entry in measured:
        for name, estimate in entry.estimates.items():
            yield {
                "variant": entry.variant.id,
                "measure": name,
                "value": estimate.value,
                "unit": estimate.unit,
                "low": estimate.low,
                "high": estimate.high,
                "n": estimate.n,
            }


def _verdict_rows(measured: Sequence[VariantMeasures]) -> Iterator[dict[str, Any]]:
    for entry in measured:
        for requirement, verdict in entry.verdicts.items():
            changed = [cause.value for cause in entry.causes.get(requirement, ())]
            yield {
                "variant": entry.variant.id,
                "requirement": requirement,
                "verdict": verdict.value,
                "changed": changed,
            }


def _print_verdicts(project: Project, measured: Sequence[VariantMeasures]) -> None:
    from rgss.cli.output import print_table

    rows = [
        [str(row["variant"]), row["requirement"], row["verdict"], ", ".join(row["changed"])]
        for row in _verdict_rows(measured)
    ]
    print_table(["variant", "requirement", "verdict", "changed since"], rows, right=(0,))
    _print_stale(project, measured)


def _print_variant(project: Project, entry: VariantMeasures) -> None:
    from rgss.cli.output import number, print_table

    rows = []
    for measure in project.measures.measures:
        estimate = entry.estimates[measure.id]
        rows.append(
            [
                measure.id,
                number(estimate.value),
                estimate.unit,
                "–" if estimate.low is None else f"{number(estimate.low)} … {number(estimate.high)}",
                str(estimate.n),
                measure.name,
                measure.kind.value.upper(),
            ]
        )
    print_table(["measure", "value", "unit", "interval", "trials", "name", "kind"], rows, right=(1, 4), spare=(5, 6))
    print()
    print_table(["requirement", "verdict"], [[name, verdict.value] for name, verdict in entry.verdicts.items()])
    cautions = [*_gap_lines(project, [entry], entry.estimates), *_substitution_lines(project, [entry])]
    if cautions:
        print("", *cautions, sep="\n")
    _print_stale(project, [entry])


def _print_all(project: Project, measured: Sequence[VariantMeasures]) -> None:
    from rgss.assessment import judged_measures, leading_measures
    from rgss.cli.measured_tables import print_measures, print_verdict_counts

    shown = leading_measures(project)
    print_verdict_counts(project, measured)
    cautions = [*_gap_lines(project, measured, judged_measures(project)), *_substitution_lines(project, measured)]
    if cautions:
        print(*cautions, "", sep="\n")
    print_measures(shown, measured)
    _print_stale(project, measured)


def _gap_lines(project: Project, measured: Sequence[VariantMeasures], shown: Container[str]) -> tuple[str, ...]:
    """Cautions where an equation and the simulation differ by more than a tenth."""
    from rgss.measures import ModelGap, model_gaps
    from rgss.reports.decision import gap_sentence

    found: dict[str, list[tuple[int, ModelGap]]] = {}
    for entry in measured:
        for gap in model_gaps(project.measures, entry.estimates):
            if gap.is_notable and gap.measure in shown:
                found.setdefault(gap.measure, []).append((entry.variant.id, gap))
    lines = []
    for measure, gaps in found.items():
        variant, widest = max(gaps, key=lambda pair: abs(pair[1].relative))
        in_all = (
            f"{measure}: equation and simulation differ by more than 10 % in {len(gaps)} of {len(measured)} variants"
        )
        lines.append(f"Caution: {in_all}, most in variant {variant}: {gap_sentence(widest)}.")
    return tuple(lines)


def _substitution_lines(project: Project, measured: Sequence[VariantMeasures]) -> tuple[str, ...]:
    """Cautions where another term stands for one that trials do not observe."""
    from rgss.decision.study_decision import deciding_substitutions
    from rgss.reports.decision import substitution_sentence

    found = deciding_substitutions(project, measured)
    return tuple(f"Caution: {substitution_sentence(one, len(measured))}" for one in found)


def _print_stale(project: Project, measured: Sequence[VariantMeasures]) -> None:
    """Print why verdicts are stale, with a remedy."""
    from rgss.assessment import stale_remedies

    counts = Counter(causes for entry in measured for causes in entry.causes.values())
    if not counts:
        return
    print()
    for causes, count in sorted(counts.items(), key=lambda item: (-item[1], item[0])):
        verdicts, verb = ("verdict is", "it was") if count == 1 else ("verdicts are", "they were")
        what = ", ".join(cause.value for cause in causes)
        print(f"{count} {verdicts} stale, for this changed since {verb} made: {what}")
    print(*stale_remedies(project, measured), sep="\n")
