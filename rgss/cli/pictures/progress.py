"""Progress bar of the films, with an estimate of the remaining time."""

from __future__ import annotations

import itertools
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from rgss.cli.safe_output import errors_are_seen, own_stream
from rgss.cli.terminal import RemainingTime, colour_system


@contextmanager
def film_progress(
    total: int, label: str = "Frames", *, clock: Callable[[], float] = time.monotonic
) -> Iterator[Callable[[], None]]:
    """Progress bar on standard error; silent where that is not a terminal.

    Args:
        total: Number of steps.
        label: What is counted.
        clock: Time in s from any beginning.

    Yields:
        Called after each step.
    """
    with film_parts_progress(total, label, clock=clock) as reach:
        steps = itertools.count(1)
        yield lambda: reach(next(steps))


@contextmanager
def film_parts_progress(
    total: int, label: str, *, clock: Callable[[], float] = time.monotonic
) -> Iterator[Callable[[float], None]]:
    """Progress bar on standard error of steps that are done in parts, which count in the estimate.

    Args:
        total: Number of steps.
        label: What is counted.
        clock: Time in s from any beginning.

    Yields:
        Called with the number of steps that are done, such as 1.25.
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    left = RemainingTime(total=total, begun_s=clock())
    with Progress(
        TextColumn(label),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[left]}"),
        console=Console(file=own_stream(sys.stderr), color_system=colour_system()),
        disable=not errors_are_seen(),
        get_time=clock,
    ) as bar:
        task = bar.add_task(label, total=total, left=left.in_words)

        def reach(done: float) -> None:
            nonlocal left
            left = replace(left, done=done, reached_s=clock())
            # A sum of parts may be a little less than the step.
            bar.update(task, completed=round(done, 6), left=left.in_words)

        yield reach
