"""A measure in the trace: the needs that it traces to and the measures that it contributes to."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class MeasureKind(str, Enum):
    """The role of a measure: only measures of effectiveness and of performance must trace."""

    MOE = "moe"
    MOP = "mop"
    SUPPLEMENTARY = "supplementary"


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasureTrace:
    """One measure with its links.

    Attributes:
        id: Its id, such as ``P_max``.
        kind: Its role.
        unit: The unit of its estimates; ``"1"`` for a pure number.
        traces: Ids of the stakeholder requirements that it answers.
        contributes_to: Ids of the measures that are computed from it.
        observed: It is counted in the trials themselves, so it needs no measure of performance.
        file: The file that declares it, relative to the project.
        line: Line of the declaration, from 1.
        column: Column of the declaration, from 1.
    """

    id: str
    kind: MeasureKind
    unit: str
    traces: tuple[str, ...] = ()
    contributes_to: tuple[str, ...] = ()
    observed: bool = False
    file: str
    line: int
    column: int
