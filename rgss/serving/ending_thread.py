"""Thread that can be ended from outside."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable

PATIENCE_S = 2.0
"""So long its end is waited for: one that waits for another process, as for a replay, does no harm at the exit."""


class EndingThread(threading.Thread):
    """Thread that ends with the process, and before that on request.

    A thread that is within C++ code when the interpreter is finalised is unwound through that code, which may abort the
    process (*FATAL: exception not rethrown*). It is therefore ended before.
    """

    def __init__(self, target: Callable[..., None], arguments: tuple[object, ...] = (), *, name: str) -> None:
        """Create the thread.

        Args:
            target: What it does.
            arguments: Arguments of the target.
            name: Name of the thread.
        """
        super().__init__(target=target, args=arguments, name=name, daemon=True)

    def run(self) -> None:
        """Run the target; a request to end it is no error."""
        try:
            super().run()
        except SystemExit:
            return

    def end(self, patience_s: float = PATIENCE_S) -> bool:
        """End the thread at its next step in Python.

        Args:
            patience_s: Longest time to wait for it; code that waits or computes outside of Python goes on until then.

        Returns:
            True if it has ended.
        """
        if self.is_alive() and self.ident is not None:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(self.ident), ctypes.py_object(SystemExit))
            self.join(patience_s)
        return not self.is_alive()
