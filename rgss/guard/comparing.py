"""Comparison of a study's metrics and decision with its baseline."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from rgss.errors import DefinitionError
from rgss.evidence import EvidenceStore, TrialRecord
from rgss.findings import shown
from rgss.guard.decision import as_before, decision_of, explained_by_noise, p_values
from rgss.guard.inputs import inputs_of_trials, origin_of_trials
from rgss.guard.runs import (
    Records,
    RunTrials,
    fingerprints_of,
    guard_of,
    series_of,
    subjects_of,
    watched_trials,
)
from rgss.guard.schema import one_line_reason, record_schema, units_of
from rgss.regression import (
    Baseline,
    Behaviour,
    Candidate,
    ChangedTrial,
    DecisionChanges,
    Failing,
    FailureCause,
    InputChange,
    InputKind,
    Power,
    RegressionReport,
    Subject,
    changed_trials,
    contradictions,
    decision_changes,
    mean_of,
    origin_changes,
    paired_by_levels,
    powers,
    run_failings,
    schema_failings,
    schema_notes,
    settle,
    unchanged_phases,
    value_changes,
)
from rgss.studies import Project, RegressionGuard


def compare_with_baseline(
    project: Project,
    store: EvidenceStore,
    run_trials: RunTrials,
    baseline: Baseline,
    *,
    label: str,
    on_look: Callable[[int, int], None] | None = None,
    accepted: str = "",
) -> RegressionReport:
    """Compare the present state with the baseline, with more seeds while a comparison is inconclusive.

    Args:
        project: The project with its study.
        store: The evidence.
        run_trials: Function that runs missing trials.
        baseline: The baseline.
        label: The name of its file.
        on_look: Callback before each look, with its number and the number of open comparisons.
        accepted: Reason why changed behaviour is accepted in this run; empty if it is not.

    Raises:
        DefinitionError: The study guards nothing, the baseline is of another study, or the reason is too long.
        EvidenceError: The store is damaged.
    """
    guard = guard_of(project)
    if baseline.study != project.study.id:
        raise DefinitionError(
            f"the baseline {label} is of study {shown(baseline.study)}, not of {project.study.id!r}",
            hint="name another with --baseline",
        )
    return _Comparing(project, guard, Records(store, run_trials), baseline, label).run(
        on_look, one_line_reason(accepted)
    )


class _Comparing:
    """State of a running comparison."""

    def __init__(
        self, project: Project, guard: RegressionGuard, records: Records, baseline: Baseline, label: str
    ) -> None:
        self._project = project
        self._guard = guard
        self._records = records
        paired = paired_by_levels(baseline, {one.id: one.levels for one in project.designs.expand()})
        self._paired = paired
        self._baseline = paired.baseline
        self._label = label
        self._watched = watched_trials(project, guard)
        self._phases = project.study.task.phases
        self._seeds = {trials.run.id: 0 for trials in self._watched}
        self._contradictions: dict[Subject, Failing] = {}

    def run(self, on_look: Callable[[int, int], None] | None, accepted: str) -> RegressionReport:
        failing = list(schema_failings(self._baseline, units_of(self._guard)))
        for trials in self._watched:
            failing += run_failings(
                trials.run.id,
                self._baseline.runs.get(trials.run.id),
                fidelity=trials.run.fidelity.value,
                variants=trials.ids,
                seeds=trials.seeds(trials.run.cap),
                first_look=trials.run.replicates,
            )
        for name in sorted(self._baseline.runs.keys() - self._seeds.keys()):
            text = f"run {name} of the baseline is not in the study"
            failing.append(Failing(trouble=FailureCause.FEWER_REPLICATES, text=text))
        failing += self._unguarded()
        settled = settle(
            self._candidates_at,
            looks=max(trials.run.looks for trials in self._watched),
            error_rate=self._guard.error_rate,
            on_look=on_look,
        )
        latest = settled.comparisons
        failing += self._contradictions.values()
        for trials in self._watched:
            for variant, seed in self._records.lost(trials, self._seeds[trials.run.id]):
                text = f"run {trials.run.id}: the trial of variant {variant} with seed {seed} could not be run"
                failing.append(Failing(trouble=FailureCause.NOT_RUN, text=text))
        decision = self._decision()
        inputs = self._changed_inputs()
        return RegressionReport(
            study=self._project.study.label,
            baseline=self._label,
            comparisons=tuple(latest[subject] for subject in sorted(latest, key=self._order)),
            behaviour=self._behaviour(inputs),
            failing=(*failing, *decision.failing),
            undecided=decision.undecided,
            notes=(*self._notes_of_the_baseline(), *decision.notes),
            looks=settled.looks,
            trials=dict(self._seeds),
            error_rate=self._guard.error_rate,
            inputs=inputs,
            powers=self._powers(),
            accepted=accepted,
        )

    def _candidates_at(self, look: int, only: Collection[str] | None) -> list[Candidate]:
        growing = [trials for trials in self._watched if only is None or trials.run.id in only]
        for trials in growing:
            self._seeds[trials.run.id] = trials.run.seeds_at(look)
        self._records.fetch([(trials, self._seeds[trials.run.id]) for trials in growing])
        found = []
        for trials in self._watched:
            before = self._baseline.runs.get(trials.run.id)
            if before is None or before.fidelity != trials.run.fidelity.value:
                continue
            count = self._seeds[trials.run.id]
            seeds = trials.seeds(count)
            records = self._records.of(trials, count)
            same = unchanged_phases(before, self._fingerprints(records), seeds, self._phases)
            for metric, phase in subjects_of(self._guard, trials.run.id):
                baseline = self._values(trials.run.id, metric.metric, phase)
                if baseline is None:
                    continue
                candidate = Candidate(
                    subject=Subject(run=trials.run.id, metric=metric.metric, phase=phase),
                    guard=metric.guard.for_baseline(mean_of(baseline)),
                    baseline=baseline,
                    current=series_of(records, metric.metric, phase),
                    seeds=seeds,
                    identical=phase in same,
                )
                self._contradictions |= contradictions(candidate)
                found.append(candidate)
        return found

    def _fingerprints(self, records: Mapping[int, Mapping[int, TrialRecord]]) -> dict[int, dict[int, str]]:
        return fingerprints_of(records, self._baseline, self._paired.former)

    def _values(self, run: str, metric: str, phase: str) -> dict[int, dict[int, float | None]] | None:
        """The baseline's values by variant and seed; None if it has none."""
        before = self._baseline.runs[run]
        rows = before.values.get(metric, {}).get(phase)
        if rows is None:
            return None
        return {int(variant): dict(zip(before.seeds, row, strict=True)) for variant, row in rows.items()}

    def _powers(self) -> dict[Subject, Power]:
        """Power of each comparison with all seeds of the baseline."""
        candidates = []
        for trials in self._watched:
            if trials.run.id not in self._baseline.runs:
                continue
            for metric, phase in subjects_of(self._guard, trials.run.id):
                values = self._values(trials.run.id, metric.metric, phase)
                if values is not None:
                    candidates.append(
                        Candidate(
                            subject=Subject(run=trials.run.id, metric=metric.metric, phase=phase),
                            guard=metric.guard.for_baseline(mean_of(values)),
                            baseline=values,
                            current={},
                            seeds=(),
                            identical=False,
                        )
                    )
        looks = range(1, 1 + max(trials.run.looks for trials in self._watched))
        seeds_at = {trials.run.id: [trials.run.seeds_at(look) for look in looks] for trials in self._watched}
        return powers(candidates, seeds_at, error_rate=self._guard.error_rate)

    def _unguarded(self) -> list[Failing]:
        """Metrics that only the study or only the baseline has."""
        failing = []
        for trials in self._watched:
            before = self._baseline.runs.get(trials.run.id)
            if before is None:
                continue
            guarded = {(metric.metric, phase): metric for metric, phase in subjects_of(self._guard, trials.run.id)}
            kept = {(metric, phase) for metric, phases in before.values.items() for phase in phases}
            for metric, phase in sorted(kept - guarded.keys()):
                if metric in units_of(self._guard):
                    text = f"run {trials.run.id}: the baseline guards {metric} at {phase}, the study no longer does"
                    failing.append(Failing(trouble=FailureCause.MISSING_METRIC, text=text))
            for (metric, phase), entry in sorted(guarded.items(), key=lambda item: item[0]):
                if (metric, phase) not in kept and not entry.wherever and metric in self._baseline.units:
                    text = f"run {trials.run.id}: the study guards {metric} at {phase}, the baseline does not"
                    failing.append(Failing(trouble=FailureCause.CHANGED_SCHEMA, text=text))
        return failing

    def _changed_inputs(self) -> tuple[InputChange, ...]:
        now = inputs_of_trials(self._watched)
        origin = origin_of_trials(self._project, self._records.provenances())
        changes = (
            *value_changes(self._baseline, now),
            *origin_changes(self._baseline.origin, origin, with_values=self._baseline.has_values),
        )
        return tuple(one for one in changes if one.kind is not InputKind.FILE or one.name != self._label)

    def _notes_of_the_baseline(self) -> list[str]:
        of_schema = schema_notes(self._baseline, record_schema(self._project))
        if self._baseline.has_values:
            return [*self._paired.notes, *of_schema]
        text = "the baseline was written by an earlier rgss and lacks the values of inputs, so that changes of them "
        return [f"{text}are not named; rewrite it with 'rgss regress --update --reason TEXT'", *of_schema]

    def _behaviour(self, inputs: Sequence[InputChange]) -> Behaviour:
        changed: list[ChangedTrial] = []
        compared = 0
        for trials in self._watched:
            before = self._baseline.runs.get(trials.run.id)
            if before is not None:
                count = self._seeds[trials.run.id]
                records = self._records.of(trials, count)
                changed += changed_trials(
                    trials.run.id, before, self._fingerprints(records), trials.seeds(count), self._phases
                )
                compared += sum(len(set(row) & set(before.seeds)) for row in records.values())
        # A file may have changed in parts that no trial reads, which a baseline without values cannot show.
        harmless = {InputKind.MACHINE, *((InputKind.FILE,) if self._baseline.has_values else ())}
        machines = [f"{one.then} → {one.now}" for one in inputs if one.kind is InputKind.MACHINE]
        only_machine = bool(machines) and all(one.kind in harmless for one in inputs)
        return Behaviour(compared=compared, changed=tuple(changed), machine=machines[0] if only_machine else "")

    def _decision(self) -> DecisionChanges:
        before, run = self._baseline.decision, self._guard.decision
        if before is None and run is None:
            return DecisionChanges()
        if before is None or run is None or before.run != run:
            was, is_now = ("none" if one is None else one for one in (before.run if before else None, run))
            text = f"the guarded decision was that of run {was} and is that of run {is_now}"
            return DecisionChanges(failing=(Failing(trouble=FailureCause.CHANGED_SCHEMA, text=text),))
        trials = next(one for one in self._watched if one.run.id == run)
        count = trials.run.replicates
        if self._records.lost(trials, count):
            text = "decision: trials that it needs could not be run"
            return DecisionChanges(failing=(Failing(trouble=FailureCause.NOT_RUN, text=text),))
        records = self._records.of(trials, count)
        now = decision_of(trials, records)
        explained: Mapping[str, float] = {} if now == before else explained_by_noise(trials, records, before, now)
        by_luck = p_values(trials.project, before, now)
        return decision_changes(
            before,
            now,
            explained=explained,
            by_luck=by_luck,
            unmoved=as_before(trials.project, before, now),
            error_rate=self._guard.error_rate,
        )

    def _order(self, subject: Subject) -> tuple[str, str, int]:
        place = self._phases.index(subject.phase) if subject.phase in self._phases else -1
        return subject.run, subject.metric, place
