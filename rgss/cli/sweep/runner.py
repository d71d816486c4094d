"""One sweep of a verb with its progress, and the tally of its trials."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rgss.cli.sweep.backend import ExecutionBackend
from rgss.cli.sweep.output import lost_line
from rgss.cli.sweep.progress import SweepProgress

if TYPE_CHECKING:
    from rgss.evidence import EvidenceStore
    from rgss.studies import Project
    from rgss.sweep import FinishedTrial, LostTrials, SweepResult
    from rgss.trials.pieces import TrialSpec


@dataclass(frozen=True, slots=True)
class TrialTally:
    """Counts of the trials of a sweep, filled while it runs.

    Attributes:
        counts: Numbers that were ``run`` and ``kept``, ``succeeded`` and ``failed``.
        failures: Number of trials by kind and phase of failure.
    """

    counts: Counter[str] = field(default_factory=Counter)
    failures: Counter[str] = field(default_factory=Counter)

    def add(self, trial: FinishedTrial) -> None:
        """Count a trial."""
        record = trial.record
        self.counts["run" if trial.fresh else "kept"] += 1
        self.counts["succeeded" if record.success else "failed"] += 1
        if record.failure is not None and record.failed_phase is not None:
            self.failures[f"{record.failure.value} at {record.failed_phase}"] += 1


@dataclass(frozen=True, slots=True, kw_only=True)
class FinishedSweep:
    """Outcome of one sweep.

    Attributes:
        trials: Number of its trials.
        tally: Their counts.
        result: The pieces and the failures of the run.
    """

    trials: int
    tally: TrialTally
    result: SweepResult


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepRunner:
    """Runner of a verb's sweeps, each with its progress.

    Attributes:
        project: The project with its study.
        store: The evidence.
        backend: The processes or the cluster that carry out the tasks.
        share: True if trials share pieces.
    """

    project: Project
    store: EvidenceStore
    backend: ExecutionBackend
    share: bool

    @classmethod
    def of(
        cls, options: argparse.Namespace, project: Project, store: EvidenceStore, backend: ExecutionBackend
    ) -> SweepRunner:
        """The runner for a verb's options."""
        return cls(project=project, store=store, backend=backend, share=not options.no_share)

    def run(self, specs: Sequence[TrialSpec]) -> FinishedSweep:
        """Run the trials that have no evidence yet."""
        from rgss.sweep import sweep

        tally = TrialTally()
        with SweepProgress(len(specs)) as progress:

            def on_finished(trial: FinishedTrial) -> None:
                tally.add(trial)
                progress.finished(tally.counts)

            result = sweep(
                specs,
                self.store,
                jobs=self.backend.jobs,
                on_finished=on_finished,
                on_state=progress.state,
                share=self.share,
                origin=lambda: self.backend.origin(self.project.folder, self.project.study.label),
                workers_for=self.backend.workers,
            )
        return FinishedSweep(trials=len(specs), tally=tally, result=result)


def report_lost(lost: Iterable[LostTrials]) -> None:
    """Print the failures of a run to standard error, a line each.

    Args:
        lost: The tasks that failed, with the trials that have no record for it.
    """
    for each in lost:
        print(f"rgss: {lost_line(each)}", file=sys.stderr)
