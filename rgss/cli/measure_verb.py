"""``rgss measure``: measures and verdicts from evidence."""

from __future__ import annotations

import argparse

from rgss.cli.options import add_fidelity, add_replicates, add_study, chosen_project

HELP = "estimate the measures of every variant from evidence, and judge the requirements"
EXAMPLE = "rgss measure --json > measures.json"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    add_replicates(parser)
    add_fidelity(parser)
    parser.add_argument("--variant", type=int, metavar="ID", help="only this variant, with every measure")


def run(options: argparse.Namespace) -> int:
    """Show the measures; what has no evidence is shown as not known."""
    from rgss.cli.output import number, print_json, print_table
    from rgss.cli.sweep_verb import shown_path
    from rgss.evidence import EvidenceStore
    from rgss.measures import MeasureKind
    from rgss.studies.measuring import measure_variants

    project = chosen_project(options)
    if options.variant is not None:
        project.designs.variant(options.variant)
    with EvidenceStore.open(project.evidence, create=False, label=shown_path(project.evidence)) as store:
        measured = measure_variants(project, store)
    if options.variant is not None:
        measured = tuple(entry for entry in measured if entry.variant.id == options.variant)
    if options.json:
        print_json(
            [
                {
                    "variant": entry.variant.id,
                    "measure": name,
                    "value": estimate.value,
                    "unit": estimate.unit,
                    "low": estimate.low,
                    "high": estimate.high,
                    "n": estimate.n,
                }
                for entry in measured
                for name, estimate in entry.estimates.items()
            ]
        )
        return 0
    if options.variant is not None:
        rows = [
            [
                m.id,
                m.kind.value.upper(),
                m.name,
                number(e.value),
                e.unit,
                f"{number(e.low)} … {number(e.high)}",
                str(e.n),
            ]
            for m in project.measures.measures
            for e in [measured[0].estimates[m.id]]
        ]
        print_table(["measure", "kind", "name", "value", "unit", "interval", "trials"], rows, right=(3, 6))
        print()
        print_table(["requirement", "verdict"], [[k, v.value] for k, v in measured[0].verdicts.items()])
        return 0
    shown = project.measures.of_kind(MeasureKind.EFFECTIVENESS)
    titles = ["variant", *(f"{m.id} [{m.unit}]" for m in shown), "trials", *(measured[0].verdicts if measured else ())]
    rows = []
    for entry in measured:
        cells = []
        for m in shown:
            estimate = entry.estimates[m.id]
            spread = estimate.n > 0 and estimate.low is not None and estimate.low != estimate.high
            cells.append(
                number(estimate.value) + (f" ({number(estimate.low, 3)}–{number(estimate.high, 3)})" if spread else "")
            )
        rows.append(
            [str(entry.variant.id), *cells, str(len(entry.records)), *(v.value for v in entry.verdicts.values())]
        )
    print_table(titles, rows, right=(0,))
    return 0
