"""Durations of tasks: guessed at first, then learnt from those that have ended.

The guesses decide the order of the work and the remaining time that is shown, never a result.
"""

from __future__ import annotations

from rgss.evidence import PieceKind
from rgss.trials.pieces import Task, TrialTask

TaskClass = tuple[str, str, float]
"""Tasks that take about the same time: what they make, the planner, the tool speed."""

_TIMING_S = 0.05
_MOTION_M = 0.3
_BENCH_S = 0.4
_WEIGHT_OF_GUESS = 1.0
_SEARCH_S = {"RRT": 0.1, "TRRT": 0.2, "STRIDE": 1.0}
_OTHER_SEARCH_S = 0.2


class Durations:
    """The mean time of each class of tasks."""

    def __init__(self) -> None:
        """Begin with guesses."""
        self._sums: dict[TaskClass, tuple[float, float]] = {}

    def class_of(self, task: Task) -> TaskClass:
        """Features of a task that decide its duration."""
        spec = task.spec
        if isinstance(task, TrialTask):
            return "trial", spec.planner, spec.tool_speed_m_s
        if task.kind is PieceKind.PLAN:
            return task.kind.value, spec.planner, 0.0
        if task.kind is PieceKind.BENCH:
            return task.kind.value, "", 0.0
        return task.kind.value, "", spec.tool_speed_m_s

    def expected_s(self, tasks: TaskClass) -> float:
        """The time that a task of a class is expected to take."""
        sum_s, weight = self._sums.get(tasks, (_WEIGHT_OF_GUESS * _guess_s(tasks), _WEIGHT_OF_GUESS))
        return sum_s / weight

    def learn(self, tasks: TaskClass, took_s: float) -> None:
        """Record the duration of a task.

        Args:
            tasks: Its class.
            took_s: Its time by the wall clock.
        """
        sum_s, weight = self._sums.get(tasks, (_WEIGHT_OF_GUESS * _guess_s(tasks), _WEIGHT_OF_GUESS))
        self._sums[tasks] = (sum_s + took_s, weight + 1.0)


def _guess_s(tasks: TaskClass) -> float:
    what, planner, speed_m_s = tasks
    search_s = _SEARCH_S.get(planner, _OTHER_SEARCH_S) if planner else 0.0
    motion_s = _MOTION_M / speed_m_s if speed_m_s > 0.0 else 0.0
    return {
        PieceKind.PLAN.value: search_s,
        PieceKind.TIMING.value: _TIMING_S,
        PieceKind.EXECUTION.value: motion_s,
        PieceKind.BENCH.value: _BENCH_S,
    }.get(what, search_s + _TIMING_S + motion_s + _BENCH_S)
