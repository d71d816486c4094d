"""Bounds on estimates at a higher fidelity, proven by trials of the same designs at kinematic fidelity.

A kinematic trial and its twin at the higher fidelity share plan and timing: a move that finds no path, or cannot be
timed, fails both. All other assumptions of the kinematic model (the grasp holds, nothing slips, the arm follows)
may fail at the higher fidelity. It follows:

- the twin completes at most the phases before a shared failure, and any number of phases if the kinematic
  trial succeeded;
- if the twin succeeds, its planning times, checks and path lengths are the kinematic ones;
- nothing is known of forces, contacts, slip and times of motion.

The successful twins belong to a subset of the successful kinematic trials. So a mean over them lies between the
least and the greatest value over the successful kinematic trials, and a share of successes is at most the
kinematic one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from rgss.assessment.measuring import VariantMeasures
from rgss.assessment.replicates import replicates_of
from rgss.evidence import Failure, TrialRecord
from rgss.measures import Estimate, Estimator, Measure, Population, proportion_estimate
from rgss.studies import Project

_TRIAL = "trial."
_PROGRESS = frozenset({"phases_completed", "phases_total", "success"})
_PLANNED = frozenset({"planning_time_s", "planning_checks", "path_length_m"})
IN_COMMON = frozenset(
    {
        Failure.PLANNING_LIMIT,
        Failure.PATH_NOT_VERIFIED,
        Failure.INVALID_START,
        Failure.INVALID_GOAL,
        Failure.MOVE_BLOCKED,
        Failure.MOVE_UNREACHABLE,
        Failure.UNREACHABLE_WAYPOINT,
        Failure.TRAJECTORY_INFEASIBLE,
        Failure.TRAJECTORY_IN_COLLISION,
    }
)
"""Failures that a trial has at every fidelity and in every engine, since they occur before any motion."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EstimateBounds:
    """Bounds on the estimate of a measure at a higher fidelity.

    Attributes:
        bounded: True if bounds are known.
        estimates: The least and the greatest possible estimate; empty if it cannot have a
            value, such as the time of a task that no trial completes.
    """

    bounded: bool
    estimates: tuple[Estimate, ...] = ()


UNBOUNDED = EstimateBounds(bounded=False)


def bounds_by_measure(project: Project, entry: VariantMeasures) -> Mapping[str, EstimateBounds]:
    """Bounds on every measure of a variant at a higher fidelity, by its id.

    Args:
        project: The project.
        entry: The variant with all its kinematic trials.
    """
    rows = replicates_of(project.measures, entry)
    progress = _values_by_progress(project, entry)
    found = {}
    for measure in project.measures.measures:
        if measure.estimate is None:
            found[measure.id] = EstimateBounds(bounded=True, estimates=(entry.estimates[measure.id],))
            continue
        sources = project.measures.sources(measure.id)
        metrics = {source.removeprefix(_TRIAL) for source in sources if source.startswith(_TRIAL)}
        if measure.estimate.over is Population.SUCCESSFUL and metrics <= _PROGRESS | _PLANNED:
            found[measure.id] = _over_successful(measure, entry.records, rows[measure.id])
        elif measure.estimate.over is Population.ALL and metrics <= _PROGRESS:
            found[measure.id] = _over_all(measure, entry.records, progress)
        else:
            found[measure.id] = UNBOUNDED
    return found


def _over_successful(measure: Measure, records: Sequence[TrialRecord], row: Sequence[float | None]) -> EstimateBounds:
    known = []
    for record, value in zip(records, row, strict=True):
        if record.failure in IN_COMMON:
            continue
        if value is None:
            return UNBOUNDED
        known.append(value)
    if measure.estimate is None or measure.estimate.statistic is not Estimator.MEAN:
        return UNBOUNDED
    ends = dict.fromkeys((min(known), max(known))) if known else {}
    return EstimateBounds(bounded=True, estimates=tuple(Estimate.exact(end, measure.unit) for end in ends))


def _over_all(
    measure: Measure,
    records: Sequence[TrialRecord],
    progress: Sequence[Mapping[str, float | None]],
) -> EstimateBounds:
    if measure.estimate is not None and measure.estimate.statistic is Estimator.RATIO:
        return UNBOUNDED
    least, greatest = [], []
    for record in records:
        most = len(progress) - 1
        if record.failure in IN_COMMON:
            most = min(most, int(record.metrics["phases_completed"] or 0))  # type: ignore[arg-type]
        values = [row[measure.id] for row in progress[: most + 1]]
        known = [value for value in values if value is not None]
        if len(known) < len(values):
            return UNBOUNDED
        least.append(min(known))
        greatest.append(max(known))
    if not records or measure.estimate is None:
        return UNBOUNDED
    if measure.estimate.statistic is Estimator.PROPORTION:
        counts = range(round(sum(least)), round(sum(greatest)) + 1)
        return EstimateBounds(
            bounded=True, estimates=tuple(proportion_estimate(count, len(records)) for count in counts)
        )
    ends = dict.fromkeys((sum(least) / len(records), sum(greatest) / len(records)))
    return EstimateBounds(bounded=True, estimates=tuple(Estimate.exact(end, measure.unit) for end in ends))


def _values_by_progress(project: Project, entry: VariantMeasures) -> list[Mapping[str, float | None]]:
    """The value of every measure after each number of completed phases, from none to all.

    They are valid only for measures whose sole input from trials is the progress.
    """
    if not entry.records:
        return []
    first = entry.records[0]
    total = len(first.phases)
    twins = tuple(
        replace(first, metrics={**first.metrics, "phases_completed": done, "success": int(done == total)})
        for done in range(total + 1)
    )
    rows = replicates_of(project.measures, replace(entry, records=twins))
    return [{name: row[done] for name, row in rows.items()} for done in range(total + 1)]
