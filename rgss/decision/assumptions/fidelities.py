"""Comparison of the evidence of two fidelities: failures in motion, and the designs that only the lower one admits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from rgss.assessment import IN_COMMON, VariantMeasures
from rgss.decision.choosing import trade_problem
from rgss.evidence import Failure, TrialRecord
from rgss.studies import Project
from rgss.tradeoff.programs import AdditiveValue, enumerate_alternatives, single_values


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionFailures:
    """Trials of a study that fail in motion; earlier failures are the same at every fidelity.

    Attributes:
        trials: Number of all trials of the study.
        by_kind: Number of trials by the kind of failure, the most frequent first.
        of_choice: Number of those of the study's choice.
    """

    trials: int
    by_kind: Mapping[Failure, int] = field(hash=False)
    of_choice: int

    @property
    def count(self) -> int:
        """Number of trials that fail in motion."""
        return sum(self.by_kind.values())


@dataclass(frozen=True, slots=True, kw_only=True)
class AdmittedDesigns:
    """Designs that meet every requirement by the estimates of the alternative fidelity only.

    Attributes:
        count: Their number.
        best: The one of the highest value.
        gain: Its value less that of the study's choice, both at the alternative fidelity.
        measure: The measure in which it loses most against the choice; None if it loses in none.
        loss: What it loses by that measure, in value.
    """

    count: int
    best: int
    gain: float
    measure: str | None
    loss: float


def motion_failures(measured: Sequence[VariantMeasures], chosen: int | None) -> MotionFailures:
    """The failures in motion of a study's trials.

    Args:
        measured: Every variant with its records.
        chosen: The study's choice.
    """
    failed = [(entry.variant.id, one.failure) for entry in measured for one in entry.records if _is_in_motion(one)]
    counts = Counter(kind for _, kind in failed if kind is not None)
    return MotionFailures(
        trials=sum(len(entry.records) for entry in measured),
        by_kind=dict(sorted(counts.items(), key=lambda one: (-one[1], one[0].value))),
        of_choice=sum(variant == chosen for variant, _ in failed),
    )


def admitted_designs(
    project: Project,
    measured: Sequence[VariantMeasures],
    other_project: Project,
    others: Sequence[VariantMeasures],
    chosen: int | None,
) -> AdmittedDesigns | None:
    """The designs that only the alternative fidelity admits; None if there are none, or without a weighted value.

    Args:
        project: The project of the study.
        measured: Every variant with the study's evidence.
        other_project: The project at the alternative fidelity.
        others: Every variant with the evidence of that fidelity.
        chosen: The study's choice.
    """
    problem = trade_problem(other_project, others)
    if chosen is None or not isinstance(problem.program, AdditiveValue):
        return None
    here, there = enumerate_alternatives(trade_problem(project, measured)), enumerate_alternatives(problem)
    feasible_here = set(here.table.variants[here.feasible].tolist())
    rows = [
        row for row in np.flatnonzero(there.feasible).tolist() if int(there.table.variants[row]) not in feasible_here
    ]
    if not rows:
        return None
    measures = problem.weighting.deciding_measures
    worths = single_values(problem, there.table) * [problem.weighting.weights[measure] for measure in measures]
    best = max(rows, key=lambda row: (float(worths[row].sum()), -row))
    gains = worths[best] - worths[there.table.row_of(chosen)]
    least = int(gains.argmin())
    return AdmittedDesigns(
        count=len(rows),
        best=int(there.table.variants[best]),
        gain=float(gains.sum()),
        measure=measures[least] if gains[least] < 0.0 else None,
        loss=max(0.0, -float(gains[least])),
    )


def _is_in_motion(record: TrialRecord) -> bool:
    return record.failure is not None and record.failure not in IN_COMMON
