"""Force sensors in the fingers: the normal force averaged over a moving window.

The normal force in a step is its impulse divided by its length, so the peak of an impact depends on the step length.
The impulse over a fixed window converges as the step shrinks.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence


class ForceSensor:
    """Moving average of each finger's normal force, with its greatest value.

    The window is exact: if it is not a whole number of steps, the oldest step is weighted in part. A window shorter
    than a step is that step.

    Attributes:
        peak_n: Greatest average of any finger since the last restart.
    """

    def __init__(self, window_s: float, rate_hz: float) -> None:
        """Start without a force.

        Args:
            window_s: Length of the window.
            rate_hz: Physics steps a second.
        """
        self.peak_n = 0.0
        steps = max(1.0, window_s * rate_hz)
        whole = int(steps + 1e-9)
        part = max(0.0, steps - whole)
        self._weights = (*(1.0 / steps,) * whole, *((part / steps,) if part > 1e-9 else ()))
        self._kept: deque[tuple[float, ...]] = deque(maxlen=len(self._weights))
        self._rising = 0

    def note(self, forces_n: Sequence[float]) -> None:
        """Add the normal forces of the fingers in one step."""
        self._kept.appendleft(tuple(forces_n))
        # An average exceeds the peak only if one of the forces in it does.
        if max(forces_n) > self.peak_n:
            self._rising = len(self._weights)
        if self._rising:
            self._rising -= 1
            for forces in zip(*self._kept, strict=True):
                mean = math.fsum([weight * force for weight, force in zip(self._weights, forces, strict=False)])
                if mean > self.peak_n:
                    self.peak_n = mean

    def restart(self) -> None:
        """Reset the peak; the window is kept."""
        self.peak_n = 0.0
        self._rising = len(self._weights)

    def clear(self) -> None:
        """Clear the window, after a long time without contact."""
        self._kept.clear()
        self._rising = 0
