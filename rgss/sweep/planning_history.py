"""The planning of a study's trials as runs of planners, each search once."""

from __future__ import annotations

from rgss.evidence import EvidenceStore, PlanOutcome
from rgss.evidence.records import PlanningRun
from rgss.studies import Project, trial_specs
from rgss.sweep.trial_keys import keys_of
from rgss.trials.code import assume_engines, versions
from rgss.trials.pieces import TrialSpec, digests_of


def planning_runs(project: Project, store: EvidenceStore) -> tuple[PlanningRun, ...]:
    """Read the searches off the evidence of a study.

    Variants that share a search differ in when it was stopped; it is taken as the one with the
    longest limit saw it. A move that was not planned, because one before it failed or the study makes it another
    way, has no run.

    Raises:
        EvidenceError: The store is damaged.
    """
    assume_engines(trial.provenance.versions for trial in store.iterate())
    longest: dict[str, TrialSpec] = {}
    now = versions()
    for spec in trial_specs(project):
        plan = digests_of(spec, now).plan
        if plan not in longest or spec.planning_limit_s > longest[plan].planning_limit_s:
            longest[plan] = spec
    keys = dict(zip(keys_of(tuple(longest.values())), longest.values(), strict=True))
    found = store.records(keys)
    return tuple(
        PlanningRun(
            problem=f"{keys[key].gripper.geometry.id}: {planned.subtask}",
            planner=keys[key].planner,
            seed=record.seed,
            limit_s=keys[key].planning_limit_s,
            outcome=planned.outcome,
            checks=planned.checks,
            simplification_checks=planned.simplification_checks,
            time_s=planned.time_s,
            path_length_m=planned.path_length_m,
        )
        for key, record in found.items()
        for planned in record.planning
        if planned.outcome is not PlanOutcome.NOT_RUN and planned.subtask in keys[key].searched
    )
