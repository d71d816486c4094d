"""Discrete validation of straight motions, equivalent to OMPL's, with fewer calls into the engine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.motion.engine import Engine

Vector = NDArray[np.float64]
Angles = Callable[[Any], tuple[float, ...]]


def motion_validator(
    engine: Engine,
    information: Any,
    angles_of: Angles,
    is_valid: Callable[[Sequence[float]], bool],
    first_invalid: Callable[[Vector], int | None],
) -> Any:
    """Motion validator with the results and check counts of OMPL's ``DiscreteMotionValidator``.

    OMPL's own passes each intermediate state to Python, where it is read joint by joint; that takes a third of the time
    of a check. Here only the two ends are read; the states between are computed at once, by the same arithmetic and in
    the same order.

    Args:
        engine: The planning engine.
        information: Space information of a real vector space; it must outlive the validator.
        angles_of: Reads the joint angles (rad) of a state.
        is_valid: Whether joint angles (rad) are valid.
        first_invalid: Finds the first invalid one among joint angles (n, joints) between the two states.
    """
    space = information.getStateSpace()

    class StraightMotion(engine.base.MotionValidator):  # type: ignore[misc, name-defined]
        """OMPL motion validator for straight motions of a real vector space."""

        def checkMotion(self, start: Any, end: Any, last_valid: Any = None) -> bool:  # noqa: N802 - the engine's name
            """True if a motion is valid; a third argument receives the last valid state and its fraction."""
            pieces = space.validSegmentCount(start, end)
            if last_valid is not None:
                return self._is_valid_until(start, end, pieces, last_valid)
            there = angles_of(end)
            return is_valid(there) and first_invalid(_states(angles_of(start), there, _halving(pieces))) is None

        def _is_valid_until(self, start: Any, end: Any, pieces: int, last_valid: Any) -> bool:
            there = angles_of(end)
            states = _states(angles_of(start), there, _rising(pieces))
            index = first_invalid(states)
            if index is None:
                if is_valid(there):
                    return True
                index = len(states)
            last_valid.second = index / pieces
            if last_valid.first is not None:
                space.interpolate(start, end, last_valid.second, last_valid.first)
            return False

    return StraightMotion(information)


def _states(start: Sequence[float], end: Sequence[float], fractions: Vector) -> Vector:
    first = np.array(start)
    states: Vector = first + (np.array(end) - first) * fractions
    return states


@lru_cache(maxsize=4096)
def _rising(pieces: int) -> Vector:
    """Fractions of the states that divide a motion into pieces, shape (pieces - 1, 1), in order."""
    fractions: Vector = (np.arange(1, max(1, pieces)) / max(1, pieces))[:, None]
    return fractions


@lru_cache(maxsize=4096)
def _halving(pieces: int) -> Vector:
    """The same fractions in bisection order, OMPL's, so that an invalid motion is detected early."""
    order: list[int] = []
    spans = [(1, pieces - 1)] if pieces > 1 else []
    for low, high in spans:
        middle = (low + high) // 2
        order.append(middle)
        if low < middle:
            spans.append((low, middle - 1))
        if middle < high:
            spans.append((middle + 1, high))
    fractions: Vector = (np.array(order, dtype=float) / max(1, pieces))[:, None]
    return fractions
