"""Error rate of replication until decided, and its cost compared with 200 fixed replicates.

Run it from the repository's folder:

- ``python benchmarks/until_decided.py synthetic [RUNS]``: made-up variants whose truth is known.
- ``python benchmarks/until_decided.py calibration [RUNS]``: how often a choice after 30 replicates
  is good, beside the probability that is reported of it.
- ``python benchmarks/until_decided.py pool FILE SEEDS``: run the reference study's kinematic trials
  that differ, and write what they showed to a CSV file.
- ``python benchmarks/until_decided.py study FILE [SEEDS]``: decide the reference study for as many
  master seeds, each with 200 replicates drawn with replacement from the file.
"""

from __future__ import annotations

import csv
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.designs import sources
from rgss.measures.evaluation import design_values
from rgss.studies.project import Project, load_project
from rgss.tradeoff import Alternative, Comparison, PiecewiseValue, Threshold, TradeProblem, Weighting
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.probability import probability_of_good_selection
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.sequential import Decided, Reason, next_batch
from rgss.tradeoff.sequential.settling import Progress
from rgss.trials.trial_spec import TrialSpec

FIXED = 200
Rows = Mapping[int, Mapping[str, NDArray[np.float64]]]


def main() -> int:
    """Run the command of the arguments; 1 if a stated rate is exceeded."""
    command, *arguments = sys.argv[1:] or ["synthetic"]
    if command == "synthetic":
        return synthetic(int(arguments[0]) if arguments else 500)
    if command == "calibration":
        return calibration(int(arguments[0]) if arguments else 2000)
    if command == "pool":
        return pool(Path(arguments[0]), int(arguments[1]))
    return study(Path(arguments[0]), int(arguments[1]) if len(arguments) > 1 else 20)


def until_decided(template: TradeProblem, rows: Rows, rule: SequentialRule) -> tuple[Decided, dict[int, int], float]:
    """Replicate from rows that are there already: the answer, the replicates of each, and the probability."""
    wanted = {alternative.variant: rule.pilot for alternative in template.alternatives}
    progress = Progress()
    while True:
        evidence = SequentialEvidence.of(problem_of(template, rows, wanted), {"S"})
        answer = next_batch(evidence, rule, progress)
        progress = answer.progress
        if isinstance(answer, Decided):
            break
        wanted.update(answer.replicates)
    probability = probability_of_good_selection(evidence, answer.variant, margin=rule.margin, seed=1)
    return answer, wanted, probability


def problem_of(template: TradeProblem, rows: Rows, wanted: Mapping[int, int]) -> TradeProblem:
    """The trade-off with the first replicates of each alternative."""
    alternatives = []
    for one in template.alternatives:
        part = {measure: row[: wanted[one.variant]] for measure, row in rows[one.variant].items()}
        known = {measure: row[~np.isnan(row)] for measure, row in part.items()}
        estimates = {measure: float(row.mean()) if len(row) else None for measure, row in known.items()}
        samples = {
            measure: tuple(None if np.isnan(each) else each for each in row.tolist()) for measure, row in part.items()
        }
        alternatives.append(Alternative(variant=one.variant, measures={**one.measures, **estimates}, samples=samples))
    return TradeProblem(
        alternatives=tuple(alternatives),
        thresholds=template.thresholds,
        value_functions=template.value_functions,
        weighting=template.weighting,
    )


def synthetic(runs: int) -> int:
    """Simulate made-up variants: a table of how often the rule errs."""
    out = sys.stdout
    out.write(
        "| case | runs | decided | wrong of decided | wrong of all | verdicts | wrong | probability | good | trials |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n"
    )
    exceeded = False
    for case in CASES:
        counts = np.zeros(7)
        probabilities = []
        for run in range(runs):
            counts += one_run(case, run, probabilities)
        decided, wrong_decided, wrong, verdicts, wrong_verdicts, good, trials = counts.tolist()
        exceeded |= wrong_decided / runs > 0.05 or wrong_verdicts / max(verdicts, 1) > 0.05
        out.write(
            f"| {case} | {runs} | {decided:.0f} | {wrong_decided:.0f} | {wrong:.0f} | {verdicts:.0f} | "
            f"{wrong_verdicts:.0f} | {np.mean(probabilities):.3f} | {good / runs:.3f} | {trials / runs:.0f} |\n"
        )
        out.flush()
    return int(exceeded)


# Fixed worth, probability of success and mean time of each variant: a best one with a clear lead;
# rivals just below the margin; better ones that fail too often, one of them just so; exact ties; and
# planning limits, which share every trial, so that only the few differ in which the limit binds.
CASES: Mapping[str, tuple[tuple[float, float, float], ...]] = {
    "clear": (
        (0.6, 0.97, 10.0),
        (0.4, 0.97, 11.0),
        (0.3, 0.95, 9.0),
        (0.5, 0.6, 10.0),
        (0.2, 0.99, 10.0),
        (0.1, 0.3, 12.0),
    ),
    "near": ((0.5, 0.99, 10.0), *[(0.38, 0.99, 10.0)] * 5),
    "infeasible": (
        (0.4, 0.98, 10.0),
        (0.7, 0.80, 10.0),
        (0.7, 0.80, 9.0),
        (0.7, 0.75, 10.0),
        (0.2, 0.98, 10.0),
        (0.1, 0.98, 12.0),
    ),
    "tied": (*[(0.5, 0.97, 10.0)] * 3, (0.2, 0.97, 10.0), (0.2, 0.5, 10.0), (0.1, 0.97, 12.0)),
    "limits": (*[(0.5, chance, 10.0) for chance in (0.96, 0.965, 0.97)], *[(0.45, 0.97, 11.0)] * 2),
    "limits beyond": (*[(0.5, chance, 10.0) for chance in (0.92, 0.925, 0.98)], *[(0.45, 0.93, 11.0)] * 2),
}
SPREAD = 0.4
RULE = SequentialRule(batch=24, cap=400, verdict_cap=104)


def one_run(case: str, run: int, probabilities: list[float]) -> NDArray[np.float64]:
    """One run: decided, wrong and decided, wrong, verdicts, wrong verdicts, good, trials.

    Times are lognormal about their mean, skewed as planning times are; success follows from a
    uniform number that variants share in one half of the seeds, and limits in all, with their times.
    """
    truth = CASES[case]
    generator = np.random.default_rng([run, len(case)])
    shared = generator.random(RULE.cap)
    rows = {}
    noise = generator.standard_normal(RULE.cap)
    for variant, (_, chance, mean) in enumerate(truth, start=1):
        own = shared
        if not case.startswith("limits"):
            own = np.where(generator.random(RULE.cap) < 0.5, shared, generator.random(RULE.cap))
            noise = generator.standard_normal(RULE.cap)
        success = own < chance
        time = mean * np.exp(SPREAD * noise - SPREAD**2 / 2.0)
        rows[variant] = {"S": success.astype(float), "t": np.where(success, time, np.nan)}
    template = made_up(truth)
    answer, wanted, probability = until_decided(template, rows, RULE)
    values = [0.6 * w + 0.2 * max(0.0, (s - 0.8) / 0.2) + 0.2 * (25.0 - t) / 20.0 for w, s, t in truth]
    feasible = [s >= 0.9 and t <= 11.5 for _, s, t in truth]
    best = max(value for value, there in zip(values, feasible, strict=True) if there)
    good = acceptable = False
    if answer.variant is not None:
        _, chance, time = truth[answer.variant - 1]
        near = values[answer.variant - 1] >= best - RULE.margin
        good = near and feasible[answer.variant - 1]
        slack = RULE.slack
        acceptable = near and chance >= 0.9 * (1.0 - slack) and time <= 11.5 * (1.0 + slack)
    told = wrong = 0
    for (variant, place), met in answer.progress.settled.items():
        _, chance, time = truth[variant - 1]
        truly = {"R-S": chance >= 0.9, "R-t": time <= 11.5}
        told += 1
        wrong += met != truly[template.thresholds[place].requirement]
    decided = answer.reason is Reason.DECIDED
    probabilities.append(probability)
    return np.array(
        [decided, decided and not acceptable, not acceptable, told, wrong, good, sum(wanted.values())], dtype=float
    )


def made_up(truth: Sequence[tuple[float, float, float]]) -> TradeProblem:
    """The trade-off of made-up variants: worth, success, time."""
    return TradeProblem(
        alternatives=tuple(
            Alternative(variant=variant, measures={"worth": worth, "S": 1.0, "t": 1.0})
            for variant, (worth, _, _) in enumerate(truth, start=1)
        ),
        thresholds=(
            Threshold(requirement="R-S", measure="S", comparison=Comparison.AT_LEAST, value=0.9, unit="1"),
            Threshold(requirement="R-t", measure="t", comparison=Comparison.AT_MOST, value=11.5, unit="s"),
        ),
        value_functions=(
            PiecewiseValue(measure="worth", worst=0.0, best=1.0),
            PiecewiseValue(measure="S", worst=0.8, best=1.0),
            PiecewiseValue(measure="t", worst=25.0, best=5.0),
        ),
        weighting=Weighting(weights={"worth": 0.6, "S": 0.2, "t": 0.2}),
    )


def calibration(runs: int) -> int:
    """Compare the reported probability of good selection with how often the selection is good."""
    bins: dict[int, list[tuple[float, bool]]] = {}
    for run in range(runs):
        generator = np.random.default_rng([run, 99])
        truth = tuple(
            (generator.uniform(0.4, 0.6), generator.uniform(0.8, 1.0), generator.uniform(9.0, 11.0)) for _ in range(5)
        )
        rows = {}
        for variant, (_, chance, mean) in enumerate(truth, start=1):
            success = generator.random(30) < chance
            time = mean * np.exp(SPREAD * generator.standard_normal(30) - SPREAD**2 / 2.0)
            rows[variant] = {"S": success.astype(float), "t": np.where(success, time, np.nan)}
        evidence = SequentialEvidence.of(problem_of(made_up(truth), rows, dict.fromkeys(rows, 30)), {"S"})
        feasible = np.where(evidence.feasible, evidence.values, -np.inf)
        chosen = int(evidence.table.variants[feasible.argmax()]) if evidence.feasible.any() else None
        probability = probability_of_good_selection(evidence, chosen, margin=0.02, seed=run, draws=500)
        good = chosen in good_choices(truth, 0.02)
        bins.setdefault(min(int(probability * 5), 4), []).append((probability, good))
    out = sys.stdout
    out.write("| reported | runs | mean reported | good |\n|---|---|---|---|\n")
    for place, found in sorted(bins.items()):
        reported, good = np.array(found, dtype=float).mean(axis=0)
        out.write(f"| {place / 5:.1f} to {(place + 1) / 5:.1f} | {len(found)} | {reported:.3f} | {good:.3f} |\n")
    return 0


def good_choices(truth: Sequence[tuple[float, float, float]], margin: float) -> set[int | None]:
    """The feasible variants within a margin of the best; None alone where there is none."""
    values = {
        variant: 0.6 * worth + 0.2 * max(0.0, (chance - 0.8) / 0.2) + 0.2 * (25.0 - time) / 20.0
        for variant, (worth, chance, time) in enumerate(truth, start=1)
        if chance >= 0.9 and time <= 11.5
    }
    return {variant for variant, value in values.items() if value >= max(values.values()) - margin} or {None}


def trial_class(spec: TrialSpec) -> tuple[int, str, float]:
    """Inputs of a kinematic trial beside its seed and its tool speed: fingers, planner, planning limit."""
    return spec.gripper.geometry.fingers, spec.planner, spec.planning_limit_s


def pool(file: Path, seeds: int) -> int:
    """Run one variant of each class, at the higher speed, and write success, planning time and length."""
    from rgss.evidence import EvidenceStore
    from rgss.studies.expansion import trial_specs
    from rgss.sweep.results import FinishedTrial
    from rgss.sweep.running import sweep

    project = load_project(Path(), "studies/nominal_world.yaml").with_fidelity("kinematic")
    specs = trial_specs(project, seeds=range(1, seeds + 1))
    fastest = max(spec.tool_speed_m_s for spec in specs)
    chosen = {(trial_class(spec), spec.seed): spec for spec in specs if spec.tool_speed_m_s == fastest}
    class_of = {spec.variant: which for (which, _), spec in chosen.items()}
    with tempfile.TemporaryDirectory() as folder, file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(("fingers", "planner", "limit_s", "seed", "success", "planning_s", "length_m"))

        def write(trial: FinishedTrial) -> None:
            metrics, success = trial.record.metrics, trial.record.success
            sums = [sum(metrics[name]) if success else "" for name in ("planning_time_s", "path_length_m")]  # type: ignore[arg-type]
            writer.writerow((*class_of[trial.record.variant], trial.record.seed, int(success), *sums))

        with EvidenceStore.open(Path(folder) / "evidence.sqlite") as store:
            sweep(tuple(chosen.values()), store, jobs=1, on_finished=write)
    return 0


def study(file: Path, seeds: int) -> int:
    """Decide the reference study again and again; 1 unless it agrees with fixed replication at a quarter."""
    project = load_project(Path(), "studies/nominal_world.yaml").with_fidelity("kinematic")
    observed = _read(file)
    template, classes = _template(project)
    out = sys.stdout
    out.write(
        "| master seed | fixed | until decided | reason | probability | trials | share |\n"
        "|---|---|---|---|---|---|---|\n"
    )
    rule = SequentialRule(cap=FIXED)
    total = agree = same = ended = 0
    for seed in range(1, seeds + 1):
        generator = np.random.default_rng(seed)
        # Planners do not share their random numbers, so that their seeds may be drawn apart.
        draws = {which: generator.integers(0, len(rows), size=FIXED) for which, rows in _by_planner(observed).items()}
        rows = {}
        for variant, (which, speed, stroke_s) in classes.items():
            drawn = observed[which][draws[which[1]]]
            rows[variant] = {
                "S": drawn[:, 0],
                "t_p": drawn[:, 1],
                "t_e": drawn[:, 1] + stroke_s + drawn[:, 2] / speed,
            }
        everything = SequentialEvidence.of(problem_of(template, rows, dict.fromkeys(rows, FIXED)), {"S"})
        values = np.where(everything.feasible, everything.values, -np.inf)
        fixed = int(everything.table.variants[np.flatnonzero(values >= values.max() - 1e-9)[0]])
        answer, wanted, probability = until_decided(template, rows, rule)
        trials = sum(wanted.values())
        loss = values.max() - (-np.inf if answer.variant is None else values[everything.table.row_of(answer.variant)])
        total, agree = total + trials, agree + (loss <= project.study.trade_off.practical_margin + 1e-9)
        same, ended = same + (answer.variant == fixed), ended + (answer.reason is Reason.DECIDED)
        share = trials / (FIXED * len(rows))
        told = (seed, fixed, answer.variant, answer.reason.value, f"{probability:.3f}", trials, f"{share:.3f}")
        out.write("| " + " | ".join(map(str, told)) + " |\n")
        out.flush()
    share = total / (seeds * FIXED * len(classes))
    out.write(
        f"\n{same} of {seeds} choose the same variant, {agree} one that 200 replicates find no worse by the practical "
        f"margin; {ended} decided; {share:.3f} of the trials\n"
    )
    return int(agree < seeds or share > 0.25)


Class = tuple[int, str, float]


def _read(file: Path) -> dict[Class, NDArray[np.float64]]:
    rows: dict[Class, list[tuple[int, float, float, float]]] = {}
    with file.open(newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            which = (int(row["fingers"]), row["planner"], float(row["limit_s"]))
            rows.setdefault(which, []).append(
                (
                    int(row["seed"]),
                    float(row["success"]),
                    float(row["planning_s"] or "nan"),
                    float(row["length_m"] or "nan"),
                )
            )
    return {which: np.array([each[1:] for each in sorted(found)]) for which, found in rows.items()}


def _by_planner(observed: Mapping[Class, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    """The rows that all classes of a planner have."""
    shortest: dict[str, NDArray[np.float64]] = {}
    for (_, planner, _), rows in observed.items():
        if planner not in shortest or len(rows) < len(shortest[planner]):
            shortest[planner] = rows
    return shortest


def _template(project: Project) -> tuple[TradeProblem, dict[int, tuple[Class, float, float]]]:
    """The study's trade-off with what follows from each design, and each variant's class, speed and stroke."""
    from rgss.assessment.measuring import VariantMeasures
    from rgss.decision.choosing import trade_problem
    from rgss.measures import evaluate
    from rgss.studies.expansion import trial_specs

    measured, classes = [], {}
    for variant in project.designs.expand():
        estimates = evaluate(project.measures, fixed=sources(variant), trials=[], variant=variant.id)
        measured.append(
            VariantMeasures(variant=variant, trials=(), records=(), missing=0, estimates=estimates, verdicts={})
        )
        (spec,) = trial_specs(project, variants=(variant,), seeds=(1,))
        design = design_values(project.measures, fixed=sources(variant), variant=variant.id)
        classes[variant.id] = (trial_class(spec), spec.tool_speed_m_s, design["t_gc"])
    return trade_problem(project, measured), classes


if __name__ == "__main__":
    sys.exit(main())
