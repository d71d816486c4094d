"""Interrupts: Ctrl-C, and requests of the system to terminate, which end a verb as Ctrl-C does."""

from __future__ import annotations

import signal
import threading
from typing import NoReturn

_REQUESTS = ("SIGTERM", "SIGHUP")


class TerminationRequest(KeyboardInterrupt):
    """A request to terminate, or the loss of the terminal: an interrupt that is meant for this process alone."""


class Interrupts:
    """Interrupts of this process.

    Attributes:
        received: True after the first one. A library may turn it into an error of its own, as pydantic does within the
            validator of a model.
    """

    def __init__(self) -> None:
        """Listen to nothing yet."""
        self.received = False
        self._is_listening = False

    def listen(self) -> None:
        """Raise `KeyboardInterrupt` in the main thread at SIGINT, and `TerminationRequest` at SIGTERM and SIGHUP.

        By default the latter end the process where it is: finished trials that are not stored yet are lost, and
        temporary files are left. A signal that is ignored, as under ``nohup``, stays ignored.
        """
        if threading.current_thread() is not threading.main_thread():
            return
        self._is_listening = True
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, self._interrupt)
        for number in _requests():
            if signal.getsignal(number) is signal.SIG_DFL:
                signal.signal(number, self._terminate)

    def ignore(self) -> None:
        """Ignore further ones, if it listens: they must cut off neither a message nor the end of the process."""
        if self._is_listening:
            for number in (signal.SIGINT, *_requests()):
                signal.signal(number, signal.SIG_IGN)

    def _interrupt(self, _number: int, _frame: object) -> NoReturn:
        self.received = True
        raise KeyboardInterrupt

    def _terminate(self, _number: int, _frame: object) -> NoReturn:
        self.received = True
        # Another one, which a service manager may send at once, would cut off what is cleaned up at this one.
        for number in _requests():
            signal.signal(number, signal.SIG_IGN)
        raise TerminationRequest


def _requests() -> list[signal.Signals]:
    return [getattr(signal, name) for name in _REQUESTS if hasattr(signal, name)]
