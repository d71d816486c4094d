"""Stability of the choice and of the named ties of a study under other master seeds.

    rgss sweep STUDY --replicates 64
    python benchmarks/master_seeds.py STUDY --pool 64                    20 master seeds, drawn from the pool
    python benchmarks/master_seeds.py STUDY --pool 64 --disjoint         as many as the pool has, none shared
    python benchmarks/master_seeds.py STUDY --pool 64 --seeds 200        and the calibration of the probabilities

Nothing is simulated: the trials are those of the project's evidence store, the study's seed and the next ones.
A master seed is emulated by as many seeds of the pool as the study has replicates, each workload case by
its own, with replacement; with ``--disjoint`` by seeds that follow each other and that no other master seed has.
The decision from the whole pool is taken as the truth for the calibration of the reported probabilities.
It ends with 1 if fewer than 19 of 20 agree, or if a probability is off by more than 3 points in at least 200.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.assessment import measure_variants, require_complete
from rgss.decision.choosing import proportion_measures, trade_problem
from rgss.decision.level_structure import level_numbers
from rgss.evidence import EvidenceStore
from rgss.studies import Project, load_project
from rgss.tradeoff import Alternative, TradeProblem, decide
from rgss.tradeoff.problem import tabulated
from rgss.tradeoff.programs import single_values
from rgss.tradeoff.robustness import PosteriorOutcomes, choice_uncertainty

SAME = 0.95
POINTS = 0.03
ENOUGH = 200


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """Outcome of one master seed.

    Attributes:
        chosen: The variant that is chosen; None if none meets every requirement by the estimates.
        tied: The variants that are named as tied with it, itself among them.
        best: Reported probability that the choice is feasible and the best.
        good: Reported probability that it is feasible and within the practical margin of the best.
        feasible: Reported probability of feasibility of each variant.
        means: Posterior mean of each measure that is observed, by measure, of each variant.
    """

    chosen: int | None
    tied: frozenset[int]
    best: float
    good: float
    feasible: NDArray[np.float64]
    means: dict[str, NDArray[np.float64]]


@dataclass(frozen=True, kw_only=True, eq=False)
class Pool:
    """The trade-off over all trials of the pool.

    Attributes:
        project: The project.
        problem: The trade-off, whose samples are in the order of the seeds.
        cases: The workload case of each seed.
    """

    project: Project
    problem: TradeProblem
    cases: NDArray[np.str_]

    def outcome(self, picks: Sequence[int], seed: int) -> Outcome:
        """The decision from some of the seeds."""
        project = self.project
        problem = replace(self.problem, alternatives=tuple(_some(one, picks) for one in self.problem.alternatives))
        margin = project.study.trade_off.practical_margin
        decision = decide(problem, margin=margin, seed=project.study.seed)
        table = tabulated(problem.alternatives)
        variants = table.variants.tolist()
        found = PosteriorOutcomes.of(
            problem,
            table,
            proportion_measures(project),
            generator=np.random.default_rng(seed),
            levels=level_numbers(project.designs, variants),
        )
        means = {measure: rows.mean(axis=0) for measure, rows in found.drawn.items()}
        feasible = found.outcomes.feasible.mean(axis=0)
        if decision.chosen is None:
            none = float((~found.outcomes.feasible.any(axis=1)).mean())
            return Outcome(chosen=None, tied=frozenset(), best=none, good=none, feasible=feasible, means=means)
        row = table.row_of(decision.chosen)
        values, estimated = single_values(problem, table), np.isin(variants, [one.variant for one in decision.ranking])
        sure = choice_uncertainty(found, row, margin=margin, replicates=len(picks), estimated=estimated, single=values)
        return Outcome(
            chosen=decision.chosen,
            tied=frozenset((decision.chosen, *(variants[one.row] for one in sure.rivals))),
            best=float(sure.best[row]),
            good=sure.good,
            feasible=feasible,
            means=means,
        )

    def draw(self, generator: np.random.Generator, replicates: int) -> list[int]:
        """Seeds of a master seed, as many of each workload case as its first replicates have."""
        return [int(generator.choice(np.flatnonzero(self.cases == case))) for case in self.cases[:replicates]]


def _some(one: Alternative, picks: Sequence[int]) -> Alternative:
    samples = {measure: tuple(row[pick] for pick in picks) for measure, row in one.samples.items()}
    measures = dict(one.measures)
    for measure, row in samples.items():
        known = [value for value in row if value is not None]
        measures[measure] = sum(known) / len(known) if known else None
    return Alternative(variant=one.variant, measures=measures, samples=samples)


def read_pool(folder: Path, study: str, size: int) -> Pool:
    """The trade-off over the first seeds of a study that are in its evidence store."""
    project = load_project(folder, study)
    project = replace(project, study=replace(project.study, replicates=size))
    with EvidenceStore.open(project.evidence, create=False) as store:
        measured = measure_variants(project, store)
    require_complete(measured)
    cases = np.array([str(record.workload) for record in measured[0].records])
    return Pool(project=project, problem=trade_problem(project, measured), cases=cases)


def main() -> int:
    """Read the pool, emulate the master seeds and report the agreement."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study")
    parser.add_argument("--project", type=Path, default=Path())
    parser.add_argument("--pool", type=int, default=64)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--replicates", type=int, default=16)
    parser.add_argument("--disjoint", action="store_true")
    given = parser.parse_args()
    pool = read_pool(given.project.resolve(), given.study, given.pool)
    truth = pool.outcome(range(given.pool), 0)
    if given.disjoint:
        starts = range(0, given.pool - given.replicates + 1, given.replicates)
        picks = [list(range(start, start + given.replicates)) for start in starts]
    else:
        picks = [pool.draw(np.random.default_rng([7, seed]), given.replicates) for seed in range(given.seeds)]
    outcomes = []
    for seed, some in enumerate(picks):
        outcomes.append(pool.outcome(some, seed))
        sys.stderr.write(f"{seed + 1} of {len(picks)}: {outcomes[-1].chosen} {sorted(outcomes[-1].tied)}\n")
    kept = [_same(truth, outcomes), _calibrated(pool, truth, outcomes)]
    return int(not all(kept))


def _same(truth: Outcome, outcomes: Sequence[Outcome]) -> bool:
    out, count = sys.stdout, len(outcomes)
    choices, sets = Counter(one.chosen for one in outcomes), Counter(one.tied for one in outcomes)
    some = [one for one in outcomes if one.chosen is not None]
    contains = sum(truth.chosen in one.tied for one in some)
    common = frozenset.intersection(*(one.tied for one in some))
    out.write(f"the whole pool: chosen {truth.chosen}, tied {sorted(truth.tied)}\n")
    out.write("| of master seeds | number |\n|---|---|\n")
    out.write(f"| all | {count} |\n")
    out.write(f"| the same choice: {_counted(choices)} | {choices.most_common(1)[0][1]} |\n")
    out.write(f"| the same set named as tied; {len(sets)} different | {sets.most_common(1)[0][1]} |\n")
    out.write(f"| something meets every requirement by the estimates | {len(some)} |\n")
    out.write(f"| the pool's choice is in the set named as tied | {contains} |\n")
    out.write(f"in every set: {sorted(common)}; median size {np.median([len(one.tied) for one in some]):g}\n\n")
    out.flush()
    return max(choices.most_common(1)[0][1], sets.most_common(1)[0][1]) >= SAME * count


def _calibrated(pool: Pool, truth: Outcome, outcomes: Sequence[Outcome]) -> bool:
    out = sys.stdout
    table = tabulated(pool.problem.alternatives)
    decision = decide(pool.problem, margin=0.0, seed=pool.project.study.seed)
    kept = {one.variant: one.value for one in decision.ranking}
    best = max(kept.values(), default=0.0)
    margin = pool.project.study.trade_off.practical_margin
    known = np.isin(table.variants, list(kept))

    def share(least: float) -> float:
        good = {variant for variant, value in kept.items() if value >= best - least - 1e-9} or {None}
        return float(np.mean([one.chosen in good for one in outcomes]))

    rows = {
        "the choice is feasible and the best": (float(np.mean([one.best for one in outcomes])), share(0.0)),
        "the choice is feasible and within the margin": (float(np.mean([one.good for one in outcomes])), share(margin)),
        "a design is feasible": (float(np.mean([one.feasible for one in outcomes])), float(known.mean())),
    }
    out.write("| probability that | reported, mean | by the whole pool |\n|---|---|---|\n")
    for name, (reported, true) in rows.items():
        out.write(f"| {name} | {reported:.3f} | {true:.3f} |\n")
    out.write("\n| measure | variants | posterior mean | mean of the pool | mean error | root mean square |\n")
    out.write("|---|---|---|---|---|---|\n")
    for measure in truth.means:
        true = table.column(measure)
        errors = np.array([one.means[measure] - true for one in outcomes])
        out.write(
            f"| {measure} | {len(true)} | {np.nanmean(errors) + np.nanmean(true):.3f} | {np.nanmean(true):.3f} "
            f"| {np.nanmean(errors):+.3f} | {np.sqrt(np.nanmean(errors**2)):.3f} |\n"
        )
    out.write("\n")
    return len(outcomes) < ENOUGH or all(abs(one - other) <= POINTS for one, other in rows.values())


def _counted(choices: Counter[int | None]) -> str:
    return ", ".join(f"{variant} ({number})" for variant, number in choices.most_common())


if __name__ == "__main__":
    sys.exit(main())
