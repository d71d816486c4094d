"""Console of rich for pages."""

from __future__ import annotations

from rich.console import Console


class PageConsole(Console):
    """Console whose output pipe may be closed before the end of a page."""

    def on_broken_pipe(self) -> None:
        """Raise the error that the command line handles; rich would exit with a failure."""
        raise BrokenPipeError
