"""Tables of ``rgss measure``: the verdicts on each requirement, and the measures of every variant."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

from rgss.cli.output import number, print_table
from rgss.counted import counted

if TYPE_CHECKING:
    from rgss.assessment import VariantMeasures
    from rgss.measures import Measure
    from rgss.studies import Project


def print_verdict_counts(project: Project, measured: Sequence[VariantMeasures]) -> None:
    """Print how many variants meet each requirement, which is what a reader looks for first."""
    from rgss.assessment import requirements_with_criteria
    from rgss.measures import Verdict

    trials = sum(len(entry.records) for entry in measured)
    print(f"Study {project.study.id}: {counted(len(measured), 'variant')}, {counted(trials, 'trial')}")
    found = [
        (one, Counter(entry.verdicts[one.id] for entry in measured)) for one in requirements_with_criteria(project)
    ]
    always = (Verdict.MET, Verdict.NOT_MET, Verdict.INCONCLUSIVE)
    shown = [one for one in Verdict if one in always or any(counts[one] for _, counts in found)]
    print_table(
        ["requirement", "criterion", *(verdict.value for verdict in shown)],
        [[one.id, str(one.criterion), *(str(counts[verdict]) for verdict in shown)] for one, counts in found],
        right=range(2, 2 + len(shown)),
    )
    print()


def print_measures(measures: Sequence[Measure], measured: Sequence[VariantMeasures]) -> None:
    """Print the measures and verdicts of every variant; on a terminal, variants that show the same share a row."""
    from rgss.cli.terminal import TerminalPage
    from rgss.reports.decision import ids_text

    rows = {entry.variant.id: _cells(measures, entry) for entry in measured}
    together: dict[tuple[str, ...], list[int]] = {}
    for variant, cells in rows.items():
        together.setdefault(cells, []).append(variant)
    titles = [*(f"{one.id} [{one.unit}]" for one in measures), "trials", *(measured[0].verdicts if measured else ())]
    if isinstance(sys.stdout, TerminalPage) and len(together) < len(rows):
        table = [[ids_text(variants, longest=len(variants)), *cells] for cells, variants in together.items()]
        print_table(["variants", *titles], table)
    else:
        print_table(["variant", *titles], [[str(variant), *cells] for variant, cells in rows.items()], right=(0,))


def _cells(measures: Sequence[Measure], entry: VariantMeasures) -> tuple[str, ...]:
    cells = []
    for measure in measures:
        estimate = entry.estimates[measure.id]
        spread = estimate.n > 0 and estimate.low is not None and estimate.low != estimate.high
        interval = f" ({number(estimate.low, 3)}–{number(estimate.high, 3)})" if spread else ""
        cells.append(number(estimate.value) + interval)
    return (*cells, str(len(entry.records)), *(verdict.value for verdict in entry.verdicts.values()))
