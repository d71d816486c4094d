"""Interfaces of a robot for planning and timing, implemented by `rgss.kinematics`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray


class StateValidity(Protocol):
    """State-validity checker: the planner's predicate over configurations."""

    def is_valid(self, q: Sequence[float] | NDArray[np.float64]) -> bool:
        """True if a configuration is valid.

        Args:
            q: Joint angles in rad, shape (n,).
        """
        ...


@runtime_checkable
class BatchValidity(StateValidity, Protocol):
    """Batched state-validity checker."""

    def first_invalid_between(self, qs: NDArray[np.float64]) -> int | None:
        """Index of the first invalid configuration; None if all are valid.

        Args:
            qs: Joint angles in rad, shape (n, joints), each between two that keep the joints' ranges.
        """
        ...


def first_invalid_between(validity: StateValidity) -> Callable[[NDArray[np.float64]], int | None]:
    """Function that finds the first invalid configuration (n, joints) between two valid ones."""
    if isinstance(validity, BatchValidity):
        return validity.first_invalid_between

    def find(qs: NDArray[np.float64]) -> int | None:
        return next((index for index, q in enumerate(qs.tolist()) if not validity.is_valid(q)), None)

    return find


StateCost = Callable[[Sequence[float]], float]
"""Cost of joint angles in rad, at least 0; an evaluation is charged like a validity check."""


class ToolKinematics(Protocol):
    """Position and Jacobian of the tool centre."""

    def tool_position(self, qs: ArrayLike) -> NDArray[np.float64]:
        """Positions of the tool centre in m, shape (k, 3), for joint positions, shape (k, n)."""
        ...

    def tool_jacobian(self, q: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]:
        """Jacobian at the tool centre, shape (6, n), the linear rows first, for joint positions."""
        ...
