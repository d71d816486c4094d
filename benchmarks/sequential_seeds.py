"""How often a sweep until decided comes to the same choice, and names the same as tied, under other master seeds.

    rgss sweep STUDY --only 7-9,16-18,43-45,52-54 --replicates 160
    rgss sweep STUDY --replicates 8
    python benchmarks/sequential_seeds.py STUDY --runs 200 [--budget 960 --cap 128 --batch 8]

Nothing is simulated: the trials are those of the project's evidence store. Each run is the very sweep: the pilot, the
looks of `rgss.tradeoff.sequential.next_batch` and the decision that `rgss trade` makes at the end. Its seeds are drawn
from the pool with replacement, each workload case by its own, the same for every variant as far as a variant has them;
a variant with a smaller pool draws from that. What the whole pool says is taken for the truth.
It ends with 1 if fewer than 19 of 20 agree, or if a reported probability is off by more than 3 points.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.assessment import measure_variants
from rgss.decision.choosing import proportion_measures, trade_problem
from rgss.decision.level_structure import level_numbers
from rgss.evidence import EvidenceStore
from rgss.studies import Project, load_project
from rgss.tradeoff import Alternative, TradeProblem
from rgss.tradeoff.problem import tabulated
from rgss.tradeoff.programs import enumerate_alternatives, single_values
from rgss.tradeoff.robustness import PosteriorOutcomes, choice_uncertainty
from rgss.tradeoff.sequential import Decided, Progress, SequentialEvidence, SequentialRule, next_batch

SAME = 0.95
POINTS = 0.03
Picks = NDArray[np.intp]


@dataclass(frozen=True, kw_only=True)
class Run:
    """What one emulated sweep came to.

    Attributes:
        chosen: The choice; None if nothing meets every requirement by the estimates.
        tied: What is named as tied with it, itself among them.
        best: Reported probability that it is feasible and the best.
        good: Reported probability that it is feasible and within the practical margin of the best.
        feasible: Reported probability that it is feasible.
        trials: Trials of all variants.
        most: Replicates of the choice.
    """

    chosen: int | None
    tied: frozenset[int]
    best: float
    good: float
    feasible: float
    trials: int
    most: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Pool:
    """The trials that are there, each variant's in the order of its seeds.

    Attributes:
        project: The project.
        problem: The trade-off over all of them.
        required: The same with thresholds that have no tolerance.
        cases: The workload case of each seed.
        sizes: The number of seeds of each variant.
        levels: The level of each variant in each factor of its design.
    """

    project: Project
    problem: TradeProblem
    required: TradeProblem
    cases: NDArray[np.str_]
    sizes: Mapping[int, int]
    levels: NDArray[np.intp] | None

    @staticmethod
    def read(folder: Path, study: str, most: int) -> Pool:
        """The stored trials of a study, at most so many of a variant."""
        project = load_project(folder, study)
        rule = replace(project.study.until_decided, cap=most)
        with EvidenceStore.open(project.evidence, create=False) as store:
            measured = measure_variants(
                replace(project, study=replace(project.study, until_decided=rule, is_sequential=True)), store
            )
        longest = max(measured, key=lambda one: len(one.records))
        return Pool(
            project=project,
            problem=trade_problem(project, measured),
            required=trade_problem(project, measured, tolerant=False),
            cases=np.array([str(record.workload) for record in longest.records]),
            sizes={one.variant.id: len(one.records) for one in measured},
            levels=level_numbers(project.designs, [one.variant.id for one in measured]),
        )

    def sequences(self, generator: np.random.Generator, count: int) -> Mapping[int, Picks]:
        """The seeds of one master seed, by size of a variant's pool."""
        places = generator.random(count)
        pattern = [self.cases[place % len(self.cases)] for place in range(count)]
        found = {}
        for size in sorted(set(self.sizes.values())):
            own = {case: np.flatnonzero(self.cases[:size] == case) for case in set(pattern)}
            found[size] = np.array(
                [own[case][int(part * len(own[case]))] for case, part in zip(pattern, places, strict=True)]
            )
        return found

    def posed(self, whole: TradeProblem, picks: Mapping[int, Picks], wanted: Mapping[int, int]) -> TradeProblem:
        """A trade-off over the whole pool from some of the seeds of each variant."""
        chosen = {one.variant: picks[self.sizes[one.variant]][: wanted[one.variant]] for one in whole.alternatives}
        return replace(whole, alternatives=tuple(_some(one, chosen[one.variant]) for one in whole.alternatives))


def _some(one: Alternative, picks: Sequence[int] | Picks) -> Alternative:
    samples = {measure: tuple(row[pick] for pick in picks) for measure, row in one.samples.items()}
    measures = dict(one.measures)
    for measure, row in samples.items():
        known = [value for value in row if value is not None]
        measures[measure] = sum(known) / len(known) if known else None
    return Alternative(variant=one.variant, measures=measures, samples=samples)


def emulate(pool: Pool, rule: SequentialRule, seed: int) -> Run:
    """One sweep until decided, and its decision."""
    proportions, trade_off = proportion_measures(pool.project), pool.project.study.trade_off
    picks = pool.sequences(np.random.default_rng([11, seed]), rule.cap)
    wanted = dict.fromkeys(pool.sizes, rule.pilot)
    progress = Progress()
    while True:
        evidence = SequentialEvidence.of(
            pool.posed(pool.required, picks, wanted),
            proportions,
            levels=pool.levels,
            tolerance=trade_off.tolerance,
            last_of_equals=trade_off.last_of_equals,
        )
        answer = next_batch(evidence, rule, progress)
        progress = answer.progress
        if isinstance(answer, Decided):
            break
        wanted.update(answer.replicates)
    return outcome(pool, pool.posed(pool.problem, picks, wanted), wanted, seed)


def outcome(pool: Pool, problem: TradeProblem, wanted: Mapping[int, int], seed: int) -> Run:
    """What the analysis of a decision says of it."""
    table, margin = tabulated(problem.alternatives), pool.project.study.trade_off.practical_margin
    enumeration = enumerate_alternatives(problem)
    found = PosteriorOutcomes.of(
        problem,
        table,
        proportion_measures(pool.project),
        generator=np.random.default_rng(seed),
        levels=pool.levels,
    )
    trials = sum(wanted.values())
    if not enumeration.tied.any():
        none = float((~found.outcomes.feasible.any(axis=1)).mean())
        return Run(chosen=None, tied=frozenset(), best=none, good=none, feasible=0.0, trials=trials, most=0)
    last = pool.project.study.trade_off.last_of_equals
    row = int(np.flatnonzero(enumeration.tied)[-1 if last else 0])
    variants = table.variants.tolist()
    sure = choice_uncertainty(
        found,
        row,
        margin=margin,
        replicates=np.array([wanted[variant] for variant in variants]),
        estimated=enumeration.feasible,
        single=single_values(problem, table),
    )
    return Run(
        chosen=variants[row],
        tied=frozenset((variants[row], *(variants[one.row] for one in sure.rivals))),
        best=float(sure.best[row]),
        good=sure.good,
        feasible=float(sure.feasible[row]),
        trials=trials,
        most=wanted[variants[row]],
    )


def main() -> int:
    """Read the pool, emulate the sweeps and say what is the same."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study")
    parser.add_argument("--project", type=Path, default=Path())
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--most", type=int, default=1000, help="most seeds of a variant that are read")
    for name in ("pilot", "batch", "cap", "budget"):
        parser.add_argument(f"--{name}", type=int)
    parser.add_argument("--margin", type=float)
    parser.add_argument("--finalists", type=int)
    given = parser.parse_args()
    pool = Pool.read(given.project.resolve(), given.study, given.most)
    names = ("pilot", "batch", "cap", "budget", "margin", "finalists")
    stated = {name: getattr(given, name) for name in names if getattr(given, name) is not None}
    rule = replace(pool.project.study.until_decided, **stated)
    runs = []
    for seed in range(given.runs):
        runs.append(emulate(pool, rule, seed))
        one = runs[-1]
        sys.stderr.write(f"{seed + 1}: {one.chosen} {sorted(one.tied)} {one.trials} {one.most} {one.good:.2f}\n")
    return int(not _reported(pool, rule, runs))


def _reported(pool: Pool, rule: SequentialRule, runs: Sequence[Run]) -> bool:
    out, count = sys.stdout, len(runs)
    table = tabulated(pool.problem.alternatives)
    enumeration = enumerate_alternatives(pool.problem)
    single = single_values(pool.problem, table)
    weights = np.array([pool.problem.weighting.weights[name] for name in pool.problem.weighting.deciding_measures])
    worth = np.where(enumeration.feasible, single @ weights, -np.inf)
    variants = table.variants
    margin = pool.project.study.trade_off.practical_margin

    def good(least: float) -> set[int | None]:
        return {*variants[worth >= worth.max() - least - 1e-9].tolist()} if np.isfinite(worth).any() else {None}

    feasible = set(variants[enumeration.feasible].tolist())
    choices, sets = Counter(one.chosen for one in runs), Counter(one.tied for one in runs)
    out.write(f"rule: pilot {rule.pilot}, batch {rule.batch}, cap {rule.cap}, budget {rule.budget}\n")
    out.write(f"the whole pool: best {sorted(good(0.0), key=str)}, within {margin:g} {sorted(good(margin), key=str)}, ")
    out.write(f"feasible {sorted(feasible)}\n| of {count} master seeds | number |\n|---|---|\n")
    for name, found in (("choice", choices), ("set named as tied", sets)):
        often = ", ".join(
            f"{sorted(each) if isinstance(each, frozenset) else each} ({number})"
            for each, number in found.most_common(6)
        )
        out.write(f"| the same {name}; {len(found)} different: {often} | {found.most_common(1)[0][1]} |\n")
    some = [one for one in runs if one.chosen is not None]
    inside = sum(good(0.0) <= one.tied for one in some)
    out.write(f"| the pool's best are in the set, of {len(some)} | {inside} |\n\n")
    kept = max(choices.most_common(1)[0][1], sets.most_common(1)[0][1]) >= SAME * count
    out.write("| probability that the choice is | reported, mean | by the whole pool |\n|---|---|---|\n")
    for name, told, true in (
        ("feasible and the best", [one.best for one in runs], [one.chosen in good(0.0) for one in runs]),
        ("feasible and within the margin", [one.good for one in runs], [one.chosen in good(margin) for one in runs]),
        ("feasible", [one.feasible for one in some], [one.chosen in feasible for one in some]),
    ):
        out.write(f"| {name} | {np.mean(told):.3f} | {np.mean(true):.3f} |\n")
        kept &= abs(float(np.mean(told)) - float(np.mean(true))) <= POINTS
    trials, replicates = [one.trials for one in runs], [one.most for one in runs]
    most = float(np.median(np.array(replicates)))
    out.write(f"\ntrials {np.mean(trials):.0f}, replicates of the choice {most:g} in the median\n")
    return kept


if __name__ == "__main__":
    sys.exit(main())
