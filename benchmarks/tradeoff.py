"""Measure the cost of the sensitivity and robustness analyses of a decision; write tables in Markdown.

Run it from the repository's folder: ``python benchmarks/tradeoff.py``. The second table needs
evidence: run ``rgss sweep`` before. Seconds of the processor are given beside those of the clock,
since they depend less on the load of the machine.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose, trade_problem
from rgss.decision.robustness.assumptions import assumption_findings
from rgss.decision.robustness.cost_box import cost_box
from rgss.decision.robustness.effects import study_effects
from rgss.decision.robustness.remeasuring import Remeasuring
from rgss.decision.robustness.robustness import ITERATIONS, analyse_robustness
from rgss.evidence import EvidenceStore
from rgss.studies.project import load_project
from rgss.tradeoff.problem.evidence_table import tabulated
from rgss.tradeoff.problem.resampling import bootstrap
from rgss.tradeoff.robustness.acceptability import Outcomes, smaa2
from rgss.tradeoff.robustness.effects import factorial_effects
from rgss.tradeoff.robustness.flip import weight_ranges, weight_shifts
from rgss.tradeoff.robustness.pareto import Support, pareto_front
from rgss.tradeoff.robustness.prices import price_list
from rgss.tradeoff.robustness.rank_reversal import rank_reversals, sample_anchored
from rgss.tradeoff.weights.weight_region import RegionKind, winning_regions
from rgss.tradeoff.weights.weight_set import WeightSet

PROJECT = Path(__file__).resolve().parents[1]
VARIANTS, SHAPE, MEASURES = 72, (2, 2, 2, 3, 3), 5
REPEATS = 3


def main() -> None:
    """Write both tables."""
    out = sys.stdout
    _random(out)
    project = load_project(PROJECT)
    if project.evidence.exists():
        _shipped(out, project)
    else:
        out.write("\nNo evidence: run `rgss sweep` for the second table.\n")


def _random(out: Any) -> None:
    """Random values: every variant differs, so that no computation is shared by equal variants."""
    out.write(f"{VARIANTS} random variants × {MEASURES} measures, all feasible, {ITERATIONS:,} draws\n\n")
    out.write("| analysis | result | clock (s) | processor (s) |\n|---|---|---|---|\n")
    generator = np.random.default_rng(1)
    values = generator.random((VARIANTS, MEASURES))
    feasible = np.ones(VARIANTS, dtype=bool)
    weights = np.array([0.25, 0.25, 0.2, 0.1, 0.2])
    simplex = WeightSet.simplex(MEASURES)
    chosen = int((values @ weights).argmax())
    total = 0.0

    def row(name: str, make: Callable[[], Any], result: Callable[[Any], str]) -> None:
        nonlocal total
        made, clock, processor = _timed(make)
        total += processor
        out.write(f"| {name} | {result(made)} | {clock:.3f} | {processor:.3f} |\n")

    row(
        "Pareto front, support",
        lambda: pareto_front(values, feasible),
        lambda made: f"{len(made.rows)} on the front, {len(made.with_support(Support.UNSUPPORTED))} unsupported",
    )
    row(
        "regions of weights",
        lambda: winning_regions(values, feasible, simplex, generator=np.random.default_rng(0)),
        lambda made: (
            f"{sum(one.kind is RegionKind.OPEN for one in made)} open, "
            f"shares sum to 1 within {abs(sum(one.share for one in made) - 1.0):.0e}"
        ),
    )
    row(
        "nearest flips, L1 and L2",
        lambda: weight_shifts(values, feasible, weights),
        lambda made: f"nearest at {made[1].distance:.4f}",
    )
    row(
        "one weight alone", lambda: weight_ranges(values, feasible, weights, chosen), lambda made: f"{len(made)} ranges"
    )
    for replicates in (3, 20):
        noise = values[None] + 0.03 * generator.standard_normal((1, VARIANTS, MEASURES))
        resamples = bootstrap(replicates, draws=1000, generator=np.random.default_rng(0))
        samples = np.clip(
            noise[0][..., None] + 0.05 * generator.standard_normal((VARIANTS, MEASURES, replicates)), 0, 1
        )
        drawn = resamples.means(samples)
        outcomes = Outcomes(
            values=drawn,
            feasible=np.ones(drawn.shape[:2], dtype=bool),
            probabilities=resamples.probabilities,
            exact=resamples.exact,
        )
        row(
            f"SMAA-2, {replicates} replicates",
            lambda outcomes=outcomes: smaa2(
                outcomes, simplex, iterations=ITERATIONS, generator=np.random.default_rng(0)
            ),  # type: ignore[misc]
            lambda made: f"largest standard error {made.rank_errors.max():.4f}",
        )
        table = drawn[..., 0].reshape(-1, *SHAPE)
        row(
            f"effects of 5 factors, {replicates} replicates",
            lambda table=table, resamples=resamples: factorial_effects(  # type: ignore[misc]
                table.mean(axis=0), list("abcde"), resampled=table, probabilities=resamples.probabilities
            ),
            lambda made: f"{len(made.effects)} terms",
        )
    row(
        "price list",
        lambda: price_list(values[:, 0], values @ weights, feasible, at_least=True),
        lambda made: f"{len(made)} steps",
    )
    row(
        "rank reversal, 72 removals",
        lambda: rank_reversals(VARIANTS, sample_anchored(values, np.ones(MEASURES, dtype=bool), weights)),
        lambda made: f"{len(made)} reverse",
    )
    out.write(f"| **together** | | | **{total:.3f}** |\n")


def _shipped(out: Any, project: Any) -> None:
    """The shipped study from its stored evidence."""
    with EvidenceStore.open(project.evidence, create=False, label="evidence") as store:
        measured = measure_variants(project, store)
    decision = choose(project, measured)
    problem = trade_problem(project, measured)
    table = tabulated(problem.alternatives)
    remeasuring = Remeasuring.of(project, measured, table)
    chosen = table.row_of(decision.chosen) if decision.chosen is not None else 0
    resamples = bootstrap(project.study.replicates, draws=1000, generator=np.random.default_rng(0))
    trials = sum(len(entry.records) for entry in measured)
    out.write(f"\nThe shipped study: {len(measured)} variants, {trials} trials\n\n")
    out.write("| analysis | clock (s) | processor (s) |\n|---|---|---|\n")
    parts: tuple[tuple[str, Callable[[], Any]], ...] = (
        ("assumptions, one at a time", lambda: assumption_findings(remeasuring, problem, chosen)),
        ("all assumed costs together", lambda: cost_box(remeasuring, problem, chosen)),
        ("effects on every measure", lambda: study_effects(project, measured, resamples)),
        ("**everything**", lambda: analyse_robustness(project, measured, decision)),
    )
    for name, make in parts:
        _, clock, processor = _timed(make)
        out.write(f"| {name} | {clock:.3f} | {processor:.3f} |\n")


def _timed(make: Callable[[], Any]) -> tuple[Any, float, float]:
    """The result, and the least seconds of clock and processor of a few runs."""
    clocks, processors, made = [], [], None
    for _ in range(REPEATS):
        clock, processor = time.perf_counter(), time.process_time()
        made = make()
        processors.append(time.process_time() - processor)
        clocks.append(time.perf_counter() - clock)
    return made, min(clocks), min(processors)


if __name__ == "__main__":
    main()
