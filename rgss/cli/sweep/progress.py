"""Progress of a running sweep on standard error."""

from __future__ import annotations

import sys
from collections import Counter
from types import TracebackType
from typing import TYPE_CHECKING, Any

from rgss.cli.safe_output import errors_are_seen, own_stream
from rgss.cli.terminal import ESTIMATING, colour_system, left_in_words

if TYPE_CHECKING:
    from rgss.sweep import SweepState


class SweepProgress:
    """A bar with rate, remaining time, outcomes and pieces; silent where standard error is not a terminal."""

    def __init__(self, total: int) -> None:
        """Prepare the bar.

        Args:
            total: How many trials there are.
        """
        self._total = total
        self._fresh = 0
        self._progress: Any = None
        self._task: Any = None

    def __enter__(self) -> SweepProgress:
        if not errors_are_seen():
            return self
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn
        from rich.table import Column

        self._progress = Progress(
            TextColumn("Trials"),
            BarColumn(bar_width=12),
            MofNCompleteColumn(table_column=Column(no_wrap=True)),
            TextColumn("{task.fields[outcomes]}"),
            # In a narrow terminal the end of this text is cut, not the numbers before it.
            TextColumn("{task.fields[course]}", table_column=Column(no_wrap=True, ratio=1)),
            expand=True,
            console=Console(file=own_stream(sys.stderr), color_system=colour_system()),
        )
        self._progress.start()
        self._task = self._progress.add_task("trials", total=self._total, outcomes="", course=ESTIMATING)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._progress is not None:
            self._progress.stop()

    def finished(self, tally: Counter[str]) -> None:
        """Update the counts after another trial has its record.

        Args:
            tally: How many were ``run`` and ``kept``, ``succeeded`` and ``failed``.
        """
        self._fresh = tally["run"]
        if self._progress is not None:
            outcomes = f"{tally['succeeded']} succeeded, {tally['failed']} failed"
            self._progress.update(self._task, completed=tally["run"] + tally["kept"], outcomes=outcomes)

    def state(self, state: SweepState) -> None:
        """Update rate, remaining time and pieces."""
        if self._progress is not None:
            self._progress.update(self._task, course=course_of(state, fresh=self._fresh))


def course_of(state: SweepState, *, fresh: int) -> str:
    """Rate, remaining time and pieces as one line.

    Args:
        state: State of the sweep.
        fresh: Number of trials that were run in it.
    """
    parts = []
    if fresh and state.elapsed_s > 0.0:
        parts.append(f"{fresh / state.elapsed_s:.1f}/s")
    if state.remaining_s is not None and state.tasks_left:
        parts.append(left_in_words(state.remaining_s))
    elif state.tasks_left:
        parts.append(ESTIMATING)
    made, reused = sum(state.made.values()), sum(state.reused.values())
    parts.append(f"{made} made, {state.tasks_left} to make" + (f", {reused} from evidence" if reused else ""))
    if state.saved:
        parts.append(f"{state.saved} shared")
    return "; ".join(parts)
