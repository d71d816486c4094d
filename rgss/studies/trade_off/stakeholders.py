"""Reader of the weights of several stakeholders."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rgss.errors import TradeoffError
from rgss.studies.trade_off.document import StakeholderEntry
from rgss.studies.trade_off.elicitation import AnswerReader
from rgss.studies.trade_off.places import SECTION, Place, TradeOffPlaces
from rgss.tradeoff import Weighting, weights_from_points
from rgss.tradeoff.elicitation import ElicitedWeights

_KINDS = ("weights", "points", "answers")


@dataclass(frozen=True, slots=True, kw_only=True)
class Stakeholder:
    """A stakeholder with weights of their own.

    Attributes:
        name: The name.
        weights: The weight of each measure that the study weighs, in the study's order; they sum to 1.
        rationale: Reason for them; may be empty.
        elicited: The answers that they follow from; None if they were stated.
    """

    name: str
    weights: Mapping[str, float] = field(hash=False)
    rationale: str = ""
    elicited: ElicitedWeights | None = None


def read_stakeholders(
    places: TradeOffPlaces, entries: Mapping[str, StakeholderEntry], measures: Sequence[str]
) -> tuple[Stakeholder, ...]:
    """Read the stakeholders, with a finding for each mistake.

    Args:
        places: Takes the findings.
        entries: The entries by name.
        measures: The measures that have a weight in the study.
    """
    found = []
    for name, entry in entries.items():
        at: Place = (*SECTION, "stakeholders", name)
        given = [kind for kind in _KINDS if getattr(entry, kind) is not None]
        if len(given) != 1:
            message = f"stakeholder {name!r} has " + (" and ".join(map(repr, given)) if given else "no weights")
            places.report("stakeholders", message, at, hint="give one of 'weights', 'points' and 'answers'")
            continue
        stakeholder = _read(places, name, entry, given[0], measures, at)
        if stakeholder is not None:
            found.append(stakeholder)
    return tuple(found)


def _read(
    places: TradeOffPlaces, name: str, entry: StakeholderEntry, kind: str, measures: Sequence[str], at: Place
) -> Stakeholder | None:
    rationale = entry.rationale or ""
    if entry.answers is not None:
        reader = AnswerReader(places, entry.answers, (*at, "answers"))
        named = {one for answer in entry.answers for one in (answer.swing_of, answer.over)}
        reader_names = [measure for measure in measures if measure in named]
        elicited = reader.weights(reader_names) if reader_names else None
        reader.check_used(measures)
        if elicited is None:
            return None
        weights = {measure: elicited.weights.get(measure, 0.0) for measure in measures}
        return Stakeholder(name=name, weights=weights, rationale=rationale, elicited=elicited)
    numbers: Mapping[str, float] = getattr(entry, kind)
    unknown = [measure for measure in numbers if measure not in measures]
    for measure in unknown:
        message = f"measure {measure!r} has no weight in the study"
        places.report("stakeholders", message, (*at, kind, measure), hint=f"measures: {', '.join(measures)}")
    if unknown:
        return None
    try:
        made = weights_from_points(numbers) if kind == "points" else Weighting(weights=numbers).weights
    except TradeoffError as error:
        places.report("stakeholders", error.message, (*at, kind), hint=error.hint)
        return None
    whole = math.fsum(made.values())
    return Stakeholder(
        name=name, weights={measure: made.get(measure, 0.0) / whole for measure in measures}, rationale=rationale
    )
