"""Test of whether a process exists, for files that have the number of the process that made them."""

from __future__ import annotations

import os
import sys


def is_running(process: int) -> bool:
    """True if a process exists, or if that cannot be known."""
    if sys.platform == "win32":
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True
