"""Baselines of the metrics and the decision of a study."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence import EvidenceStore
from rgss.guard.decision import decision_of
from rgss.guard.inputs import BASELINE_SUFFIX, inputs_of_trials, origin_of_trials, shared_inputs
from rgss.guard.runs import (
    Records,
    RunTrials,
    WatchedTrials,
    fingerprints_of,
    guard_of,
    series_of,
    subjects_of,
    watched_trials,
)
from rgss.guard.schema import one_line_reason, record_schema, units_of
from rgss.regression import Baseline, BaselineRun, Change, Inputs
from rgss.studies import Project, RegressionGuard
from rgss.trials import PHASE_METRICS


def baseline_name(label: str) -> str:
    """File name of the baseline of a study, in the same folder."""
    return Path(label).with_suffix(BASELINE_SUFFIX).as_posix()


def make_baseline(
    project: Project, store: EvidenceStore, run_trials: RunTrials, *, before: Baseline | None, reason: str
) -> Baseline:
    """Make a baseline of the present state: every run at its cap, so that each look has its pairs.

    Args:
        project: The project with its study.
        store: The evidence.
        run_trials: Function that runs missing trials.
        before: The replaced baseline, whose history is continued; None if it is the first.
        reason: The reason, in one line.

    Raises:
        DefinitionError: The study guards nothing, there is no reason, or a named phase observes
            nothing.
        EvidenceError: A trial could not be run.
    """
    guard = guard_of(project)
    words = one_line_reason(reason)
    if not words:
        raise DefinitionError("--update needs a reason", hint="state with --reason why the numbers change")
    watched = watched_trials(project, guard)
    records = Records(store, run_trials)
    records.fetch([(trials, trials.run.cap) for trials in watched])
    for trials in watched:
        lost = records.lost(trials, trials.run.cap)
        if lost:
            variant, seed = lost[0]
            raise EvidenceError(
                f"{len(lost)} trials of run {trials.run.id} could not be run, the first of variant {variant} "
                f"with seed {seed}",
                hint="a baseline needs all of them",
            )
    origin = origin_of_trials(project, records.provenances())
    inputs = inputs_of_trials(watched)
    shared = shared_inputs(inputs)
    decision = None
    if guard.decision is not None:
        trials = next(one for one in watched if one.run.id == guard.decision)
        decision = decision_of(trials, records.of(trials, trials.run.replicates))
    history = () if before is None else before.history
    return Baseline(
        study=project.study.id,
        units=units_of(guard),
        record=record_schema(project),
        phase_record={name: metric.unit for name, metric in PHASE_METRICS.items()},
        runs={trials.run.id: _baseline_run(guard, trials, records, inputs, shared) for trials in watched},
        decision=decision,
        origin=origin,
        history=(*history, Change(reason=words, revision=origin.revision)),
        inputs=shared,
    )


def _baseline_run(
    guard: RegressionGuard, trials: WatchedTrials, records: Records, inputs: Inputs, shared: Mapping[str, str]
) -> BaselineRun:
    rows = records.of(trials, trials.run.cap)
    values: dict[str, dict[str, dict[str, tuple[float | None, ...]]]] = {}
    for metric, phase in subjects_of(guard, trials.run.id):
        series = series_of(rows, metric.metric, phase)
        if all(value is None for row in series.values() for value in row.values()):
            if metric.wherever:
                continue
            raise DefinitionError(
                f"run {trials.run.id} observes no {metric.metric} at {phase}",
                hint="guard it in another run or phase; with 'phases: all' only those that observe it count",
            )
        by_variant = {str(variant): tuple(row.values()) for variant, row in series.items()}
        values.setdefault(metric.metric, {})[phase] = by_variant
    return BaselineRun(
        fidelity=trials.run.fidelity.value,
        seeds=trials.seeds(trials.run.cap),
        values=values,
        fingerprints={str(variant): tuple(row.values()) for variant, row in fingerprints_of(rows).items()},
        inputs={
            str(variant): {name: value for name, value in values.items() if name not in shared}
            for variant, values in inputs[trials.run.id].items()
        },
        designs={str(variant.id): dict(variant.levels) for variant in trials.variants},
        first_look=trials.run.replicates,
    )
