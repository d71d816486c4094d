"""Descriptor of a metric."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.evidence import Fidelity


class Direction(str, Enum):
    """Preferred direction of a metric."""

    HIGHER = "higher"
    LOWER = "lower"
    NEITHER = "neither"


class Aggregation(str, Enum):
    """Aggregation rule of the phases' values into that of the trial; phases without a value are skipped."""

    COMPUTED = "computed"
    """By a dedicated function (rgss/trials/record.py)."""
    GREATEST = "greatest"
    LEAST = "least"
    OF_GREATEST = "of greatest"
    """Value in the first phase in which another metric (`MetricDescriptor.source`) is greatest."""
    WORST_PLACED = "worst placed"
    """Greatest over the releases, each by its last value before the next one."""
    SUM = "sum"
    GREATEST_OF_EACH = "greatest of each"
    """Entry-wise maximum of rows."""
    SUM_OF_EACH = "sum of each"
    """Entry-wise sum of rows."""
    WORST_CARRIED = "worst carried"
    """Worst value, by the preferred direction, over the phases in which the object is carried."""
    SUM_CARRIED = "sum carried"
    """Sum over the phases in which the object is carried; missing if it is 0."""
    AT_GRASP = "at grasp"
    """Value of another metric (`MetricDescriptor.source`) in the grasp phase."""


class PhaseValue(str, Enum):
    """Origin of the value of a phase."""

    OBSERVED = "observed"
    """Among the metrics of the phase's record, from the plant or a monitor."""
    RECORDED = "recorded"
    """A field of the phase's record or of the record of its planning."""


EVERY_FIDELITY = tuple(Fidelity)
WITH_TORQUES = (Fidelity.DYNAMIC, Fidelity.CONTACT)
WITH_CONTACT = (Fidelity.CONTACT,)

_SUFFIXES = {
    Aggregation.WORST_CARRIED: ", the worst while the object is carried",
    Aggregation.AT_GRASP: ", when the grasp was firm",
    Aggregation.WORST_PLACED: ", the worst of several",
}


FOR_EACH_MOVE = -1
"""Length of a row with an entry for each planned move of the task."""
FOR_EACH_JOINT = -2
"""Length of a row with an entry for each joint of the arm."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MetricDescriptor:
    """Descriptor of a metric, the source of records, data frames, regression checks, schemas and documentation.

    Attributes:
        name: Key in records, with the unit as suffix.
        unit: SI unit; ``1`` if it has none.
        meaning: Definition, in one phrase. It is excluded from code digests.
        better: Preferred direction.
        trial: Aggregation rule of the trial's value; None if only phases have one.
        phase: Origin of the values of phases; None if only the trial has one.
        fidelities: Fidelities in which it is observed; it may still be missing, such as after a failure.
        length: Number of entries of a row; 0 for one per finger, `FOR_EACH_MOVE` for one per planned move of the task,
            `FOR_EACH_JOINT` for one per joint of the arm, None for a single number. A recorded value of a phase is
            always a single number.
        least: Least possible value, of each entry of a row; None if there is none. Most metrics are magnitudes.
        most: Greatest possible value, of each entry of a row; None if there is none.
        phase_meaning: Definition for one phase, if it differs.
        source: The metric evaluated at the grasp, for `Aggregation.AT_GRASP`; the metric that selects the phase, for
        `Aggregation.OF_GREATEST`.
    """

    name: str
    unit: str
    meaning: str
    better: Direction = Direction.NEITHER
    trial: Aggregation | None = None
    phase: PhaseValue | None = PhaseValue.OBSERVED
    fidelities: tuple[Fidelity, ...] = EVERY_FIDELITY
    length: int | None = None
    least: float | None = 0.0
    most: float | None = None
    phase_meaning: str = ""
    source: str = ""

    @property
    def meaning_in_trial(self) -> str:
        """Definition of the value of a trial."""
        return self.meaning + (_SUFFIXES.get(self.trial, "") if self.trial is not None else "")

    @property
    def meaning_in_phase(self) -> str:
        """Definition of the value of a phase."""
        return self.phase_meaning or self.meaning

    def length_in_trial(self, *, planned: int, joints: int) -> int | None:
        """Number of entries of the value of a trial; None for a single number.

        Args:
            planned: Number of planned moves of the task.
            joints: Number of joints of the arm.
        """
        if self.length == FOR_EACH_MOVE:
            return planned
        return joints if self.length == FOR_EACH_JOINT else self.length

    @property
    def length_in_phase(self) -> int | None:
        """Number of entries of the value of a phase; None for a single number."""
        return None if self.phase is PhaseValue.RECORDED else self.length
