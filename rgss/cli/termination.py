"""Requests of the system to terminate, which end a verb as Ctrl-C does."""

from __future__ import annotations

import signal
import threading
from typing import NoReturn

_INTERRUPTS = ("SIGINT", "SIGTERM", "SIGHUP")


class TerminationRequest(KeyboardInterrupt):
    """A request to terminate, or the loss of the terminal: an interrupt that is meant for this process alone."""


def interrupt_at_termination() -> None:
    """Raise a `TerminationRequest` in the main thread at SIGTERM, as of a scheduler, and at SIGHUP.

    By default they end the process where it is: finished trials that are not stored yet are lost, and temporary files
    are left. A signal that is ignored, as under ``nohup``, stays ignored.
    """
    if threading.current_thread() is not threading.main_thread():
        return
    for number in _numbers()[1:]:
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _interrupt)


def ignore_interrupts() -> None:
    """Ignore further interrupts and requests: they must cut off neither a message nor the end of the process."""
    for number in _numbers():
        signal.signal(number, signal.SIG_IGN)


def _numbers() -> list[signal.Signals]:
    return [getattr(signal, name) for name in _INTERRUPTS if hasattr(signal, name)]


def _interrupt(_number: int, _frame: object) -> NoReturn:
    # Another one, which a service manager may send at once, would cut off what is cleaned up at this one.
    for number in _numbers()[1:]:
        signal.signal(number, signal.SIG_IGN)
    raise TerminationRequest
