"""Progress bar of the films, with an estimate of the remaining time."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rgss.cli.safe_output import errors_are_seen, own_stream
from rgss.cli.terminal import colour_system


@contextmanager
def film_progress(total: int, label: str = "Frames") -> Iterator[Callable[[], None]]:
    """Progress bar on standard error; silent where that is not a terminal.

    Args:
        total: Number of steps.
        label: What is counted.

    Yields:
        Called after each step.
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn(label), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(
        *columns,
        console=Console(file=own_stream(sys.stderr), color_system=colour_system()),
        disable=not errors_are_seen(),
    ) as bar:
        task = bar.add_task(label, total=total)
        yield lambda: bar.advance(task)
