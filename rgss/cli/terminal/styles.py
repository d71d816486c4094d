"""Colours of words that say how something stands."""

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
"""The style of a cell that is one of these words; other cells have none."""
