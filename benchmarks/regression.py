"""False-alarm rate and power of the guard of metrics.

Run it from the repository's folder:

- ``python benchmarks/regression.py pool FILE SEEDS [JOBS]``: run the kinematic trials that the
  study guards with so many seeds, and write what they showed to a CSV file.
- ``python benchmarks/regression.py null FILE [RUNS]``: as many comparisons in which nothing
  changed but the seeds: baseline and present are seeds of the file that no other has. Then the
  same with every quantity worse by exactly its margin, where an alarm is false, but only just;
  and worse by more, where it is right.
- ``python benchmarks/regression.py decision STORE [PAIRS] [SEEDS]``: so many pairs of decisions among
  the designs of the guarded decision, each of as many seeds as the guard takes, drawn from a pool of
  SEEDS kinematic trials of each, which are run if the store does not have them: how often one
  is called unstable against the other. Then the same with every search of one design slower.
- ``python benchmarks/regression.py power [RUNS]``: the share of simulated comparisons in which a success rate
  that fell from 0.90 to 0.65, or from 1.00 to 0.75, is found by the guard's whole procedure, beside the power
  that the guard prints, for several numbers of seeds.
- ``python benchmarks/regression.py synthetic [RUNS]``: the same with made-up quantities, normal,
  skewed and mostly zero, of which there are as many as one likes.
- ``python benchmarks/regression.py rare [RUNS]``: how often a made-up quantity is called the same of which a few
  seeds got worse by many margins and the others stayed.
"""

from __future__ import annotations

import csv
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import EvidenceStore, Fidelity, TrialRecord
from rgss.guard.decision import decision_of, explained_by_noise, p_values
from rgss.guard.runs import Records, WatchedTrials, guard_of, subjects_of, watched_trials
from rgss.regression.comparing import WHOLE_TRIAL, Candidate, Comparison, Guard, Outcome, Subject
from rgss.regression.comparing_baselines import decision_changes
from rgss.regression.looking import Settled, settle
from rgss.regression.observing import observed
from rgss.regression.power import powers
from rgss.studies.project import load_project
from rgss.sweep.running import sweep

PLANTED = (2.0, 3.0, 5.0)
"""By how many margins quantities are made worse, each in a run of comparisons of its own."""

Key = tuple[str, str]
Pool = Mapping[Key, Mapping[int, Mapping[int, float | None]]]
"""By metric and phase, by variant and seed, what was observed."""


def main() -> int:
    """Run the command of the arguments; 1 if a stated rate is exceeded."""
    command, *arguments = sys.argv[1:] or ["synthetic"]
    if command == "pool":
        return write_pool(Path(arguments[0]), int(arguments[1]), jobs=int(arguments[2]) if arguments[2:] else 2)
    if command == "null":
        return null(Path(arguments[0]), int(arguments[1]) if arguments[1:] else 200)
    if command == "power":
        return power(int(arguments[0]) if arguments else 1000)
    if command == "decision":
        store, *counts = arguments
        return decision(Path(store), *map(int, counts))
    if command == "rare":
        return rare(int(arguments[0]) if arguments else 200)
    return synthetic(int(arguments[0]) if arguments else 400)


def planning_run() -> tuple[WatchedTrials, Mapping[Key, Guard]]:
    """The run of the reference study that is kinematic, and how its metrics may move."""
    project = load_project(Path())
    guard = guard_of(project)
    run = next(one for one in watched_trials(project, guard) if one.run.fidelity is Fidelity.KINEMATIC)
    return run, {(metric.metric, phase): metric.guard for metric, phase in subjects_of(guard, run.run.id)}


def write_pool(path: Path, seeds: int, *, jobs: int) -> int:
    """Run the trials and write a row for each value."""
    run, guards = planning_run()
    with tempfile.TemporaryDirectory() as folder, EvidenceStore.open(Path(folder) / "evidence.sqlite") as store:
        records = Records(store, lambda specs: sweep(specs, store, jobs=jobs, on_finished=lambda _: None))
        records.fetch([(run, seeds)])
        rows = [
            (metric, phase, variant, seed, observed(record, metric, phase))
            for metric, phase in guards
            for variant, row in records.of(run, seeds).items()
            for seed, record in row.items()
        ]
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(rows)
    sys.stdout.write(f"{len({row[2:4] for row in rows})} trials in {path}" + "\n")
    return 0


def null(path: Path, runs: int) -> int:
    """Compare a run of trials with the same from other seeds."""
    watched, guards = planning_run()
    found = {key: row for key, row in _read(path).items() if _is_known(row)}
    guards = {key: guards[key].for_baseline(_mean(row)) for key, row in found.items()}
    seeds = sorted({seed for row in found.values() for by_seed in row.values() for seed in by_seed})
    run = watched.run
    sys.stdout.write(
        f"{len(found)} metrics of {len(watched.ids)} designs, {len(seeds)} seeds; from {run.replicates} to {run.cap}\n"
    )
    generator = np.random.default_rng(1)

    def drawn(shift: float) -> Settled:
        order = generator.permutation(seeds)[: 2 * run.cap]
        old, new = order[: run.cap], order[run.cap :]

        def candidates(look: int, _: Collection[str] | None) -> list[Candidate]:
            count = run.seeds_at(look)
            return [
                _candidate(key, guards[key], _part(row, old), _shifted(_part(row, new[:count]), guards[key], shift))
                for key, row in found.items()
            ]

        return settle(candidates, looks=run.looks, error_rate=0.05)

    return _told(drawn, runs)


def decision(path: Path, pairs: int = 200, seeds: int = 60) -> int:
    """Decide twice by seeds that have none in common."""
    project = load_project(Path())
    guard = guard_of(project)
    watched = next(one for one in watched_trials(project, guard) if one.run.id == guard.decision)
    watched = replace(watched, project=project.with_fidelity("kinematic"))
    count, generator = watched.run.replicates, np.random.default_rng(1)
    with EvidenceStore.open(path) as store:
        records = Records(store, lambda specs: sweep(specs, store, jobs=2, on_finished=lambda _: None))
        records.fetch([(watched, seeds)])
        found = records.of(watched, seeds)
    slow = decision_of(watched, {v: {s: row[s] for s in list(row)[:count]} for v, row in found.items()}).chosen
    rates = []
    for slower_s in (0.0, 4.0):
        moved = unstable = 0
        for _ in range(pairs):
            order = generator.permutation(list(watched.seeds(seeds)))[: 2 * count]
            old, new = (
                {
                    variant: {place: replace(row[int(seed)], seed=place) for place, seed in enumerate(half, start=1)}
                    for variant, row in found.items()
                }
                for half in (order[:count], order[count:])
            )
            if slower_s:
                new[slow] = {place: _slower(record, slower_s) for place, record in new[slow].items()}
            before, now = decision_of(watched, old), decision_of(watched, new)
            failing, notes = decision_changes(
                before,
                now,
                explained=explained_by_noise(watched, new, before, now),
                by_luck=p_values(watched.project, before, now),
                error_rate=guard.error_rate,
            )
            unstable += bool(failing)
            moved += bool(failing or notes)
        rates.append(unstable / pairs)
        sys.stdout.write(
            f"{count} seeds, each search of variant {slow} slower by {slower_s:g} s: the decision moved in {moved} of "
            f"{pairs} pairs and was unstable in {unstable}\n"
        )
    return int(rates[0] > guard.error_rate + 2.0 * (guard.error_rate * (1 - guard.error_rate) / pairs) ** 0.5)


def _slower(record: TrialRecord, by_s: float) -> TrialRecord:
    """The same trial with each of its searches slower."""
    times = record.metrics["planning_time_s"]
    if not isinstance(times, tuple):
        raise TypeError("planning_time_s is not a row")
    slower = tuple(None if time_s is None else float(time_s) + by_s for time_s in times)
    task_s, searches = record.metrics["task_time_s"], sum(time_s is not None for time_s in times)
    task_s = task_s + searches * by_s if isinstance(task_s, (int, float)) else task_s
    return replace(record, metrics={**record.metrics, "planning_time_s": slower, "task_time_s": task_s})


def synthetic(runs: int) -> int:
    """The same with quantities drawn from known distributions."""
    generator = np.random.default_rng(2)
    shapes: dict[str, Callable[[int], NDArray[np.float64]]] = {
        "normal": lambda count: generator.normal(size=count),
        "exponential": lambda count: generator.exponential(size=count),
        "mostly_zero": lambda count: np.where(generator.random(count) < 0.1, generator.exponential(3.0, count), 0.0),
        "lognormal": lambda count: generator.lognormal(size=count),
    }
    guard = Guard(unit="1", higher_is_better=False, margin=0.5, is_success=False)
    looks, first, cap = 2, 8, 16

    def drawn(shift: float) -> Settled:
        rows = {
            (shape, str(copy)): ({1: dict(enumerate(draw(cap).tolist()))}, {1: dict(enumerate(draw(cap).tolist()))})
            for shape, draw in shapes.items()
            for copy in range(5)
        }

        def candidates(look: int, _: Collection[str] | None) -> list[Candidate]:
            seeds = range(first if look == 1 else cap)
            return [
                _candidate(key, guard, old, _shifted(_part(new, seeds), guard, shift))
                for key, (old, new) in rows.items()
            ]

        return settle(candidates, looks=looks, error_rate=0.05)

    return _told(drawn, runs)


def rare(runs: int) -> int:
    """Change a few seeds by much; 1 if after 64 seeds the metric is called the same more often than is allowed."""
    generator = np.random.default_rng(7)
    guard = Guard(unit="s", higher_is_better=False, margin=1.0, is_success=False)
    rates = [0.0]
    for share, margins in ((0.05, 24.0), (0.1, 15.0), (0.2, 8.0)):
        for first, cap in ((8, 16), (8, 64)):
            outcomes: Counter[str] = Counter()
            for _ in range(runs):
                old = generator.gamma(2.0, 1.0, cap)
                new = old + np.where(generator.random(cap) < share, margins, 1e-6)
                whole = _candidate(("time_s", "lift"), guard, {1: _row(old)}, {1: _row(new)})

                def candidates(
                    look: int,
                    _: Collection[str] | None,
                    one: Candidate = whole,
                    sizes: tuple[int, int] = (first, cap),
                ) -> list[Candidate]:
                    return [replace(one, seeds=tuple(range(sizes[look - 1])))]

                settled = settle(candidates, looks=2, error_rate=0.05)
                outcomes[settled.comparisons[whole.subject].outcome.value] += 1
            rates += [outcomes["same"] / runs] if cap == 64 else []
            shares = ", ".join(f"{name} {count / runs:.1%}" for name, count in sorted(outcomes.items()))
            sys.stdout.write(f"{share:.0%} of the seeds worse by {margins:g} margins, {first} and {cap}: {shares}\n")
    return int(max(rates) > 0.05 + 2.0 * (0.05 * 0.95 / runs) ** 0.5)


def _row(values: NDArray[np.float64]) -> dict[int, float | None]:
    return dict(enumerate(values.tolist()))


def power(runs: int = 1000) -> int:
    """Find a loss of success in drawn trials; 1 if the printed power is not what is found.

    Two runs with the success of the trial and of eight phases each, as the reference study has them; the phases
    are drawn too, so that they take their part of the error rate. Each seed of the baseline and of now is drawn
    anew, or, in the second row of each, a share of the baseline's successes is lost.
    """
    generator = np.random.default_rng(5)
    success = Guard(unit="1", higher_is_better=True, margin=0.25, is_success=True)
    worst = 0.0
    for before in (0.90, 1.00):
        for first, cap in ((4, 12), (8, 16), (8, 40), (8, 64)):
            for anew in (True, False):
                found = 0
                for _ in range(runs):
                    old = generator.random(cap) < before
                    new = generator.random(cap) < before - 0.25
                    new = new if anew else old & (generator.random(cap) < 1.0 - 0.25 / before)
                    other = [generator.random((2, cap)) < 0.9 for _ in range(17)]

                    def candidates(
                        look: int,
                        _: Collection[str] | None,
                        rows: Sequence[NDArray[np.bool_]] = ((old, new), *other),  # type: ignore[assignment]
                        sizes: tuple[int, int] = (first, cap),
                    ) -> list[Candidate]:
                        return [_of_success(place, *row, success, sizes[look - 1]) for place, row in enumerate(rows)]

                    settled = settle(candidates, looks=2, error_rate=0.05)
                    found += next(iter(settled.comparisons.values())).outcome is Outcome.WORSE
                exact = np.where(np.arange(1000) < round(1000 * before), 1.0, 0.0)
                printed = [_of_success(place, exact, exact, success, 1000) for place in range(18)]
                stated = next(iter(powers(printed, {"pool": [first, cap]}, error_rate=0.05).values()))
                worst = max(worst, stated.probability - found / runs)
                sys.stdout.write(
                    f"success from {before:.2f} to {before - 0.25:.2f}, {'drawn anew' if anew else 'successes lost'}, "
                    f"{first} and {cap} seeds: found in {found / runs:.1%}, printed at least {stated.probability:.1%}, "
                    f"seeds for 80 %: {stated.seeds_needed}" + "\n"
                )
    return int(worst > 4.0 * (0.25 / runs) ** 0.5)


def _of_success(place: int, old: NDArray[np.generic], new: NDArray[np.generic], guard: Guard, count: int) -> Candidate:
    """A comparison of success over the first seeds: place 0 and 1 of whole trials, the others of phases."""
    phase = WHOLE_TRIAL if place < 2 else "lift"
    return Candidate(
        subject=Subject(run="pool", metric=f"success {place}", phase=phase),
        guard=guard,
        baseline={1: dict(enumerate(map(float, old[:count])))},
        current={1: dict(enumerate(map(float, new[:count])))},
        seeds=tuple(range(count)),
        identical=False,
    )


def _told(drawn: Callable[[float], Settled], runs: int) -> int:
    """Print how often there was an alarm; 1 if false ones exceed 5 %."""
    rates = {}
    for shift in (0.0, 1.0, *PLANTED):
        alarms, outcomes, compared = 0, Counter[str](), 0
        for _ in range(runs):
            comparisons = _changed(drawn(shift), everything=shift == 0.0)
            outcomes.update(one.outcome.value for one in comparisons)
            alarms += any(one.outcome in (Outcome.WORSE, Outcome.BETTER, Outcome.MOVED) for one in comparisons)
            compared += len(comparisons)
        rates[shift] = alarms / runs
        shares = ", ".join(f"{name} {count / compared:.1%}" for name, count in sorted(outcomes.items()))
        sys.stdout.write(f"worse by {shift:g} margins: {alarms} of {runs} runs with an alarm; metrics: {shares}" + "\n")
    return int(rates[0.0] > 0.05 or rates[1.0] > 0.05 + 2.0 * (0.05 * 0.95 / runs) ** 0.5)


def _changed(settled: Settled, *, everything: bool) -> list[Comparison]:
    """The comparisons that were shifted: all but successes."""
    return [one for one in settled.comparisons.values() if everything or not one.guard.is_success]


def _candidate(
    key: Key,
    guard: Guard,
    old: Mapping[int, Mapping[int, float | None]],
    new: Mapping[int, Mapping[int, float | None]],
) -> Candidate:
    return Candidate(
        subject=Subject(run="pool", metric=key[0], phase=key[1]),
        guard=guard,
        baseline=old,
        current=new,
        seeds=tuple(range(len(next(iter(new.values()))))),
        identical=False,
    )


def _part(row: Mapping[int, Mapping[int, float | None]], seeds: Sequence[int]) -> dict[int, dict[int, float | None]]:
    """Some seeds of a row, numbered from 0, so that they pair with any others."""
    return {variant: {place: by_seed[seed] for place, seed in enumerate(seeds)} for variant, by_seed in row.items()}


def _shifted(
    row: Mapping[int, Mapping[int, float | None]], guard: Guard, margins: float
) -> dict[int, dict[int, float | None]]:
    by = 0.0 if guard.is_success else margins * guard.margin * (-1.0 if guard.higher_is_better else 1.0)
    return {
        variant: {seed: None if value is None else value + by for seed, value in by_seed.items()}
        for variant, by_seed in row.items()
    }


def _is_known(row: Mapping[int, Mapping[int, float | None]]) -> bool:
    return any(value is not None for by_seed in row.values() for value in by_seed.values())


def _mean(row: Mapping[int, Mapping[int, float | None]]) -> float:
    return float(np.mean([value for by_seed in row.values() for value in by_seed.values() if value is not None]))


def _read(path: Path) -> Pool:
    found: dict[Key, dict[int, dict[int, float | None]]] = {}
    with path.open(encoding="utf-8", newline="") as file:
        for metric, phase, variant, seed, value in csv.reader(file):
            row = found.setdefault((metric, phase), {}).setdefault(int(variant), {})
            row[int(seed)] = float(value) if value else None
    return found


if __name__ == "__main__":
    sys.exit(main())
