"""List of the uncertain inputs of a decision: weights, ends of values, thresholds, assumed numbers, curvatures."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rgss.decision.robustness import Robustness
from rgss.decision.sensitivity.inputs import Flip, FlipSearch, InputKind, RangeBasis, UncertainInput
from rgss.decision.sensitivity.ranges import RangeBook
from rgss.decision.sensitivity.standings import Standings, anchor_quantity, anchored_on_requirements
from rgss.decision.what_if import ALL, SHAPE, assumed_numbers
from rgss.errors import DefinitionError, TradeoffError
from rgss.tradeoff.robustness import AssumptionRange, Standing, admitted_weights
from rgss.tradeoff.weights import Polytope

_HALVINGS = 20


def uncertain_inputs(standings: Standings, found: Robustness, book: RangeBook) -> Iterator[UncertainInput]:
    """The inputs, in the order of the study's file.

    Args:
        standings: The designs under changed inputs.
        found: The robustness of the decision, whose exact ends are used.
        book: The ranges.

    Raises:
        TradeoffError: No weights agree with what was elicited.
        DefinitionError: A value function is anchored on an unknown requirement.
    """
    yield from _weights(standings, found, book)
    yield from _anchors(standings, book)
    yield from _shapes(standings, book)
    yield from _thresholds(standings, book)
    yield from _assumptions(standings, found, book)


def undecided_inputs(standings: Standings, found: Robustness) -> tuple[str, ...]:
    """Inputs of the model without an effect on the decision, for which a range has no effect."""
    weightless = [name for name in standings.problem.weighting.weights if name not in standings.measures]
    return (
        *(one.number.id for one in found.assumptions if not one.columns),
        *(f"weight.{name}" for name in weightless),
        *(f"{SHAPE}.{name}" for name in weightless),
        *(f"value.{one.measure}.{key}" for one in standings.project.study.trade_off.valued for key in one.anchors),
    )


def _weights(standings: Standings, found: Robustness, book: RangeBook) -> Iterator[UncertainInput]:
    if len(standings.measures) < 2:
        return
    admitted = admitted_weights(standings.problem)
    extent = None if admitted.is_simplex else Polytope.of(admitted).extent()
    answered = _answered(standings)
    ranges = None if found.weighting is None else found.weighting.ranges
    for place, measure in enumerate(standings.measures):
        name, weight = f"weight.{measure}", float(standings.weights[place])
        low, high, basis = book.range_of(name, "1", weight, book.choice.weights * weight, least=0.0, most=1.0)
        known = answered.get(measure) if basis is RangeBasis.SHARE else None
        if known is None and basis is RangeBasis.SHARE and extent is not None:
            known = float(extent[0][place]), float(extent[1][place])
        if known is not None:
            low, high, basis = min(weight, known[0]), max(weight, known[1]), RangeBasis.ELICITED
        flips: tuple[Flip | None, Flip | None] = (None, None)
        if ranges is not None:
            one = ranges[place]
            flips = (
                Flip(value=one.low, winners=one.below) if one.below else None,
                Flip(value=one.high, winners=one.above) if one.above else None,
            )
        yield UncertainInput(
            id=name,
            kind=InputKind.WEIGHT,
            unit="1",
            base=weight,
            low=low,
            high=high,
            basis=basis,
            standing=standings.with_weight(place),
            search=FlipSearch.SCANNED if ranges is None else FlipSearch.KNOWN,
            exact=ranges is not None,
            known_flips=flips,
        )


def _answered(standings: Standings) -> dict[str, tuple[float, float]]:
    """The least and the greatest weight of each measure whose weight follows from pairwise answers."""
    weights = standings.problem.weighting.weights
    found = {}
    for elicited in standings.project.study.trade_off.elicited:
        for name, weight in elicited.weights.items():
            if name in weights:
                # The weight of a group's member in the whole.
                share = weights[name] / weight
                found[name] = (share * elicited.low[name], share * elicited.high[name])
    return found


def _anchors(standings: Standings, book: RangeBook) -> Iterator[UncertainInput]:
    project = standings.project
    for valued in project.study.trade_off.valued:
        if valued.measure not in standings.measures:
            continue
        unit = project.measures.measure(valued.measure).unit
        ends = [anchor_quantity(project, valued, key) for key in valued.ends]
        spread = book.choice.anchors * abs(ends[1] - ends[0])
        # A measure such as a time or a mass has no negative values.
        known = standings.values[:, standings.measures.index(valued.measure)]
        least = 0.0 if min(*ends, *known.tolist()) >= 0.0 else None
        for key, anchor in valued.anchors.items():
            if not isinstance(anchor, float):
                # It moves with the threshold that it is anchored on.
                continue
            name = f"value.{valued.measure}.{key}"
            low, high, basis = book.range_of(name, unit, anchor, spread, least=least)
            standing = standings.with_anchor(valued, key)
            low, high, basis = _where_defined(standing, anchor, low, high, basis)
            yield UncertainInput(
                id=name,
                kind=InputKind.ANCHOR,
                unit=unit,
                base=anchor,
                low=low,
                high=high,
                basis=basis,
                standing=standing,
                search=FlipSearch.SCANNED,
                exact=False,
            )


def _shapes(standings: Standings, book: RangeBook) -> Iterator[UncertainInput]:
    most = 1.0 / book.choice.risk_tolerance
    every = tuple(range(len(standings.measures)))
    named = [(measure, (place,)) for place, measure in enumerate(standings.measures)]
    # Functions that are bent differently have no common curvature.
    together = len(every) > 1 and len({standings.curvature_of(place) for place in every}) == 1
    for measure, places in [*named, *([(ALL, every)] if together else [])]:
        base = standings.curvature_of(places[0])
        low, high, basis = book.range_of(f"{SHAPE}.{measure}", "1", 0.0, most)
        low, high = min(low, base), max(high, base)
        yield UncertainInput(
            id=f"{SHAPE}.{measure}",
            kind=InputKind.SHAPE,
            unit="1",
            base=base,
            low=low,
            high=high,
            basis=basis,
            standing=standings.with_curvature(places),
            search=FlipSearch.SCANNED,
            exact=False,
        )


def _thresholds(standings: Standings, book: RangeBook) -> Iterator[UncertainInput]:
    moved_along = anchored_on_requirements(standings.project)
    seen = set()
    for threshold in standings.problem.thresholds:
        if threshold.requirement in seen:
            continue
        seen.add(threshold.requirement)
        name = f"{threshold.requirement}.threshold"
        # As it is required: the tolerance of the choice moves with it.
        base = threshold.value if threshold.required is None else threshold.required
        spread = book.choice.thresholds * abs(base)
        low, high, basis = book.range_of(name, threshold.unit, base, spread)
        standing = standings.with_threshold(threshold.requirement)
        if moved_along:
            low, high, basis = _where_defined(standing, base, low, high, basis)
        yield UncertainInput(
            id=name,
            kind=InputKind.THRESHOLD,
            unit=threshold.unit,
            base=base,
            low=low,
            high=high,
            basis=basis,
            standing=standing,
            # If no value function is anchored on it, designs feasible at one limit are feasible at every looser one.
            search=FlipSearch.SCANNED if moved_along else FlipSearch.NESTED,
            exact=not moved_along,
        )


def _where_defined(
    standing: Callable[[float], Standing], base: float, low: float, high: float, basis: RangeBasis
) -> tuple[float, float, RangeBasis]:
    """A range, cut where the values that are anchored on the input are not defined."""
    ends = (_nearest_defined(standing, base, low), _nearest_defined(standing, base, high))
    return (*ends, basis if ends == (low, high) else basis.cut)


def _nearest_defined(standing: Callable[[float], Standing], base: float, end: float) -> float:
    """An end of a range, or a part of the way to it at which the values that are anchored on the input are defined.

    Beyond it the worst end of a value function would be better than its best.
    """
    ends = (base + (end - base) / 2.0**step for step in range(_HALVINGS))
    return next((one for one in ends if _is_defined(standing, one)), base)


def _is_defined(standing: Callable[[float], Standing], value: float) -> bool:
    try:
        standing(value)
    except (DefinitionError, TradeoffError):
        return False
    return True


def _assumptions(standings: Standings, found: Robustness, book: RangeBook) -> Iterator[UncertainInput]:
    followed = {one.number.id: one for one in found.assumptions}
    for number in assumed_numbers(standings.project):
        one = followed.get(number.id)
        if one is None or not one.columns:
            continue
        spread = book.choice.assumptions * abs(number.value)
        if number.value < 0.0 and not book.has(number.id):
            continue
        low, high, basis = book.range_of(number.id, number.unit, number.value, spread, least=0.0)
        known = one.range
        yield UncertainInput(
            id=number.id,
            kind=InputKind.ASSUMPTION,
            unit=number.unit,
            base=number.value,
            low=low,
            high=high,
            basis=basis,
            standing=standings.with_number(number),
            search=FlipSearch.SCANNED if known is None else FlipSearch.KNOWN,
            exact=known is not None and known.exact,
            known_flips=(None, None) if known is None else _flips(known),
        )


def _flips(known: AssumptionRange) -> tuple[Flip | None, Flip | None]:
    return (
        None if known.low is None else Flip(value=known.low, winners=known.below),
        None if known.high is None else Flip(value=known.high, winners=known.above),
    )
