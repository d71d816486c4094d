"""Pager for long pages, such as ``less``."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import TextIO, cast

from rgss.cli.termination import TerminationRequest

_LESS = ("less", "-FRX")
"""Options of ``less``: exit if the page fits the screen, show colours, do not clear the screen."""


class Pager:
    """Pager process."""

    def __init__(self, command: Sequence[str]) -> None:
        """Create a pager that is not started yet.

        Args:
            command: The program and its arguments.
        """
        self._command = tuple(command)
        self._process: subprocess.Popen[str] | None = None

    @classmethod
    def of(cls, environment: Mapping[str, str]) -> Pager | None:
        """The pager that is requested, or `less`; None if there is none, or if it is ``cat`` or empty.

        Args:
            environment: Variables of the process; ``RGSS_PAGER`` comes before ``PAGER``.
        """
        asked = environment.get("RGSS_PAGER", environment.get("PAGER"))
        try:
            command = _LESS if asked is None else tuple(shlex.split(asked))
        except ValueError:
            return None
        if not command or command == ("cat",) or environment.get("TERM") == "dumb" or not shutil.which(command[0]):
            return None
        return cls((*_LESS, *command[1:]) if command[0] == _LESS[0] else command)

    def start(self) -> TextIO:
        """Start the process; returns its input stream."""
        self._process = subprocess.Popen(  # noqa: S603 - the program that the user asks for
            self._command,
            stdin=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
            # In another locale `less` would show the bytes of what is no ASCII.
            env={"LESSCHARSET": "utf-8", **os.environ},
        )
        return cast("TextIO", self._process.stdin)

    def end(self) -> None:
        """Close the input and wait until the pager exits."""
        if self._process is None or self._process.stdin is None:
            return
        # The reader may quit before the end of the page.
        with suppress(BrokenPipeError, ValueError, OSError):
            self._process.stdin.close()
        try:
            while self._process.poll() is None:
                _wait(self._process)
        except TerminationRequest:
            self._process.terminate()
            raise


def _wait(process: subprocess.Popen[str]) -> None:
    """Wait until a pager exits or an interrupt comes, which is meant for it while it has the terminal.

    Raises:
        TerminationRequest: This process is to terminate.
    """
    try:
        process.wait()
    except TerminationRequest:
        raise
    except KeyboardInterrupt:
        return
