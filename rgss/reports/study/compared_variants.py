"""The chosen variant beside the runner-up: rows of their figures, and their trials."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from typing import Any
from urllib.parse import quote

from rgss.reports.study.column_entries import entry_at, entry_text

_MOST_REPLAYS = 5


def comparison_rows(document: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The chosen variant beside the runner-up, a row for each parameter that varies and each weighted measure."""
    decision, variants = document["decision"], document["variants"]
    shown = [variants["id"].index(one) for one in (decision["chosen"], decision["runner_up"]) if one is not None]
    if not shown:
        return []

    rows = [
        {
            "name": parameter["name"],
            "weight": None,
            "cells": [
                _figure(
                    document,
                    place,
                    parameter["id"],
                    entry_text(entry_at(parameter["values"], place), parameter["unit"]),
                )
                for place in shown
            ],
        }
        for parameter in document["parameters"]
        if parameter["varies"]
    ]
    measures = {measure["id"]: measure for measure in document["measures"]}
    for weighted in document["weights"]["measures"]:
        measure = measures[weighted["id"]]
        rows.append(
            {
                "name": f"{measure['id']}: {measure['name']}",
                "weight": weighted["weight"],
                "cells": [_figure(document, place, measure["id"], _estimate(measure, place)) for place in shown],
            }
        )
    values = [_figure(document, place, "value", entry_text(entry_at(variants["value"], place))) for place in shown]
    rows.append({"name": "weighted value", "weight": None, "cells": values})
    return rows


def compared_trials(document: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The trials of the chosen variant and of the runner-up, each with the command that runs it again."""
    decision, variants, trials = document["decision"], document["variants"], document["trials"]
    shown = [variants["id"].index(one) for one in (decision["chosen"], decision["runner_up"]) if one is not None]
    rows: dict[int, list[int]] = {place: [] for place in shown}
    for row, place in enumerate(trials["variant"]):
        if place in rows:
            rows[place].append(row)
    named = (
        "" if document["study_file"] == document["default_study"] else f" --study {shlex.quote(document['study_file'])}"
    )
    return [
        {
            "trials": [
                _figure(document, place, trials["key"][row], "")
                | {"replay": f"rgss replay {trials['key'][row]}{named}"}
                for row in rows[place][:_MOST_REPLAYS]
            ],
            "more": max(0, len(rows[place]) - _MOST_REPLAYS),
            "to": _figure(document, place, "trials", "")["to"],
        }
        for place in shown
    ]


def _figure(document: Mapping[str, Any], place: int, name: str, text: str) -> dict[str, str]:
    return {"text": text, "to": f"#variant-{document['variants']['id'][place]}/{quote(name, safe='')}"}


def _estimate(measure: Mapping[str, Any], place: int) -> str:
    value, low, high = (entry_at(measure.get(name), place) for name in ("value", "low", "high"))
    text = entry_text(value, measure["unit"])
    return text if low is None or high is None or low == high else f"{text} ({entry_text(low)} to {entry_text(high)})"
