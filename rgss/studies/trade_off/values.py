"""Reader of value functions and weights, group by group."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rgss.errors import TradeoffError
from rgss.studies.trade_off.document import OrderEntry, ValueEntry
from rgss.studies.trade_off.elicitation import AnswerReader
from rgss.studies.trade_off.places import SECTION, Place, TradeOffPlaces
from rgss.tradeoff import (
    SHAPE_KEYS,
    Anchor,
    AnchoredValue,
    CriterionNode,
    ElicitedInterval,
    ElicitedOrder,
    PointEntry,
    RankRule,
    RequirementAnchor,
    WeightBounds,
    Weighting,
    shape_of,
    weighting_of,
    weights_from_points,
    weights_from_ranks,
)

_WEIGHTS = ("weight", "points", "rank")


def name_of(entry: ValueEntry) -> str:
    """The measure or the criterion of an entry; empty where it has neither."""
    return entry.measure or entry.criterion or ""


class ValueReader:
    """Reader of the entries of ``values``.

    Attributes:
        valued: The value functions that were read.
        intervals: The elicited bounds that were read.
    """

    def __init__(self, places: TradeOffPlaces, answers: AnswerReader) -> None:
        self.valued: list[AnchoredValue] = []
        self.intervals: list[ElicitedInterval] = []
        self._places = places
        self._answers = answers
        self._names: list[str] = []

    def read(
        self, entries: Sequence[ValueEntry], rank_rule: str | None, at: Place, *, top: bool = True
    ) -> tuple[CriterionNode, ...] | None:
        """Read a group.

        Args:
            entries: Its members.
            rank_rule: The rule that turns ranks into weights.
            at: Path of the list of its members.
            top: Whether it is the outermost group.

        Returns:
            The members with their weights; None if their weights are wrong or not all known.
        """
        members: list[tuple[CriterionNode, ...] | None] = []
        sound = True
        for index, entry in enumerate(entries):
            sound &= self._named(entry, (*at, index))
            if entry.of is not None:
                members.append(self.read(entry.of, entry.rank_rule, (*at, index, "of"), top=False))
            else:
                members.append(())
                self._value(entry, (*at, index))
        weights = self._weights(entries, rank_rule, at) if sound else None
        if weights is None or None in members:
            return None
        nodes = tuple(
            CriterionNode(name=name_of(entry), weight=weights[name_of(entry)], members=inner or ())
            for entry, inner in zip(entries, members, strict=True)
        )
        group = () if top else tuple(measure for node in nodes for measure in node.measures)
        for index, (entry, node) in enumerate(zip(entries, nodes, strict=True)):
            self._interval(entry, node, group, (*at, index, "weight_between"))
        return nodes

    @property
    def names(self) -> tuple[str, ...]:
        """The measures and criteria that were read."""
        return tuple(self._names)

    def orders(self, entries: Sequence[OrderEntry], nodes: Sequence[CriterionNode] | None) -> tuple[ElicitedOrder, ...]:
        """Read the elicited orders of weights, after those of the answers."""
        known = _by_name(nodes or ())
        if nodes is None:
            return ()
        found = [
            replace(
                order,
                heavier_measures=known[order.heavier].measures,
                lighter_measures=known[order.lighter].measures,
            )
            for elicited in self._answers.elicited
            for answer in elicited.bounds
            for order in answer.orders()
        ]
        for index, entry in enumerate(entries):
            at = (*SECTION, "weight_order", index)
            named = (("heavier", entry.heavier), ("lighter", entry.lighter))
            unknown = [(key, name) for key, name in named if name not in known]
            for key, name in unknown:
                message = f"no criterion {name!r} is valued"
                self._places.report("criterion", message, (*at, key), hint=f"criteria: {', '.join(known)}")
            if unknown:
                continue
            try:
                found.append(
                    ElicitedOrder(
                        heavier=entry.heavier,
                        heavier_measures=known[entry.heavier].measures,
                        lighter=entry.lighter,
                        lighter_measures=known[entry.lighter].measures,
                        times=entry.times,
                    )
                )
            except TradeoffError as error:
                self._places.report("weights", error.message, (*at, "times"), hint=error.hint)
        return tuple(found)

    def check_bounds(self, nodes: Sequence[CriterionNode] | None, orders: Sequence[ElicitedOrder]) -> None:
        """Report weights that contradict the elicited bounds."""
        if nodes is None:
            return
        weights = weighting_of(nodes).weights
        for interval in self.intervals:
            self._check(WeightBounds(intervals=(interval,)), weights, (*SECTION, "values"))
        for order in orders:
            self._check(WeightBounds(orders=(order,)), weights, (*SECTION, "weight_order"))

    def _check(self, bounds: WeightBounds, weights: Mapping[str, float], at: Place) -> None:
        try:
            bounds.check(weights)
        except TradeoffError as error:
            self._places.report("weights", error.message, at, hint=error.hint)

    def _named(self, entry: ValueEntry, at: Place) -> bool:
        """True if an entry is either a measure or a criterion, and a new one."""
        if (entry.measure is None) == (entry.criterion is None):
            message = "an entry is a measure or a criterion"
            self._places.report("value", message, at, hint="give 'measure', or 'criterion' with its members in 'of'")
            return False
        name = name_of(entry)
        key = "measure" if entry.measure is not None else "criterion"
        if name in self._names:
            self._places.report("repeated", f"{key} {name!r} is valued twice", (*at, key), hint="keep one")
            return False
        self._names.append(name)
        if entry.measure is None:
            for each in SHAPE_KEYS:
                if getattr(entry, each) is not None:
                    message = f"criterion {name!r} has members, not {each!r} of its own"
                    self._places.report("value", message, (*at, each), hint="value its members")
            if entry.of is None:
                self._places.report("value", f"criterion {name!r} has no members", at, hint="list them in 'of'")
                return False
        elif entry.of is not None:
            message = f"measure {name!r} has members"
            self._places.report("value", message, (*at, "of"), hint="name the group with 'criterion'")
        if entry.rank_rule is not None and entry.of is None:
            message = f"{name!r} has a rank rule but no members"
            self._places.report("weights", message, (*at, "rank_rule"), hint="give it to the group")
        return True

    def _weights(self, entries: Sequence[ValueEntry], rank_rule: str | None, at: Place) -> Mapping[str, float] | None:
        if self._answers and not any(getattr(entry, kind) is not None for entry in entries for kind in _WEIGHTS):
            elicited = self._answers.weights([name_of(entry) for entry in entries])
            return None if elicited is None else elicited.weights
        kinds: dict[str, str] = {}
        for index, entry in enumerate(entries):
            given = [kind for kind in _WEIGHTS if getattr(entry, kind) is not None]
            if len(given) != 1:
                what = "no weight" if not given else f"{given[0]!r} and {given[1]!r}"
                hint = "give one of 'weight', 'points' and 'rank'"
                self._places.report("weights", f"{name_of(entry)!r} has {what}", (*at, index), hint=hint)
                return None
            kinds.setdefault(given[0], name_of(entry))
        if len(kinds) > 1:
            (one, first), (other, second), *_ = kinds.items()
            message = f"{first!r} has {one!r} and {second!r} has {other!r}"
            self._places.report("weights", message, at, hint="weigh the members of a group alike")
            return None
        (kind,) = kinds
        if (kind == "rank") != (rank_rule is not None):
            message = "ranks need a rule" if kind == "rank" else f"a rank rule, but {kinds[kind]!r} has no rank"
            hint = (
                f"give 'rank_rule': {', '.join(rule.value for rule in RankRule)}" if kind == "rank" else "take it out"
            )
            self._places.report("weights", message, at if kind == "rank" else (*at[:-1], "rank_rule"), hint=hint)
            return None
        return self._computed(entries, kind, rank_rule, at)

    def _computed(
        self, entries: Sequence[ValueEntry], kind: str, rank_rule: str | None, at: Place
    ) -> Mapping[str, float] | None:
        given = {name_of(entry): getattr(entry, kind) for entry in entries}
        try:
            if kind == "rank":
                return weights_from_ranks(given, RankRule(rank_rule))
            if kind == "points":
                return weights_from_points(given)
            return Weighting(weights=given).weights
        except TradeoffError as error:
            wrong = next((index for index, entry in enumerate(entries) if not getattr(entry, kind) >= 0.0), None)
            self._places.report("weights", error.message, at if wrong is None else (*at, wrong, kind), hint=error.hint)
            return None

    def _interval(self, entry: ValueEntry, node: CriterionNode, group: tuple[str, ...], at: Place) -> None:
        if entry.weight_between is None:
            return
        least, most = entry.weight_between
        try:
            interval = ElicitedInterval(name=node.name, measures=node.measures, within=group, least=least, most=most)
        except TradeoffError as error:
            self._places.report("weights", error.message, at, hint=error.hint)
            return
        self.intervals.append(interval)

    def _value(self, entry: ValueEntry, at: Place) -> None:
        measure = entry.measure
        if measure is None or not self._places.knows(measure, (*at, "measure")):
            return
        given = [key for key in SHAPE_KEYS if getattr(entry, key) is not None]
        shape = shape_of(given)
        alien = [key for key in given if key not in (*shape.required, *shape.optional)]
        missing = [key for key in shape.required if key not in given]
        needed = f"give {' and '.join(repr(each) for each in shape.required)}"
        for key in missing:
            self._places.report("value", f"{measure!r} has no {key!r}", at, hint=needed)
        for key in alien:
            message = f"{measure!r} has {shape.label} and {key!r}"
            self._places.report("value", message, (*at, key), hint="keep one kind of value")
        if not missing and not alien:
            self._shape(entry, shape, given, measure, at)

    def _shape(
        self, entry: ValueEntry, shape: type[AnchoredValue], given: Sequence[str], measure: str, at: Place
    ) -> None:
        places = self._places
        anchors = {key: self._anchors(getattr(entry, key), measure, (*at, key)) for key in given}
        if None in anchors.values():
            return
        valued = shape(measure=measure, **anchors)  # type: ignore[call-arg]
        try:
            function = valued.function(lambda anchor: places.quantity_of(anchor, measure))
        except TradeoffError as error:
            last = next((key for key in shape.own if key in given), shape.ends[1])
            places.report("value", error.message, (*at, last), hint=error.hint)
            return
        better = places.more_is_better(measure)
        if None not in (better, function.more_is_better) and better is not function.more_is_better:
            wanted, got = ("more", "less") if better else ("less", "more")
            message = f"{wanted} {measure} is better, but this values {got} of it higher"
            anchored = any(isinstance(anchor, RequirementAnchor) for anchor in anchors.values())
            hint = "a requirement's threshold lies beyond the other end; move that too" if anchored else ""
            places.report("direction", message, (*at, shape.ends[1]), hint=hint or "exchange worst and best")
            return
        self.valued.append(valued)

    def _anchors(
        self, field: RequirementAnchor | str | float | tuple[PointEntry, ...], measure: str, at: Place
    ) -> Anchor | tuple[tuple[Anchor, float], ...] | None:
        """Content of a key of a shape: an anchor, points or a pure number; None where one has a finding."""
        if isinstance(field, float):
            return field
        if not isinstance(field, tuple):
            return self._places.anchor(field, measure, at)
        points = [
            (self._places.anchor(point.at, measure, (*at, index, "at")), point.worth)
            for index, point in enumerate(field)
        ]
        sound = tuple((anchor, worth) for anchor, worth in points if anchor is not None)
        return sound if len(sound) == len(points) else None


def _by_name(nodes: Sequence[CriterionNode]) -> dict[str, CriterionNode]:
    found: dict[str, CriterionNode] = {}
    for node in nodes:
        found[node.name] = node
        found.update(_by_name(node.members))
    return found
