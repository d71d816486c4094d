"""First problems of a file with too many to list."""

from __future__ import annotations

import json
from typing import Any

from pydantic import BaseModel, ValidationError

from rgss.documents.composing import MOST_VALUES
from rgss.documents.reader import Document
from rgss.documents.refusals import MOST_PROBLEMS

_MOST_LISTED = 20 * MOST_PROBLEMS


def first_problems(document: Document, model: type[BaseModel], error: ValidationError) -> list[Any]:
    """Problems of a file in the form of pydantic; if there are too many, the first ones in the file's order.

    Listing millions of problems takes gigabytes, counting them does not. With so many only the beginning of the file is
    validated.
    """
    counted = error if error.error_count() <= _MOST_LISTED else _with_fewer(document.data, model, error)
    problems: list[Any] = list(counted.errors(include_url=False))
    if len(problems) > MOST_PROBLEMS:
        # One more than are shown, to detect that there are more.
        problems.sort(key=lambda problem: document.values[document.nearest(problem["loc"])])
        del problems[MOST_PROBLEMS + 1 :]
    return problems


def _with_fewer(data: Any, model: type[BaseModel], error: ValidationError) -> ValidationError:
    """Problems of a beginning of the file with more than are shown, but not many more."""
    few, entries = 0, 1
    found = _problems_of_beginning(data, model, entries)
    while not _are_enough(found) and entries < MOST_VALUES:
        few, entries = entries, 2 * entries
        found = _problems_of_beginning(data, model, entries)
    while found is not None and found.error_count() > _MOST_LISTED and entries - few > 1:
        middle = (few + entries) // 2
        fewer = _problems_of_beginning(data, model, middle)
        if _are_enough(fewer):
            entries, found = middle, fewer
        else:
            few = middle
    return found if found is not None else error


def _are_enough(error: ValidationError | None) -> bool:
    return error is not None and error.error_count() > MOST_PROBLEMS


def _problems_of_beginning(data: Any, model: type[BaseModel], entries: int) -> ValidationError | None:
    try:
        model.model_validate_json(json.dumps(_beginning(data, [entries])))
    except ValidationError as error:
        return error
    return None


def _beginning(data: Any, room: list[int]) -> Any:
    """Data truncated after a number of list entries; mappings are kept whole."""
    if isinstance(data, dict):
        return {key: _beginning(value, room) for key, value in data.items()}
    if not isinstance(data, list):
        return data
    kept = []
    for item in data:
        if room[0] <= 0:
            break
        room[0] -= 1
        kept.append(_beginning(item, room))
    return kept
