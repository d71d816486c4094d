"""Choice under bent value functions: one by one, and all together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.decision.sensitivity.inputs import InputKind
from rgss.decision.sensitivity.tornado import Tornado, TornadoEnd
from rgss.decision.what_if import ALL
from rgss.studies import Project
from rgss.tradeoff import PiecewiseValue, ValueFunction
from rgss.tradeoff.problem import half_value_share


@dataclass(frozen=True, slots=True, kw_only=True)
class BentEnd:
    """A value function bent in one direction.

    Attributes:
        curvature: The curvature at the end of the range: above 0 if the function is concave, so that the
            first gains count most.
        lead: The advantage of the choice there; None if it has none.
        winners: The designs that are best there.
        flip: The curvature at which the choice changes; None if it does not change within the range.
        flip_winners: The designs that win beyond it.
        flip_tolerance: The risk tolerance there, as a share of the range from worst to best; None without a flip.
        flip_halfway: For a linear function, the quantity with the value one half there; None otherwise.
    """

    curvature: float
    lead: float | None
    winners: tuple[int, ...]
    flip: float | None
    flip_winners: tuple[int, ...]
    flip_tolerance: float | None
    flip_halfway: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class BentValue:
    """Choice with the value function of a measure bent.

    Attributes:
        measure: The measure; empty for all together.
        unit: Its unit.
        convex: Bent so that the last gains count most.
        concave: Bent so that the first gains count most.
    """

    measure: str
    unit: str
    convex: BentEnd
    concave: BentEnd

    @property
    def flips(self) -> bool:
        """True if the choice changes within the range."""
        return self.convex.flip is not None or self.concave.flip is not None


def bent_values_of(project: Project, tornado: Tornado, functions: Sequence[ValueFunction]) -> tuple[BentValue, ...]:
    """Effects of bending on the choice, in the order of the study."""
    by_measure = {function.measure: function for function in functions}
    bars = {bar.id.partition(".")[2]: bar for bar in tornado.bars if bar.kind is InputKind.SHAPE}
    found = []
    for measure in (*project.study.trade_off.weighting.weights, ALL):
        bar = bars.get(measure)
        if bar is None:
            continue
        function = by_measure.get(measure)
        found.append(
            BentValue(
                measure="" if measure == ALL else measure,
                unit="1" if function is None else project.measures.measure(measure).unit,
                convex=_end(bar.low, function),
                concave=_end(bar.high, function),
            )
        )
    return tuple(found)


def _end(end: TornadoEnd, function: ValueFunction | None) -> BentEnd:
    halfway = None
    if end.flip is not None and isinstance(function, PiecewiseValue) and not function.interior:
        halfway = function.worst + (function.best - function.worst) * half_value_share(end.flip)
    return BentEnd(
        curvature=end.value,
        lead=end.lead,
        winners=end.winners,
        flip=end.flip,
        flip_winners=end.flip_winners,
        flip_tolerance=None if end.flip is None or end.flip == 0.0 else abs(1.0 / end.flip),
        flip_halfway=halfway,
    )
