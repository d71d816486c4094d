"""What planning and timing need to know about a robot; kinematics provides it, trials introduce them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray


class StateValidity(Protocol):
    """Tells valid configurations from invalid ones."""

    def is_valid(self, q: Sequence[float] | NDArray[np.float64]) -> bool:
        """Tell whether a configuration is valid.

        Args:
            q: Joint angles in rad, shape (n,).
        """
        ...


class ToolKinematics(Protocol):
    """Where the tool centre is and how it moves."""

    def tool_position(self, qs: ArrayLike) -> NDArray[np.float64]:
        """Positions of the tool centre in m, shape (n, 3), for joint angles in rad, shape (n, 6)."""
        ...

    def tool_jacobian(self, q: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]:
        """Jacobian at the tool centre, shape (6, 6), the linear rows in m/rad first, for joint angles in rad."""
        ...
