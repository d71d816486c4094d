"""Targets of a move in contact physics: those of its timed motion, then its end until the joints settle."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from rgss.trials.reference import Reference

Row = tuple[Sequence[float], Sequence[float], Sequence[float], float, Sequence[float]]

_STRAIGHT = (0.0, 0.0, 0.0)


class MoveTargets:
    """Position, velocity, position after the step, load in m/s² and tool arc in m of each step of a move.

    Attributes:
        tool_m: Target positions of the tool, at the start and after each step, including the longest wait; shape (k,
        3).
        shortfall: Message if the joints did not settle in time; empty if they did.
    """

    def __init__(
        self,
        reference: Reference,
        *,
        reached_rad: float | None,
        positions_rad: Callable[[], Sequence[float]],
        gravity_m_s2: float,
        longest_wait_steps: int,
    ) -> None:
        """Prepare the targets.

        Args:
            reference: The timed motion.
            reached_rad: Greatest joint error at which the end counts as reached; None for no wait.
            positions_rad: Present positions of the joints.
            gravity_m_s2: Gravity, the load of an object at rest.
            longest_wait_steps: Timeout of settling in steps.
        """
        self._reference = reference
        self._reached_rad = reached_rad
        self._positions_rad = positions_rad
        self._gravity_m_s2 = gravity_m_s2
        self._longest_wait_steps = 0 if reached_rad is None else longest_wait_steps
        self.tool_m = np.vstack([reference.tool_m, np.repeat(reference.tool_m[-1:], self._longest_wait_steps, axis=0)])
        self.shortfall = ""

    def __iter__(self) -> Iterator[Row]:
        """Targets in order; their number after the motion depends on the present positions."""
        reference = self._reference
        positions, velocities = reference.positions_rad.tolist(), reference.velocities_rad_s.tolist()
        load, arc = reference.load_m_s2.tolist(), reference.arc_m.tolist()
        yield from zip(positions, velocities, positions[1:], load, arc, strict=False)
        if self._reached_rad is None:
            return
        end, still = positions[-1], [0.0] * len(positions[-1])
        for _ in range(self._longest_wait_steps):
            if self._error_rad(end) <= self._reached_rad:
                return
            yield end, still, end, self._gravity_m_s2, _STRAIGHT
        error_rad = self._error_rad(end)
        if error_rad > self._reached_rad:
            self.shortfall = f"a joint is {error_rad:.2g} from its target, at most {self._reached_rad:.2g} are allowed"

    def _error_rad(self, end: Sequence[float]) -> float:
        return max(math.fabs(now - wanted) for now, wanted in zip(self._positions_rad(), end, strict=True))
