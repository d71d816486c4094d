"""Colours of status words."""

from __future__ import annotations

from types import MappingProxyType

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
