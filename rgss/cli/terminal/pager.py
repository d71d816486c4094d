"""Pager: the program through which a long page is read."""

from __future__ import annotations

import shlex
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import TextIO, cast

_LESS = ("less", "-FRX")
"""It ends by itself where the page fits the screen, shows colours, and leaves the page standing."""


class Pager:
    """A program that reads a page."""

    def __init__(self, command: Sequence[str]) -> None:
        """Take a program; it is not started yet.

        Args:
            command: Its name and its arguments.
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
        """Start it, and give the stream that it reads."""
        self._process = subprocess.Popen(  # noqa: S603 - the program that the user asks for
            self._command, stdin=subprocess.PIPE, encoding="utf-8", errors="replace"
        )
        return cast("TextIO", self._process.stdin)

    def end(self) -> None:
        """Close the page and wait until it was read."""
        if self._process is None or self._process.stdin is None:
            return
        # Who leaves a page before its end has read enough.
        with suppress(BrokenPipeError, ValueError, OSError):
            self._process.stdin.close()
        while self._process.poll() is None:
            # It is the pager that an interrupt is meant for while it has the terminal.
            with suppress(KeyboardInterrupt):
                self._process.wait()
