"""How often a study that replicates until decided chooses, and names, the same under other master seeds.

    rgss sweep STUDY --replicates 8
    rgss sweep STUDY --only 7-9,16-18,43-45,52-54 --replicates 96
    python benchmarks/repeated_sweeps.py STUDY --seeds 200
    python benchmarks/repeated_sweeps.py STUDY --seeds 1000 --equal 32 64 128       equal seeds, no looks

Nothing is simulated: the trials are those of the project's evidence store, the study's seed and the next ones. Each
repetition draws the seeds of its replicates from the pool with replacement, each workload case by its own, and goes
through the looks of the very rule that `rgss sweep` follows, to its budget. Designs that never are candidates may have
fewer trials than others: a replicate whose seed they lack is another one of theirs, the same for all that lack it.
What all trials say is taken for the truth. It ends with 1 if fewer than 95 % agree, or if a probability is off by more
than 3 points in at least 200 repetitions.
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

from rgss.assessment import VariantMeasures, measure_variants
from rgss.decision import trial_twins
from rgss.decision.choosing import proportion_measures, trade_problem
from rgss.decision.level_structure import level_numbers
from rgss.evidence import EvidenceStore
from rgss.studies import Project, load_project
from rgss.tradeoff import Alternative, TradeProblem, decide
from rgss.tradeoff.problem import tabulated
from rgss.tradeoff.programs import enumerate_alternatives, single_values
from rgss.tradeoff.robustness import PosteriorOutcomes, choice_uncertainty
from rgss.tradeoff.sequential import Decided, Progress, SequentialEvidence, SequentialRule, next_batch_with_reserve

SAME = 0.95
POINTS = 0.03
ENOUGH = 200


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """Outcome of one repetition.

    Attributes:
        chosen: The variant that is chosen; None if none meets every requirement by the estimates.
        tied: The variants that are named as tied with it, itself among them.
        equal: Those of them that are within the practical margin by their estimates, itself among them.
        good: Reported probability that it is feasible and within the practical margin of the best.
        feasible: Reported probability that the choice is feasible.
        best: Reported probability that it is feasible and the best.
        trials: Trials of all variants.
        most: Most replicates of a variant.
    """

    chosen: int | None
    tied: frozenset[int]
    equal: frozenset[int]
    good: float
    feasible: float
    best: float
    trials: int
    most: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Pool:
    """The trade-off over all trials of the pool.

    Attributes:
        project: The project.
        problem: The trade-off, whose samples are in the order of the seeds.
        required: The same with thresholds as they are required, without the tolerance of the choice.
        twins: By variant, the first one whose trials are the same whatever the seed.
        counts: The number of trials of each variant.
        cases: The workload case of each seed.
        levels: The level of each variant in each factor.
    """

    project: Project
    problem: TradeProblem
    required: TradeProblem
    twins: Mapping[int, int]
    counts: Mapping[int, int]
    cases: NDArray[np.str_]
    levels: NDArray[np.intp] | None

    def sweep(self, seed: int, rule: SequentialRule) -> Outcome:
        """One repetition of the sweep, and the decision from its trials."""
        picks = self._picks(np.random.default_rng([7, seed]), rule.cap)
        wanted = dict.fromkeys(self.counts, rule.pilot)
        proportions, trade_off = proportion_measures(self.project), self.project.study.trade_off
        progress = Progress()
        while True:
            evidence = SequentialEvidence.of(
                self._problem(self.required, picks, wanted),
                proportions,
                twins=self.twins,
                levels=self.levels,
                tolerance=trade_off.tolerance,
                last_of_equals=trade_off.last_of_equals,
            )
            answer = next_batch_with_reserve(evidence, rule, progress, seed=seed)
            progress = answer.progress
            if isinstance(answer, Decided):
                return self.outcome(self._problem(self.problem, picks, wanted), wanted, seed)
            wanted = {**wanted, **answer.replicates}

    def outcome(self, problem: TradeProblem, wanted: Mapping[int, int], seed: int) -> Outcome:
        """The decision from some trials, as `rgss trade` states it."""
        project = self.project
        margin = project.study.trade_off.practical_margin
        last = project.study.trade_off.last_of_equals
        decision = decide(problem, margin=margin, last_of_equals=last, seed=project.study.seed, resamples=0)
        table = tabulated(problem.alternatives)
        variants = table.variants.tolist()
        found = PosteriorOutcomes.of(
            problem,
            table,
            proportion_measures(project),
            generator=np.random.default_rng(seed),
            levels=self.levels,
        )
        size = {"trials": sum(wanted.values()), "most": max(wanted.values())}
        if decision.chosen is None:
            none = float((~found.outcomes.feasible.any(axis=1)).mean())
            empty: frozenset[int] = frozenset()
            return Outcome(chosen=None, tied=empty, equal=empty, good=none, feasible=none, best=none, **size)
        row = table.row_of(decision.chosen)
        sure = choice_uncertainty(
            found,
            row,
            margin=margin,
            replicates=np.array([wanted[variant] for variant in variants]),
            estimated=np.isin(variants, [one.variant for one in decision.ranking]),
            single=single_values(problem, table),
        )
        return Outcome(
            chosen=decision.chosen,
            tied=frozenset((decision.chosen, *(variants[one.row] for one in sure.rivals))),
            equal=frozenset((decision.chosen, *(variants[one.row] for one in sure.rivals if one.within_margin))),
            good=sure.good,
            feasible=float(sure.feasible[row]),
            best=float(sure.best[row]),
            **size,
        )

    def by_equal_seeds(self, count: int, seed: int, *, last: bool) -> int | None:
        """The choice of the designs with most trials by equal seeds: what no allocation of so many can do better.

        Args:
            count: The number of seeds.
            seed: The repetition.
            last: Whether the last of equals is chosen; the first otherwise.
        """
        most = max(self.counts.values())
        picks = self._picks(np.random.default_rng([7, seed]), count)[most]
        problem = replace(
            self.problem,
            alternatives=tuple(
                _some(one, picks) for one in self.problem.alternatives if self.counts[one.variant] == most
            ),
        )
        tied = enumerate_alternatives(problem).tied
        variants = [one.variant for one, is_tied in zip(problem.alternatives, tied, strict=True) if is_tied]
        return (max(variants) if last else min(variants)) if variants else None

    def _picks(self, generator: np.random.Generator, cap: int) -> dict[int, list[int]]:
        """By number of trials in the pool, the seeds of the replicates of the variants that have so many."""
        sizes = sorted(set(self.counts.values()), reverse=True)
        cases = self.cases[np.arange(cap) % len(self.cases)]
        picks: dict[int, list[int]] = {size: [] for size in sizes}
        for case in cases:
            drawn: int | None = None
            for size in sizes:
                if drawn is None or drawn >= size:
                    drawn = int(generator.choice(np.flatnonzero(self.cases[:size] == case)))
                picks[size].append(drawn)
        return picks

    def _problem(
        self, whole: TradeProblem, picks: Mapping[int, Sequence[int]], wanted: Mapping[int, int]
    ) -> TradeProblem:
        some = (_some(one, picks[self.counts[one.variant]][: wanted[one.variant]]) for one in whole.alternatives)
        return replace(whole, alternatives=tuple(some))


def _some(one: Alternative, picks: Sequence[int]) -> Alternative:
    samples = {measure: tuple(row[pick] for pick in picks) for measure, row in one.samples.items()}
    measures = dict(one.measures)
    for measure, row in samples.items():
        known = [value for value in row if value is not None]
        measures[measure] = sum(known) / len(known) if known else None
    return Alternative(variant=one.variant, measures=measures, samples=samples)


def read_pool(folder: Path, study: str, most: int) -> Pool:
    """The trade-off over the trials of a study that are in its evidence store, at most so many of a variant."""
    project = load_project(folder, study)
    pilot, rule = project.study.replicates, project.study.until_decided
    project = replace(project, study=replace(project.study, until_decided=replace(rule, cap=most, budget=most * 10**6)))
    with EvidenceStore.open(project.evidence, create=False) as store:
        measured = measure_variants(project, store)
    longest: VariantMeasures = max(measured, key=lambda one: len(one.records))
    if min(len(one.records) for one in measured) < pilot:
        raise SystemExit("the pool lacks trials of the pilot: run 'rgss sweep' with at least its replicates")
    return Pool(
        project=project,
        problem=trade_problem(project, measured),
        required=trade_problem(project, measured, tolerant=False),
        twins=trial_twins(project, project.designs.expand()),
        counts={one.variant.id: len(one.records) for one in measured},
        cases=np.array([str(record.workload) for record in longest.records]),
        levels=level_numbers(project.designs, sorted(one.variant.id for one in measured)),
    )


def main() -> int:
    """Read the pool, repeat the sweep and say what is the same."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study")
    parser.add_argument("--project", type=Path, default=Path())
    parser.add_argument("--most", type=int, default=512, help="trials of a variant that are read")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="the first repetition")
    parser.add_argument("--budget", type=int)
    parser.add_argument("--cap", type=int)
    parser.add_argument("--batch", type=int)
    parser.add_argument("--equal", type=int, nargs="*", help="instead, decide by so many seeds of all that have most")
    given = parser.parse_args()
    rule = load_project(given.project.resolve(), given.study).study.until_decided
    changed = {name: getattr(given, name) for name in ("budget", "cap", "batch") if getattr(given, name)}
    if given.budget:
        changed["reserve"] = None
    rule = replace(rule, **changed)
    pool = read_pool(given.project.resolve(), given.study, given.most)
    if given.equal:
        return _equal_seeds(pool, given.equal, given.seeds)
    truth = pool.outcome(pool.problem, pool.counts, 0)
    outcomes = []
    for seed in range(given.first, given.first + given.seeds):
        outcomes.append(pool.sweep(seed, rule))
        one = outcomes[-1]
        sys.stderr.write(
            f"{seed + 1} of {given.seeds}: {one.chosen} {sorted(one.tied)} within the margin {sorted(one.equal)}"
            f" good {one.good:.2f} feasible {one.feasible:.2f} most {one.most} of {one.trials}\n"
        )
        sys.stderr.flush()
    kept = [_same(truth, outcomes), _calibrated(pool, outcomes)]
    return int(not all(kept))


def _equal_seeds(pool: Pool, counts: Sequence[int], repetitions: int) -> int:
    out = sys.stdout
    out.write("| seeds of each | of equals the first | of equals the last |\n|---|---|---|\n")
    for count in counts:
        cells = []
        for last in (False, True):
            found = Counter(pool.by_equal_seeds(count, seed, last=last) for seed in range(repetitions))
            cells.append(", ".join(f"{one} ({100 * often / repetitions:.0f} %)" for one, often in found.most_common(5)))
        out.write(f"| {count} | {' | '.join(cells)} |\n")
        out.flush()
    return 0


def _same(truth: Outcome, outcomes: Sequence[Outcome]) -> bool:
    out, count = sys.stdout, len(outcomes)
    choices, sets = Counter(one.chosen for one in outcomes), Counter(one.tied for one in outcomes)
    equals = Counter(one.equal for one in outcomes)
    contains = sum(truth.chosen in one.tied for one in outcomes)
    out.write(f"the whole pool: chosen {truth.chosen}, tied {sorted(truth.tied)}, within {sorted(truth.equal)}\n")
    out.write("| of repetitions | number |\n|---|---|\n")
    out.write(f"| all | {count} |\n")
    out.write(f"| the same choice: {', '.join(f'{one} ({n})' for one, n in choices.most_common())} ")
    out.write(f"| {choices.most_common(1)[0][1]} |\n")
    for name, counted in (("named as tied", sets), ("within the practical margin", equals)):
        members, often = counted.most_common(1)[0]
        out.write(f"| the same set {name}, {sorted(members)}; {len(counted)} different | {often} |\n")
    out.write(f"| the pool's choice is in the set named as tied | {contains} |\n")
    out.write(f"mean trials {np.mean([one.trials for one in outcomes]):.0f}\n\n")
    out.flush()
    return max(choices.most_common(1)[0][1], sets.most_common(1)[0][1]) >= SAME * count


def _calibrated(pool: Pool, outcomes: Sequence[Outcome]) -> bool:
    out = sys.stdout
    decision = decide(pool.problem, margin=0.0, seed=pool.project.study.seed, resamples=0)
    kept = {one.variant: one.value for one in decision.ranking if one.value is not None}
    best = max(kept.values(), default=0.0)
    margin = pool.project.study.trade_off.practical_margin

    def share(least: float) -> float:
        good: set[int | None] = {variant for variant, value in kept.items() if value >= best - least - 1e-9}
        good = good or {None}
        return float(np.mean([one.chosen in good for one in outcomes]))

    rows = {
        "the choice is feasible": (float(np.mean([one.feasible for one in outcomes])), share(1.0)),
        "the choice is feasible and the best": (float(np.mean([one.best for one in outcomes])), share(0.0)),
        "the choice is feasible and within the margin": (float(np.mean([one.good for one in outcomes])), share(margin)),
    }
    out.write("| probability that | reported, mean | by the whole pool |\n|---|---|---|\n")
    for name, (reported, true) in rows.items():
        out.write(f"| {name} | {reported:.3f} | {true:.3f} |\n")
    out.write("\n")
    return len(outcomes) < ENOUGH or all(abs(one - other) <= POINTS for one, other in rows.values())


if __name__ == "__main__":
    sys.exit(main())
