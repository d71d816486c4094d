"""Moving mean of a force over a window of time, as the filter of a force sensor gives it."""

from __future__ import annotations

import math
from collections import deque


class ForceWindow:
    """Moving mean over a window of time.

    An engine of rigid bodies passes the impulse of a blow in one or two of its steps, so that the force of
    a step grows with the step rate. The mean over a window that is longer than a step does not: of a blow it
    is the impulse over the window. The window is exact; of its oldest step the part counts that lies in it.
    """

    def __init__(self, window_s: float, step_s: float) -> None:
        """Begin with no force.

        Args:
            window_s: Length of the window; at least a step is taken.
            step_s: Length of a step.
        """
        self._length = max(1.0, window_s / step_s)
        whole = math.floor(self._length)
        self._part = self._length - whole
        self._forces_n: deque[float] = deque([0.0] * (whole + 1), maxlen=whole + 1)

    def add(self, force_n: float) -> float:
        """Add the force of a step.

        Args:
            force_n: The mean force over the step.

        Returns:
            The mean over the window that ends with the step.
        """
        forces = self._forces_n
        forces.append(force_n)
        return (math.fsum(forces) - (1.0 - self._part) * forces[0]) / self._length
