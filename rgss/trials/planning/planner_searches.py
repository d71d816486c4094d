"""The searches of a planner for every move of a task, moves after one that finds no path included."""

from __future__ import annotations

from rgss.trials.planning.plan import plan_task
from rgss.trials.planning.planned_moves import TaskPlan
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import cell_of


def searches_of(spec: TrialSpec) -> TaskPlan:
    """The plan of a trial, with the moves that come after one which finds no path.

    All planners are given the same problems, so that they are compared move by move.

    Args:
        spec: The trial.

    Raises:
        MotionError: The planner is not there.
    """
    settings = spec.settings.planning
    return plan_task(cell_of(spec), spec.planned_by, seed=spec.seed, settings=settings, past_failures=True)
