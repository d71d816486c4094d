"""First screen of a report: the choice against its limits, open verdicts, what would change the choice."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rgss.counted import counted
from rgss.reports.decision import variants_text
from rgss.reports.plain_numbers import Plain
from rgss.reports.study.column_entries import entry_at, entry_text
from rgss.trace.views import rounded_away, value_in_words

MOST_BULLETS = 6
"""Most requirements with a chart; the verdicts below have all."""

_OPEN = ("inconclusive", "stale", "not_run")
_WORDS = {"<=": "at most", "<": "below", ">=": "at least", ">": "above"}
_ROOM = 1.12

MOST_CHANGES = 2
"""Most assumptions that are named as changing the choice; the table of assumptions has all."""

_LEAST_WEIGHT = 5e-4
"""A smaller weight is written as nearly 0."""


def first_screen_content(document: Mapping[str, Any]) -> Plain | None:
    """Content of the first screen; None if nothing is chosen.

    Args:
        document: The report's document, from `rgss.reports.study.document.report_document`.
    """
    decision = document["decision"]
    chosen = decision["chosen"]
    if chosen is None:
        return None
    place = document["variants"]["id"].index(chosen)
    equal = [one for one in decision["ties"] if one != chosen]
    standing = _standing(document, place)
    bullets = _bullets(document, place, standing)
    return {
        "chosen": chosen,
        "levels": [
            {"name": one["name"], "value": entry_text(entry_at(one["values"], place), one["unit"])}
            for one in document["parameters"]
            if one["varies"]
        ],
        "equal": equal,
        # A design of equal value is tied as well, and is not named twice.
        "tied": [one for one in decision["rivals"] if one != chosen and one not in equal],
        "near": [one for one in decision["rivals_by_margin"] if one != chosen and one not in equal],
        "met": standing.met,
        "open": [{"id": one["id"], "text": one["text"]} for one in standing.open],
        "missed": [
            *({"id": one["id"], "text": one["text"]} for one in standing.missed),
            *({"id": one["id"], "text": f"{one['text']} Its test failed."} for one in standing.by_test),
            *(
                {"id": one["id"], "text": f"{one['text']} Its verification record says so."}
                for one in standing.by_record
            ),
        ],
        "bullets": bullets[:MOST_BULLETS],
        "more_limits": max(0, len(bullets) - MOST_BULLETS),
        "changes": list(
            _changes(
                decision,
                {one["id"]: one["name"] for one in document["measures"]},
                is_alone=len(document["variants"]["id"]) == 1,
            )
        ),
        "other_changes": _other_changes(decision["modelling"]["rows"]),
    }


@dataclass(frozen=True, slots=True, kw_only=True)
class _Standing:
    """Requirements on the choice: the number of met ones, open and missed ones, and those failed by a test or record.

    What a test or a verification record fails is not counted by its verdict.
    """

    met: int
    open: list[Mapping[str, Any]]
    missed: list[Mapping[str, Any]]
    by_test: list[Mapping[str, Any]]
    by_record: list[Mapping[str, Any]]


def _standing(document: Mapping[str, Any], place: int) -> _Standing:
    decision, requirements = document["decision"], document["requirements"]
    by_record = [one for one in requirements if one["id"] in decision["failed_records"]]
    by_test = [one for one in requirements if one["id"] in decision["failed_tests"] and one not in by_record]
    verdicts = [
        (one, entry_at(one["verdict"], place))
        for one in requirements
        if one["measure"] and one not in by_test and one not in by_record
    ]
    open_ = [one for one, verdict in verdicts if verdict in _OPEN]
    missed = [one for one, verdict in verdicts if verdict == "not_met"]
    met = len(verdicts) - len(open_) - len(missed)
    return _Standing(met=met, open=open_, missed=missed, by_test=by_test, by_record=by_record)


def _bullets(document: Mapping[str, Any], place: int, standing: _Standing) -> list[Plain]:
    """Bullet charts of the limits: missed and open requirements first, then those with the greatest weights."""
    measures = {measure["id"]: measure for measure in document["measures"]}
    weights = {measure: one["weight"] or 0.0 for measure, one in measures.items()}
    ranked = sorted(
        (one for one in document["requirements"] if one["measure"]),
        key=lambda one: (
            one not in standing.missed,
            one not in standing.open,
            -weights.get(one["measure"], 0.0),
            one["id"],
        ),
    )
    return [bullet for one in ranked if (bullet := _bullet(one, measures, place)) is not None]


def worst_failure_in_words(document: Mapping[str, Any]) -> Plain | None:
    """The worst failure: its trial in words, why it is shown, and where its evidence is; None without one."""
    trials = document["trials"]
    worst = trials["worst"]
    if worst is None:
        return None
    variant = document["variants"]["id"][trials["variant"][worst["trial"]]]
    return {
        "title": f"Variant {variant}, seed {trials['seed'][worst['trial']]}",
        "why": worst["why"],
        "to": f"#variant-{variant}/{trials['key'][worst['trial']]}",
    }


def _bullet(requirement: Mapping[str, Any], measures: Mapping[str, Any], place: int) -> Plain | None:
    """Bullet chart: positions in percent of its width, and the same in words."""
    measure = measures.get(requirement["measure"])
    value = None if measure is None else entry_at(measure["value"], place)
    if measure is None or value is None:
        return None
    low, high = (entry_at(measure.get(name), place) for name in ("low", "high"))
    limit, at_most = requirement["threshold"], requirement["comparison"] in ("<=", "<")
    scale = bottom, top = _scale(value, limit, low, high, most=measure.get("most"))
    unit = measure["unit"]
    interval, beyond = None, [False, False]
    if low is not None and high is not None and low < high:
        interval, beyond = [_percent(low, scale), _percent(high, scale)], [low < bottom, high > top]
    verdict = entry_at(requirement["verdict"], place)
    words = f"{_WORDS[requirement['comparison']]} {value_in_words(limit, unit)}"
    between = "" if interval is None else f" ({value_in_words(low)} to {value_in_words(high, unit)})"
    return {
        "requirement": requirement["id"],
        "name": measure["name"],
        "measure": measure["id"],
        "verdict": verdict,
        "value": value_in_words(value, unit),
        "interval_text": between.strip(),
        "limit_text": words,
        "label": f"{measure['name']}: {value_in_words(value, unit)}{between}, demanded {words}: "
        f"{verdict.replace('_', ' ')}",
        "at": _percent(value, scale),
        "limit": _percent(limit, scale),
        "interval": interval,
        "beyond": beyond,
        "allowed": [0.0, _percent(limit, scale)] if at_most else [_percent(limit, scale), 100.0],
    }


def _scale(
    value: float, limit: float, low: float | None, high: float | None, *, most: float | None
) -> tuple[float, float]:
    """Ends of a bullet chart: 0 and, with some room, the value, its limit and the interval up to twice the limit.

    Below 0 it goes only if the value or the limit is negative, and beyond the most that is possible only for the limit.
    """
    reach = 2.0 * abs(limit)
    ends = [min(max(one, -reach), reach) for one in (low, high) if one is not None]
    furthest = max(0.0, limit, value, *ends)
    top = _ROOM * furthest if most is None else max(min(_ROOM * furthest, most), furthest)
    if value >= 0.0 and limit >= 0.0:
        return 0.0, top or 1.0
    return _ROOM * min(0.0, limit, value, *ends), top


def _percent(value: float, scale: tuple[float, float]) -> float:
    bottom, top = scale
    return round(min(max(100.0 * (value - bottom) / (top - bottom), 0.0), 100.0), 2)


def _changes(decision: Mapping[str, Any], names: Mapping[str, str], *, is_alone: bool) -> Iterator[str]:
    """Sentences on what would change the choice: a few assumptions, and the nearest weight."""
    rows = decision["modelling"]["rows"]
    yield from [row["sentence"] for row in rows if row["changes"]][:MOST_CHANGES]
    nearest = _nearest_weight(decision["weight_ranges"], names)
    if nearest is not None:
        yield nearest
    elif is_alone:
        yield "No weight: no other variant is compared."
    elif len(decision["weight_ranges"]) == 1:
        yield "No weight: a single measure is valued."
    elif decision["weight_ranges"]:
        yield "No weight by itself: each can have any value while the others keep their proportions."


def _other_changes(rows: Sequence[Mapping[str, Any]]) -> str:
    """Number of assumptions in the table, of those that are not named and change the choice, and of unknown ones."""
    if not rows:
        return ""
    more = max(0, sum(bool(row["changes"]) for row in rows) - MOST_CHANGES)
    unknown = sum(row["changes"] is None for row in rows)
    parts = [f"{more} more change it"] if more else []
    parts += [f"{unknown} without trials"] if unknown else []
    return f"{counted(len(rows), 'assumption')} with alternatives" + (f" ({', '.join(parts)})" if parts else "")


def _nearest_weight(ranges: Sequence[Mapping[str, Any]], names: Mapping[str, str]) -> str | None:
    """The least change of one weight after which another variant wins."""
    found = []
    for one in ranges:
        for bound, winners, side in ((one["low"], one["below"], "below"), (one["high"], one["above"], "above")):
            if winners:
                found.append((abs(bound - one["weight"]), one["measure"], one["weight"], side, bound, winners))
    if not found:
        return None
    _, measure, weight, side, bound, winners = min(found)
    least = f"{side} {rounded_away(weight, bound, '1', 3):.3g}" if bound >= _LEAST_WEIGHT else "nearly 0"
    come = "comes" if len(winners) == 1 else "come"
    return f"Weight of {names[measure]}: {least} instead of {weight:.3g}. Then {variants_text(winners)} {come} first."
