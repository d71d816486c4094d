"""First screen of a report: the choice against its limits, open verdicts, what would change the choice."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rgss.reports.decision import variants_text
from rgss.reports.plain_numbers import Plain
from rgss.reports.study.column_entries import entry_at, entry_text
from rgss.trace.views import value_in_words

MOST_BULLETS = 6
"""Most requirements with a chart; the verdicts below have all."""

_OPEN = ("inconclusive", "stale", "not_run")
_WORDS = {"<=": "at most", "<": "below", ">=": "at least", ">": "above", "==": "exactly"}
_ROOM = 1.12
_PRICES = "prices"
"""The assumption whose alternatives are factors."""

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
    requirements = [one for one in document["requirements"] if one["measure"]]
    by_record = [one for one in document["requirements"] if one["id"] in decision["failed_records"]]
    by_test = [
        one for one in document["requirements"] if one["id"] in decision["failed_tests"] and one not in by_record
    ]
    failed = [*by_test, *by_record]
    judged = [one for one in requirements if one not in failed]
    open_ = [one for one in judged if entry_at(one["verdict"], place) in _OPEN]
    missed = [one for one in judged if entry_at(one["verdict"], place) == "not_met"]
    units = {measure["id"]: measure for measure in document["measures"]}
    weights = {measure: one["weight"] or 0.0 for measure, one in units.items()}
    # Missed and open requirements come first, then those with the greatest weights.
    ranked = sorted(
        requirements,
        key=lambda one: (one not in missed, one not in open_, -weights.get(one["measure"], 0.0), one["id"]),
    )
    bullets = [bullet for one in ranked if (bullet := _bullet(one, units, place)) is not None]
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
        "met": len(judged) - len(open_) - len(missed),
        "open": [{"id": one["id"], "text": one["text"]} for one in open_],
        "missed": [
            *({"id": one["id"], "text": one["text"]} for one in missed),
            *({"id": one["id"], "text": f"{one['text']} Its test failed."} for one in by_test),
            *({"id": one["id"], "text": f"{one['text']} Its verification record says so."} for one in by_record),
        ],
        "bullets": bullets[:MOST_BULLETS],
        "more_limits": max(0, len(bullets) - MOST_BULLETS),
        "changes": list(_changes(decision)),
        "worst": _worst(document),
    }


def _worst(document: Mapping[str, Any]) -> Plain | None:
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
    top = max(abs(limit), abs(value), 0.0 if high is None else min(abs(high), 2.0 * abs(limit))) * _ROOM or 1.0
    unit = measure["unit"]
    interval, beyond = None, [False, False]
    if low is not None and high is not None and low < high:
        interval, beyond = [_percent(low, top), _percent(high, top)], [low < 0.0, high > top]
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
        "at": _percent(value, top),
        "limit": _percent(limit, top),
        "interval": interval,
        "beyond": beyond,
        "allowed": [0.0, _percent(limit, top)] if at_most else [_percent(limit, top), 100.0],
    }


def _percent(value: float, top: float) -> float:
    return round(min(max(100.0 * value / top, 0.0), 100.0), 2)


def _changes(decision: Mapping[str, Any]) -> Iterator[str]:
    """Sentences on what would change the choice: assumptions, weights, limits."""
    rows = decision["modelling"]["rows"]
    changing = [row["cells"] for row in rows if row["changes"]]
    for cells in changing[:3]:
        sign = "×" if cells[0] == _PRICES else "="
        yield f"{cells[0]} {sign} {cells[2]}: then {cells[3]}"
    unknown = sum(row["changes"] is None for row in rows)
    if unknown:
        yield f"{unknown} of {len(rows)} rows of assumptions have no trials yet"
    nearest = _nearest_weight(decision["weight_ranges"])
    if nearest is not None:
        yield nearest
    elif decision["weight_ranges"]:
        yield "no single weight: each can have any value, with the others in proportion"


def _nearest_weight(ranges: Sequence[Mapping[str, Any]]) -> str | None:
    """The least change of one weight after which another variant wins."""
    found = []
    for one in ranges:
        for bound, winners, side in ((one["low"], one["below"], "below"), (one["high"], one["above"], "above")):
            if winners:
                found.append((abs(bound - one["weight"]), one["measure"], side, bound, winners))
    if not found:
        return None
    _, measure, side, bound, winners = min(found)
    least = f"{side} {bound:.3g}" if bound >= _LEAST_WEIGHT else "of nearly 0"
    return f"the weight of {measure} {least}: then {variants_text(winners)}"
