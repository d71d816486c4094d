"""Console of rich for pages."""

from __future__ import annotations

from rich.console import Console


class PageConsole(Console):
    """A console whose reader may leave before the end of a page."""

    def on_broken_pipe(self) -> None:
        """Let the command line end as it does for any reader that leaves; rich would end the process as failed."""
        raise BrokenPipeError
