"""Carrying out tasks in this process, one at a time: nothing to start, and nothing isolated."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rgss.sweep.task_end import Ended, ended_by
from rgss.sweep.worker_process import answer_to


class InlineWorkers:
    """The one worker that this process is itself."""

    size = 1

    def __init__(self, function: Callable[..., Any]) -> None:
        """Prepare to work.

        Args:
            function: Function that makes a result from a task's arguments.
        """
        self._function = function
        self._ended: list[Ended] = []

    @property
    def free(self) -> int:
        """Number of tasks that can be begun now."""
        return 1 - len(self._ended)

    def prepare_for(self, tasks: int) -> None:
        """There is one worker, whatever the demand."""

    def begin(self, key: str, arguments: tuple[Any, ...]) -> None:
        """Carry out a task, from its beginning to its end.

        Args:
            key: A name for it.
            arguments: Arguments of the function.
        """
        self._ended.append(ended_by(answer_to(self._function, arguments), key))

    def wait(self, timeout_s: float) -> list[Ended]:  # noqa: ARG002 - there is nothing to wait for
        """Tasks that have ended."""
        ended, self._ended = self._ended, []
        return ended

    def close(self) -> None:
        """Nothing is being done."""
