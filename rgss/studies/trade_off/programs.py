"""Reader of how a trade-off decides: its program, the demands on replicates, the portfolio."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from rgss.errors import TradeoffError
from rgss.studies.trade_off.anchored_programs import AnchoredEpsilonConstraint, AnchoredTchebycheff, StatedProgram
from rgss.studies.trade_off.demands import BoundChoice, RequirementBound, RiskChoice, RiskKind
from rgss.studies.trade_off.document import (
    AimEntry,
    BoundEntry,
    ChanceEntry,
    EpsilonConstraintEntry,
    LexicographicEntry,
    MinimaxRegretEntry,
    PortfolioEntry,
    ProgramField,
    RiskEntry,
    TailEntry,
    TchebycheffEntry,
)
from rgss.studies.trade_off.places import SECTION, Place, TradeOffPlaces
from rgss.tradeoff import (
    AdditiveValue,
    Aim,
    AnchoredValue,
    Comparison,
    Lexicographic,
    MinimaxRegret,
    Tchebycheff,
    Weighting,
)

_Made = TypeVar("_Made")

PROGRAM = (*SECTION, "decide_by")


class ProgramReader:
    """Reader of the program of a trade-off."""

    def __init__(self, places: TradeOffPlaces, valued: Sequence[AnchoredValue], weights: Mapping[str, float]) -> None:
        self._places = places
        self._valued = {each.measure: each for each in valued}
        self._weights = weights

    def read(self, entry: ProgramField) -> StatedProgram | None:
        """Read a program; findings, and None where it cannot be used."""
        if isinstance(entry, LexicographicEntry):
            return self._lexicographic(entry)
        if isinstance(entry, EpsilonConstraintEntry):
            return self._epsilon_constraint(entry)
        if isinstance(entry, TchebycheffEntry):
            return self._tchebycheff(entry)
        if isinstance(entry, MinimaxRegretEntry):
            return MinimaxRegret(scenarios=entry.over)
        return AdditiveValue()

    def _lexicographic(self, entry: LexicographicEntry) -> Lexicographic | None:
        aims = [self._aim(aim, (*PROGRAM, "order", index)) for index, aim in enumerate(entry.order)]
        sound = tuple(aim for aim in aims if aim is not None)
        return self._try(lambda: Lexicographic(aims=sound), (*PROGRAM, "order")) if len(sound) == len(aims) else None

    def _epsilon_constraint(self, entry: EpsilonConstraintEntry) -> AnchoredEpsilonConstraint | None:
        aim = self._aim(entry.optimise, (*PROGRAM, "optimise"))
        limits = [
            read_bound(self._places, limit, limit.measure, (*PROGRAM, "limits", index))
            for index, limit in enumerate(entry.limits)
        ]
        if aim is None:
            return None
        return AnchoredEpsilonConstraint(aim=aim, limits=tuple(limit for limit in limits if limit is not None))

    def _aim(self, entry: AimEntry, at: Place) -> Aim | None:
        places = self._places
        if not places.knows(entry.measure, (*at, "measure")):
            return None
        more = places.more_is_better(entry.measure)
        if more is None and entry.measure in self._valued:
            function = self._valued[entry.measure].function(lambda anchor: places.quantity_of(anchor, entry.measure))
            more = function.more_is_better
        if more is None:
            message = f"measure {entry.measure} has no preferred direction"
            places.report("program", message, (*at, "measure"), hint="say so in the measures' file")
            return None
        absolute: float | None = 0.0
        if entry.absolute is not None:
            absolute = places.quantity(entry.absolute, entry.measure, (*at, "absolute"))
        if absolute is None:
            return None
        sense, given_up = Comparison.AT_LEAST if more else Comparison.AT_MOST, absolute
        return self._try(
            lambda: Aim(measure=entry.measure, sense=sense, absolute=given_up, relative=entry.relative or 0.0), at
        )

    def _tchebycheff(self, entry: TchebycheffEntry) -> AnchoredTchebycheff:
        reference = []
        for measure, field in entry.reference.items():
            at = (*PROGRAM, "reference", measure)
            if not self._places.knows(measure, at):
                continue
            if not self._weights.get(measure):
                self._places.report(
                    "program",
                    f"the reference names {measure!r}, which has no weight",
                    at,
                    hint="value it, or take it out",
                )
                continue
            anchor = self._places.anchor(field, measure, at)
            if anchor is not None:
                reference.append((measure, anchor))
        self._try(lambda: Tchebycheff(augmentation=entry.augmentation), (*PROGRAM, "augmentation"))
        return AnchoredTchebycheff(reference=tuple(reference), augmentation=entry.augmentation)

    def _try(self, make: Callable[[], _Made], at: Place) -> _Made | None:
        try:
            return make()
        except TradeoffError as error:
            self._places.report("program", error.message, at, hint=error.hint)
            return None


def read_bound(places: TradeOffPlaces, entry: BoundEntry | RiskEntry, measure: str, at: Place) -> BoundChoice | None:
    """Read a bound on a measure; a finding and None if it is none."""
    if not places.knows(measure, (*at, "measure")):
        return None
    given = [(key, field) for key in ("at_most", "at_least") if (field := getattr(entry, key)) is not None]
    if len(given) != 1:
        what = "no bound" if not given else "two bounds"
        places.report("bound", f"{measure!r} has {what}", at, hint="give 'at_most' or 'at_least'")
        return None
    ((key, field),) = given
    value = places.anchor(field, measure, (*at, key))
    if value is None:
        return None
    comparison = Comparison.AT_MOST if key == "at_most" else Comparison.AT_LEAST
    return BoundChoice(measure=measure, comparison=comparison, value=value)


def read_risks(
    places: TradeOffPlaces, chances: Sequence[ChanceEntry], tails: Sequence[TailEntry]
) -> tuple[RiskChoice, ...]:
    """Read the demands on replicates."""
    found: list[RiskChoice] = []
    entries: tuple[tuple[RiskKind, Sequence[tuple[RiskEntry, float]]], ...] = (
        (RiskKind.CHANCE, [(entry, entry.probability) for entry in chances]),
        (RiskKind.TAIL, [(entry, entry.worst_share) for entry in tails]),
    )
    for kind, stated in entries:
        for index, (entry, share) in enumerate(stated):
            at = (*SECTION, kind.value, index)
            bound = _risk_bound(places, kind, entry, share, at)
            if bound is None:
                continue
            id_ = f"{kind.value}:{entry.requirement or entry.measure}"
            if any(id_ == other.id for other in found):
                places.report("repeated", f"{id_} is demanded twice", at, hint="keep one")
                continue
            found.append(RiskChoice(kind=kind, id=id_, bound=bound, share=share))
    return tuple(found)


def _risk_bound(
    places: TradeOffPlaces, kind: RiskKind, entry: RiskEntry, share: float, at: Place
) -> BoundChoice | RequirementBound | None:
    key = kind.share_key
    sound = True
    if not 0.0 < share < 1.0:
        places.report("risk", f"{key} must be between 0 and 1, got {share:g}", (*at, key), hint="such as 0.9")
        sound = False
    if entry.requirement is not None and entry.measure is None:
        for end in ("at_most", "at_least"):
            if getattr(entry, end) is not None:
                message = f"{entry.requirement} has its own threshold"
                places.report("risk", message, (*at, end), hint="take it out, or name a measure")
                sound = False
        sound &= places.threshold(entry.requirement, None, (*at, "requirement")) is not None
        return RequirementBound(requirement=entry.requirement) if sound else None
    if entry.measure is not None and entry.requirement is None:
        bound = read_bound(places, entry, entry.measure, at)
        return bound if sound else None
    message = f"a {kind.value} is of a requirement or of a measure"
    places.report("risk", message, at, hint="give 'requirement', or 'measure' and a bound")
    return None


def check_portfolio(places: TradeOffPlaces, entry: PortfolioEntry) -> None:
    """Report studies that are named twice, and weights that do not sum to 1."""
    at = (*SECTION, "portfolio", "studies")
    names = [each.study for each in entry.studies]
    for index, name in enumerate(names):
        if name in names[:index]:
            places.report("repeated", f"study {name!r} is named twice", (*at, index, "study"), hint="keep one")
            return
    try:
        Weighting(weights={each.study: each.weight for each in entry.studies})
    except TradeoffError as error:
        places.report("weights", error.message, at, hint=error.hint)
