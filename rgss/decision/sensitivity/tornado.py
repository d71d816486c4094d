"""Tornado: swing of the choice's advantage over each uncertain input, the largest first."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from rgss.decision.sensitivity.advantage import Advantage, advantage_of
from rgss.decision.sensitivity.inputs import Flip, FlipSearch, InputKind, RangeBasis, UncertainInput
from rgss.tradeoff.problem import TIE_TOLERANCE
from rgss.tradeoff.robustness import Standing, scanned_range

_HALVINGS = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class TornadoEnd:
    """End of the range of an input; designs are given by their ids.

    Attributes:
        value: The value of the input there, in its unit.
        lead: The advantage of the choice there; below 0 if another design is better. None if the choice
            misses a requirement, or has no rival.
        feasible: True if the choice meets every requirement there.
        winners: The designs that are best there; empty if nothing is feasible.
        rival: The best rival there; None if there is none.
        flip: The value nearest to the study's at which the choice changes; None if it does not change up to this end.
        flip_winners: The designs that win beyond it; empty if nothing is feasible there.
    """

    value: float
    lead: float | None
    feasible: bool
    winners: tuple[int, ...]
    rival: int | None
    flip: float | None
    flip_winners: tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class TornadoBar:
    """Swing of the advantage over the range of one input.

    Attributes:
        id: The input, as ``--what-if`` takes it.
        kind: Its kind.
        unit: Its unit.
        base: Its value in the study.
        basis: Source of its range.
        low: The low end.
        high: The high end.
        swing: The greatest minus the least advantage at low end, study and high end; infinite if the choice
            misses a requirement at an end.
        exact: True if flips are exact; otherwise a change that reverts within a 64th of the range may have
            been missed. The ends are always exact.
    """

    id: str
    kind: InputKind
    unit: str
    base: float
    basis: RangeBasis
    low: TornadoEnd
    high: TornadoEnd
    swing: float
    exact: bool

    @property
    def flips(self) -> bool:
        """True if the choice changes within the range."""
        return self.low.flip is not None or self.high.flip is not None

    @property
    def moves(self) -> bool:
        """True if the advantage changes by more than a tie."""
        return self.swing > TIE_TOLERANCE


@dataclass(frozen=True, slots=True, kw_only=True)
class Tornado:
    """Sensitivity of a choice to each uncertain input by itself.

    Attributes:
        chosen: The chosen design.
        rival: Its best rival in the study that is not tied with it; None if there is none.
        lead: Its advantage in weighted value; None without a rival.
        tied: The designs that are tied with it.
        bars: One for each input, those with the largest swing first; equals in the order of the study.
        without_range: Inputs with the value 0, for which a share of the value is no range.
    """

    chosen: int
    rival: int | None
    lead: float | None
    bars: tuple[TornadoBar, ...]
    without_range: tuple[str, ...]
    tied: tuple[int, ...] = ()

    @property
    def has_leads(self) -> bool:
        """True if there is a lead to draw: over a rival, or over or behind a tied design at an end of an input."""
        return self.lead is not None or any(end.lead is not None for bar in self.bars for end in (bar.low, bar.high))

    @property
    def moving(self) -> tuple[TornadoBar, ...]:
        """The bars of inputs that change the advantage or the choice."""
        return tuple(bar for bar in self.bars if bar.moves or bar.flips)

    @property
    def still(self) -> tuple[TornadoBar, ...]:
        """The other bars."""
        return tuple(bar for bar in self.bars if not (bar.moves or bar.flips))


def tornado_of(
    inputs: Iterable[UncertainInput],
    standing: Standing,
    chosen: int,
    tied: tuple[int, ...],
    variants: tuple[int, ...],
) -> Tornado:
    """Tornado: the decision at both ends of each input, and the values between at which the choice changes.

    Args:
        inputs: The inputs.
        standing: The designs in the study as it is.
        chosen: The row of the choice.
        tied: The rows of all designs that are tied with it, itself among them.
        variants: The ids of the rows.
    """
    here = advantage_of(standing, chosen, tied)
    bars, without = [], []
    for one in inputs:
        if one.low == one.high:
            without.append(one.id)
            continue
        bars.append(_bar(one, here, chosen, tied, variants))
    return Tornado(
        chosen=variants[chosen],
        rival=None if here.rival is None else variants[here.rival],
        lead=here.lead,
        # The sort is stable: equal swings keep the order of the study.
        bars=tuple(sorted(bars, key=lambda bar: -bar.swing if math.isinf(bar.swing) else -round(bar.swing, 12))),
        without_range=tuple(without),
        tied=tuple(variants[row] for row in tied if row != chosen),
    )


def _bar(
    one: UncertainInput, here: Advantage, chosen: int, tied: tuple[int, ...], variants: tuple[int, ...]
) -> TornadoBar:
    ends = [advantage_of(one.standing(value), chosen, tied) for value in (one.low, one.high)]
    flips = _flips(one, chosen)
    low, high = (
        TornadoEnd(
            value=value,
            lead=end.lead,
            feasible=end.feasible,
            winners=tuple(variants[row] for row in end.winners),
            rival=None if end.rival is None else variants[end.rival],
            flip=None if flip is None else flip.value,
            flip_winners=() if flip is None else tuple(variants[row] for row in flip.winners),
        )
        for value, end, flip in zip((one.low, one.high), ends, flips, strict=True)
    )
    return TornadoBar(
        id=one.id,
        kind=one.kind,
        unit=one.unit,
        base=one.base,
        basis=one.basis,
        low=low,
        high=high,
        swing=_swing(here, ends),
        exact=one.exact,
    )


def _swing(here: Advantage, ends: list[Advantage]) -> float:
    if not all(end.feasible for end in ends):
        return math.inf
    leads = [one.lead for one in (here, *ends) if one.lead is not None]
    # An end without a rival has no advantage to compare.
    return max(leads) - min(leads) if leads else 0.0


def _flips(one: UncertainInput, chosen: int) -> tuple[Flip | None, Flip | None]:
    """The nearest changes of the choice within the range, below and above the study's value."""
    if one.search is FlipSearch.KNOWN:
        below, above = one.known_flips
        return (
            below if below is not None and below.value >= one.low else None,
            above if above is not None and above.value <= one.high else None,
        )
    if one.search is FlipSearch.NESTED:
        return _bisected(one, chosen, one.low), _bisected(one, chosen, one.high)
    found = scanned_range(one.standing, chosen, one.base, lowest=one.low, highest=one.high)
    return (
        None if found.low is None else Flip(value=found.low, winners=found.below),
        None if found.high is None else Flip(value=found.high, winners=found.above),
    )


def _bisected(one: UncertainInput, chosen: int, end: float) -> Flip | None:
    outside = one.standing(end).best()
    if chosen in outside:
        return None
    inside, beyond = one.base, end
    for _ in range(_HALVINGS):
        middle = 0.5 * (inside + beyond)
        if middle in (inside, beyond):
            break
        best = one.standing(middle).best()
        if chosen in best:
            inside = middle
        else:
            beyond, outside = middle, best
    return Flip(value=inside, winners=outside)
