"""Execution of a study's missing trials, by the sweep of the command line."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from numbers import Integral

from rgss.api.argument_terms import whole_argument
from rgss.counted import counted
from rgss.decision import sweep_in_stages
from rgss.designs import DesignVariant
from rgss.errors import DefinitionError, SimulationError
from rgss.evidence import EvidenceStore
from rgss.studies import Project
from rgss.sweep import FinishedTrial, InlineWorkers, LostTrials, Maker, Workers, compute, origin_of, sweep
from rgss.trials.pieces import TrialSpec


def sweep_study(
    project: Project,
    variants: Sequence[DesignVariant],
    *,
    jobs: int | None = None,
    on_trial: Callable[[int, int], None] | None = None,
) -> None:
    """Run every trial of some variants that has no evidence, and record the verdicts.

    Args:
        project: The project with its study.
        variants: The variants.
        jobs: Number of worker processes; with 0 trials are run one by one, and a script needs no guard
            against being imported by workers; one for each core by default.
        on_trial: Called after each trial with the number of stored trials and the number of all.

    Raises:
        DefinitionError: `jobs` is below 0, or a variant cannot be simulated.
        EvidenceError: The store cannot be read or written, or had another result for the same inputs.
        SimulationError: Trials could not be run; the others are stored.
    """
    runner = _runner(project, jobs, on_trial)
    with EvidenceStore.open(project.evidence) as store:
        sweep_in_stages(project, variants, store, lambda specs: runner.run(specs, store))
    runner.require_all()


def variant_terms(only: Sequence[str | int] | str | int) -> list[str]:
    """The terms that name variants, as ``--only`` takes them.

    Args:
        only: One of them, or a list.

    Raises:
        DefinitionError: It is neither.
    """
    if isinstance(only, (str, Integral)):
        return [str(only)]
    if not isinstance(only, Iterable):
        hint = "give ids such as '1,5' or a filter; omit it for all variants"
        raise DefinitionError(f"only must be a term or a list of terms, got {only!r}", hint=hint)
    return [str(term) for term in only]


def run_trials(project: Project, specs: Sequence[TrialSpec], store: EvidenceStore, *, jobs: int | None = None) -> None:
    """Run missing trials of a study or of suppositions.

    Args:
        project: The project.
        specs: The trials.
        store: The evidence.
        jobs: As for `sweep_study`.

    Raises:
        DefinitionError: `jobs` is below 0.
        EvidenceError: The store cannot be read or written.
        SimulationError: Trials could not be run; the others are stored.
    """
    runner = _runner(project, jobs, None)
    runner.run(specs, store)
    runner.require_all()


def _runner(project: Project, jobs: int | None, on_trial: Callable[[int, int], None] | None) -> _Runner:
    if on_trial is not None and not callable(on_trial):
        raise DefinitionError(f"on_trial must be a function of two numbers, got {on_trial!r}", hint="or omit it")
    jobs = None if jobs is None else whole_argument("jobs", jobs, hint="0 runs all trials in one child process")
    if jobs is not None and jobs < 0:
        raise DefinitionError(f"jobs must be at least 0, got {jobs}", hint="0 runs all trials in one child process")
    return _Runner(project, jobs=(os.cpu_count() or 1) if jobs is None else jobs, on_trial=on_trial)


def _one_by_one(maker: Maker) -> Workers:
    """Workers that run one task at a time, without a process that would import the caller's script."""
    return InlineWorkers(partial(compute, maker))


class _Runner:
    """Runner of lists of trials, which collects those that could not be run."""

    def __init__(self, project: Project, *, jobs: int, on_trial: Callable[[int, int], None] | None) -> None:
        self._project = project
        self._jobs = jobs
        self._on_trial = on_trial
        self._lost: list[LostTrials] = []

    def run(self, specs: Sequence[TrialSpec], store: EvidenceStore) -> None:
        """Run the missing trials."""
        done = 0

        def on_finished(_: FinishedTrial) -> None:
            nonlocal done
            done += 1
            if self._on_trial is not None:
                self._on_trial(done, len(specs))

        try:
            result = sweep(
                specs,
                store,
                jobs=self._jobs,
                on_finished=on_finished,
                origin=lambda: origin_of(self._project.folder, self._project.study.label),
                workers_for=None if self._jobs else _one_by_one,
            )
        except SimulationError as error:
            # A worker imports the script that started it, and would start a sweep itself.
            hint = "a script that sweeps with processes needs 'if __name__ == \"__main__\":'; or pass jobs=0"
            raise SimulationError(error.message, hint=hint) from error
        self._lost += result.lost

    def require_all(self) -> None:
        """Raise an error if a trial could not be run."""
        if self._lost:
            trials = sum(len(lost.trials) for lost in self._lost)
            first = self._lost[0].failure
            raise SimulationError(
                f"{counted(trials, 'trial')} could not be run; first failure: {first.what}: {first.kind.value}: "
                f"{first.detail}",
                hint="the others are stored; sweep again to retry these",
            )
