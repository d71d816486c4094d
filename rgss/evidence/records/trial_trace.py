"""Time series of one trial, the source of pictures and plots."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Series = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PhaseSpan:
    """Time span of a phase.

    Attributes:
        phase: The phase.
        start_s: Time of its start.
        end_s: Time of its end.
        last: Index of its last sample.
    """

    phase: str
    start_s: float
    end_s: float
    last: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrialTrace:
    """Time series of the executed phases; n samples, in simulated time without planning.

    A sample covers the physics steps up to the next one: its forces are the greatest of them and its grip margin the
    least, so that a coarse rate hides no peak. All other values are those at its time.

    Attributes:
        spans: The phases in order.
        time_s: Times (n,) of the samples, from the start of the first phase.
        joint_positions_rad: Positions (n, joints) of the arm.
        finger_travel_m: Travel of each finger from open (n, fingers).
        workpiece_position_m: Position (n, 3) of the workpiece in the world.
        workpiece_quaternion_xyzw: Orientation (n, 4) of the workpiece in the world, scalar last.
        tool_position_m: Position (n, 3) of the grasp centre in the world.
        tool_speed_m_s: Speed (n,) of the grasp centre.
        tool_speed_limit_m_s: Speed limit of the grasp centre in the design.
        finger_forces_n: Normal force (n, fingers) of each finger on the workpiece.
        commanded_force_n: Commanded force (n,) of each finger; NaN if there is none.
        grip_margin: Friction available over friction needed (n,); NaN while nothing is carried.
        objects: Position and orientation (n, 7) of each object of a scene of several in the world, by its name.
    """

    spans: tuple[PhaseSpan, ...]
    time_s: Series
    joint_positions_rad: Series
    finger_travel_m: Series
    workpiece_position_m: Series
    workpiece_quaternion_xyzw: Series
    tool_position_m: Series
    tool_speed_m_s: Series
    tool_speed_limit_m_s: float
    finger_forces_n: Series
    commanded_force_n: Series
    grip_margin: Series
    objects: Mapping[str, Series] = field(default_factory=dict)

    @property
    def duration_s(self) -> float:
        """Time of the last sample."""
        return float(self.time_s[-1])

    def sample_at(self, time_s: float) -> int:
        """Index of the sample nearest to a time."""
        after = int(np.searchsorted(self.time_s, time_s))
        if after == 0:
            return 0
        if after == len(self.time_s):
            return after - 1
        return after if self.time_s[after] - time_s < time_s - self.time_s[after - 1] else after - 1

    def span_at(self, sample: int) -> PhaseSpan:
        """Phase of a sample."""
        return next(span for span in self.spans if sample <= span.last)
