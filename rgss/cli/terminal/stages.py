"""The stage of a long search on standard error."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rgss.cli.safe_output import errors_are_seen, own_stream
from rgss.cli.terminal.styles import colour_system


@contextmanager
def stage_progress(label: str) -> Iterator[Callable[[str], None]]:
    """Line on standard error with the current stage and the elapsed time; silent where that is not a terminal.

    Args:
        label: What is searched or made.

    Yields:
        Called with the name of each stage before it begins.
    """
    from rich.console import Console
    from rich.markup import escape
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
    from rich.table import Column

    columns = (
        SpinnerColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.description}", table_column=Column(no_wrap=True, ratio=1)),
    )
    console = Console(file=own_stream(sys.stderr), color_system=colour_system())
    with Progress(*columns, console=console, transient=True, expand=True, disable=not errors_are_seen()) as progress:
        task = progress.add_task(escape(label))
        yield lambda stage: progress.update(task, description=escape(f"{label}: {stage}"))
