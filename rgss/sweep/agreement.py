"""Agreement of two records of one trial that were computed with different numerics."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from enum import Enum
from types import MappingProxyType

from rgss.sweep.input_changes import Change

RELATIVE = 1e-3
"""Deviation of any number that is within the tolerance, as a share of it."""

ABSOLUTE: Mapping[str, float] = MappingProxyType(
    {"m_s2": 1e-2, "m_s": 1e-3, "n_m": 0.1, "rad": 5e-3, "kg": 0.02, "m": 2e-4, "s": 0.05, "n": 0.1, "1": 0.05}
)
"""Deviation that is within the tolerance too, in the unit at the end of a number's name; of those that fit the
longest counts. Each is ten times or more of what kernels of other processors were seen to make of the reference
study's contact trials, where the object came to rest 12 micrometres and 0.33 mrad elsewhere at most."""

_NO_UNIT = 0.01
_INDEX = re.compile(r"\[[^\]]*\]$")


class Agreement(str, Enum):
    """Agreement of a repeated trial with the stored one."""

    BIT_FOR_BIT = "bit for bit"
    WITHIN_TOLERANCE = "within tolerance"
    DIFFERENT = "different"


def deviation(change: Change) -> float | None:
    """Relative deviation of a number; None for other values."""
    try:
        then, now = float(change.then), float(change.now)
    except ValueError:
        return None
    return abs(now - then) if math.isfinite(then) and math.isfinite(now) else None


def beyond_tolerance(changes: Iterable[Change]) -> tuple[Change, ...]:
    """Those of the differences that other numerics do not explain: an outcome, a count, too great a deviation.

    Args:
        changes: Differences of two records.
    """
    return tuple(change for change in changes if not _is_within(change))


def _is_within(change: Change) -> bool:
    by = deviation(change)
    if by is None or not all(_is_float(text) for text in (change.then, change.now)):
        return False
    name = _INDEX.sub("", change.name.rpartition(".")[2])
    absolute = next((limit for unit, limit in ABSOLUTE.items() if name.endswith(f"_{unit}")), _NO_UNIT)
    return by <= absolute + RELATIVE * max(abs(float(change.then)), abs(float(change.now)))


def _is_float(text: str) -> bool:
    """True for a measured number; False for a count, which other numerics change only if the trial runs otherwise."""
    return any(sign in text for sign in ".e")
