"""Colours of status words."""

from __future__ import annotations

import os
from types import MappingProxyType
from typing import Literal

STYLES = MappingProxyType(
    {
        "met": "green",
        "passed": "green",
        "same": "green",
        "not_met": "red",
        "missed": "red",
        "failed": "red",
        "worse": "red",
        "inconclusive": "yellow",
        "open": "yellow",
        "changed": "yellow",
        "stale": "yellow",
        "not_run": "dim",
        "not run": "dim",
        "not_measured": "dim",
    }
)
"""Style of a cell with a status word; other cells have none."""


def colour_system() -> Literal["auto"] | None:
    """Colour system of rich's consoles; None, which omits bold too, if NO_COLOR is set and not empty."""
    return None if os.environ.get("NO_COLOR") else "auto"
