"""Reading how a trade-off decides: its program, the demands on replicates, the fleet."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from rgss.errors import TradeoffError
from rgss.studies.trade_off.document import (
    AimEntry,
    BoundEntry,
    ChanceEntry,
    EpsilonConstraintEntry,
    LexicographicEntry,
    MinimaxRegretEntry,
    PortfolioEntry,
    ProgramField,
    TailEntry,
    TchebycheffEntry,
)
from rgss.studies.trade_off.places import SECTION, Place, TradeOffPlaces
from rgss.studies.trade_off.sections import (
    AimChoice,
    BoundChoice,
    PortfolioChoice,
    ProgramChoice,
    RiskChoice,
    ValuedMeasure,
)
from rgss.tradeoff import Aim, Comparison, Lexicographic, PortfolioAim, Scenarios, Tchebycheff, Weighting

PROGRAM = (*SECTION, "decide_by")


class ProgramReader:
    """Reads the program of a trade-off."""

    def __init__(self, places: TradeOffPlaces, valued: Sequence[ValuedMeasure], weights: Mapping[str, float]) -> None:
        self._places = places
        self._valued = {each.measure: each for each in valued}
        self._weights = weights

    def read(self, entry: ProgramField) -> ProgramChoice:
        """Read a program; what is wrong in it is found and left out."""
        if isinstance(entry, LexicographicEntry):
            aims = [self._aim(aim, (*PROGRAM, "order", index)) for index, aim in enumerate(entry.order)]
            sound = tuple(aim for aim in aims if aim is not None)
            if len(sound) == len(aims):
                self._try(lambda: Lexicographic(aims=tuple(as_aim(aim) for aim in sound)), (*PROGRAM, "order"))
            return ProgramChoice(name=entry.program, aims=sound)
        if isinstance(entry, EpsilonConstraintEntry):
            one = self._aim(entry.optimise, (*PROGRAM, "optimise"))
            bounds = [
                self._places_bound(bound, (*PROGRAM, "limits", index)) for index, bound in enumerate(entry.limits)
            ]
            return ProgramChoice(
                name=entry.program,
                aims=() if one is None else (one,),
                limits=tuple(bound for bound in bounds if bound is not None),
            )
        if isinstance(entry, TchebycheffEntry):
            return self._tchebycheff(entry)
        if isinstance(entry, MinimaxRegretEntry):
            return ProgramChoice(name=entry.program, scenarios=Scenarios(entry.over))
        return ProgramChoice(name=entry.program)

    def _places_bound(self, entry: BoundEntry, at: Place) -> BoundChoice | None:
        return read_bound(self._places, entry, entry.measure, at)

    def _aim(self, entry: AimEntry, at: Place) -> AimChoice | None:
        places = self._places
        if not places.knows(entry.measure, (*at, "measure")):
            return None
        more = places.more_is_better(entry.measure)
        if more is None and entry.measure in self._valued:
            function = self._valued[entry.measure].function(lambda anchor: places.quantity_of(anchor, entry.measure))
            more = function.more_is_better
        if more is None:
            message = f"no one says whether more or less of {entry.measure} is better"
            places.report("program", message, (*at, "measure"), hint="say so in the measures' file")
            return None
        absolute: float | None = 0.0
        if entry.absolute is not None:
            absolute = places.quantity(entry.absolute, entry.measure, (*at, "absolute"))
        if absolute is None:
            return None
        aim = AimChoice(measure=entry.measure, more_is_better=more, absolute=absolute, relative=entry.relative or 0.0)
        return aim if self._try(lambda: as_aim(aim), at) else None

    def _tchebycheff(self, entry: TchebycheffEntry) -> ProgramChoice:
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
        return ProgramChoice(name=entry.program, reference=tuple(reference), augmentation=entry.augmentation)

    def _try(self, make: Callable[[], object], at: Place) -> bool:
        try:
            make()
        except TradeoffError as error:
            self._places.report("program", error.message, at, hint=error.hint)
            return False
        return True


def as_aim(choice: AimChoice) -> Aim:
    """The aim that a study's file states.

    Raises:
        TradeoffError: Its tolerances contradict each other or are no tolerances.
    """
    return Aim(
        measure=choice.measure,
        sense=Comparison.AT_LEAST if choice.more_is_better else Comparison.AT_MOST,
        absolute=choice.absolute,
        relative=choice.relative,
    )


def read_bound(
    places: TradeOffPlaces, entry: BoundEntry | ChanceEntry | TailEntry, measure: str, at: Place
) -> BoundChoice | None:
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
    named: list[tuple[str, int, ChanceEntry | TailEntry]] = [("chance", *each) for each in enumerate(chances)]
    named += [("tail", *each) for each in enumerate(tails)]
    for kind, index, entry in named:
        risk = _risk(places, kind, entry, (*SECTION, kind, index))
        if risk is None:
            continue
        if any(risk.id == other.id for other in found):
            places.report("repeated", f"{risk.id} is demanded twice", (*SECTION, kind, index), hint="keep one")
            continue
        found.append(risk)
    return tuple(found)


def _risk(places: TradeOffPlaces, kind: str, entry: ChanceEntry | TailEntry, at: Place) -> RiskChoice | None:
    share, key = (
        (entry.probability, "probability") if isinstance(entry, ChanceEntry) else (entry.worst_share, "worst_share")
    )
    sound = True
    if not 0.0 < share < 1.0:
        places.report("risk", f"{key} is {share:g}", (*at, key), hint="give a number between 0 and 1, such as 0.9")
        sound = False
    if (entry.requirement is None) == (entry.measure is None):
        places.report(
            "risk",
            f"a {kind} is of a requirement or of a measure",
            at,
            hint="give 'requirement', or 'measure' and a bound",
        )
        return None
    bound = None
    if entry.measure is not None:
        bound = read_bound(places, entry, entry.measure, at)
        sound &= bound is not None
    else:
        for end in ("at_most", "at_least"):
            if getattr(entry, end) is not None:
                places.report(
                    "risk",
                    f"{entry.requirement} has its own threshold",
                    (*at, end),
                    hint="take it out, or name a measure",
                )
                sound = False
        sound &= places.threshold(entry.requirement or "", None, (*at, "requirement")) is not None
    if not sound:
        return None
    return RiskChoice(
        id=f"{kind}:{entry.requirement or entry.measure}",
        requirement=entry.requirement,
        bound=bound,
        probability=share if isinstance(entry, ChanceEntry) else None,
        worst_share=share if isinstance(entry, TailEntry) else None,
    )


def read_portfolio(places: TradeOffPlaces, entry: PortfolioEntry | None) -> PortfolioChoice | None:
    """Read a fleet; None if none is asked for."""
    if entry is None:
        return None
    at = (*SECTION, "fleet", "studies")
    names = [each.study for each in entry.studies]
    for index, name in enumerate(names):
        if name in names[:index]:
            places.report("repeated", f"study {name!r} is named twice", (*at, index, "study"), hint="keep one")
            return None
    try:
        Weighting(weights={each.study: each.weight for each in entry.studies})
    except TradeoffError as error:
        places.report("weights", error.message, at, hint=error.hint)
    return PortfolioChoice(
        at_most=entry.at_most,
        aim=PortfolioAim(entry.aim),
        member=entry.member,
        studies=tuple((each.study, each.weight) for each in entry.studies),
    )
