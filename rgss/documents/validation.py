"""Validation of plain data by a typed model, with each problem at its line and column."""

from __future__ import annotations

import difflib
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, Generic, TypeVar, Union, get_args, get_origin

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic.dataclasses import is_pydantic_dataclass
from pydantic.fields import FieldInfo

from rgss.documents.fields import IDENTIFIER_PATTERN, ReadFrom
from rgss.documents.model import DocumentModel
from rgss.documents.positions import Location
from rgss.documents.problems import first_problems
from rgss.documents.reader import Document, read_document
from rgss.documents.refusals import MOST_PROBLEMS, cut_short
from rgss.errors import DocumentError
from rgss.findings import Finding, shown

# What follows a comma of a number within braces, such as 000 USD of {threshold: 43,000 USD}.
_AFTER_COMMA = re.compile(r"[0-9]+(?:\.[0-9]+)?(?:\s*[^\W\d_].*|\s*[%$°€£].*)?")

Model = TypeVar("Model", bound=DocumentModel)
Entry = TypeVar("Entry")


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedDocument(Generic[Model]):
    """File as its typed model, with the positions for later findings.

    Attributes:
        value: The typed content.
        document: The plain data and the positions.
    """

    value: Model
    document: Document


def load_document(path: Path, model: type[Model], *, label: str | None = None) -> LoadedDocument[Model]:
    """Read a YAML file into a typed model.

    Args:
        path: The file.
        model: Type of the file.
        label: The file's name in messages; the path itself by default.

    Raises:
        DocumentError: The file does not satisfy the model; with every problem in it.
    """
    return typed_document(read_document(path, label=label), model)


def typed_document(document: Document, model: type[Model]) -> LoadedDocument[Model]:
    """A document that was read, as a typed model.

    Args:
        document: The document.
        model: Type of the file.

    Raises:
        DocumentError: The file does not satisfy the model; with every problem in it.
    """
    try:
        value = model.model_validate_json(json.dumps(document.data))
    except ValidationError as error:
        problems = _own_problems(first_problems(document, model, error), model)
        findings = {_finding(document, model, problem) for problem in problems}
        raise DocumentError(cut_short(document.label, [*findings])) from error
    return LoadedDocument(value=value, document=document)


def validated(data: Any, kind: type[Entry]) -> tuple[Entry | None, tuple[tuple[Location, str], ...]]:
    """Validate plain data that are not from a YAML file.

    Args:
        data: Mappings, lists, texts, numbers, truth values and None.
        kind: A model or a pydantic dataclass: the expected type.

    Returns:
        The value, None if the data are invalid; and each problem with its location in the data.
    """
    try:
        return TypeAdapter(kind).validate_json(json.dumps(data)), ()
    except ValidationError as error:
        problems = error.errors(include_url=False)[:MOST_PROBLEMS]
        return None, tuple((problem["loc"], _short_message(problem)) for problem in problems)


def _short_message(problem: Any) -> str:
    missing = problem["type"] == "missing" and isinstance(problem["loc"][-1], str)
    return "is missing" if missing else _message_of(problem["type"], problem)


def _own_problems(problems: Sequence[Any], model: type[BaseModel]) -> list[Any]:
    """Problems without consequences of others.

    A tuple with invalid entries is also reported as too short, because it has no valid entry; a misspelt key is
    unknown, and the correct one missing.
    """
    around = {problem["loc"][:length] for problem in problems for length in range(len(problem["loc"]))}
    misspelt = {
        (*problem["loc"][:-1], near)
        for problem in problems
        if problem["type"] in _UNKNOWN_KEY
        for near in _near_keys(problem["loc"], model)
    }

    def is_own(problem: Any) -> bool:
        if problem["type"] == "missing":
            return problem["loc"] not in misspelt
        return problem["type"] != "too_short" or problem["loc"] not in around

    return [problem for problem in problems if is_own(problem)]


def _finding(document: Document, model: type[BaseModel], problem: Mapping[str, Any]) -> Finding:
    location: tuple[str | int, ...] = problem["loc"]
    kind = problem["type"]
    context = problem.get("ctx", {})
    if kind in _UNKNOWN_KEY:
        return _unknown_key(document, model, location, is_bare=problem.get("input") is None)
    if kind == "union_tag_not_found":
        kind, location = "missing", (*location, context["discriminator"].strip("'"))
    if kind == "missing" and isinstance(location[-1], str):
        key = location[-1]
        return document.finding("document.missing-key", f"key {key!r} is missing", location[:-1], hint=f"add {key!r}")
    if kind == "union_tag_invalid":
        location = (*location, context["discriminator"].strip("'"))
    message = _message_of(kind, problem)
    name = next((part for part in reversed(document.nearest(location)) if isinstance(part, str)), "")
    return document.finding(
        "document.value", f"{name}: {message}" if name else message, location, hint=str(context.get("hint", ""))
    )


def _unknown_key(
    document: Document, model: type[BaseModel], location: tuple[str | int, ...], *, is_bare: bool
) -> Finding:
    key = str(location[-1])
    if is_bare and _AFTER_COMMA.fullmatch(key):
        message = f"a comma ends a value within braces, so that {shown(key)} is read as a key"
        hint = "write numbers without commas, such as 43000 USD or 0.5 kg"
        return document.finding("document.unknown-key", message, location, hint=hint, at_key=True)
    names = _siblings(location, model)
    near = _near_keys(location, model)
    hint = f"did you mean {near[0]!r}?" if near else f"known keys: {', '.join(names)}" if names else ""
    return document.finding("document.unknown-key", f"unknown key {shown(key)}", location, hint=hint, at_key=True)


def _near_keys(location: tuple[str | int, ...], model: type[BaseModel]) -> list[str]:
    """Keys most similar to an unknown key; empty if none is similar."""
    return difflib.get_close_matches(str(location[-1]), _siblings(location, model), n=1)


_UNKNOWN_KEY = ("extra_forbidden", "unexpected_keyword_argument")
"""Problem types of unknown keys in a model or a pydantic dataclass."""

_WORDS: Mapping[str, str] = {
    "string_type": "a text is expected",
    "float_type": "a number is expected",
    "int_type": "a whole number is expected",
    "bool_type": "true or false is expected",
    "tuple_type": "a list is expected",
    "list_type": "a list is expected",
    "dict_type": "a mapping is expected",
    "model_type": "a mapping is expected",
    "model_attributes_type": "a mapping is expected",
    "dataclass_type": "a mapping is expected",
    "string_too_short": "a text that is not empty is expected",
}


def _message_of(kind: str, problem: Mapping[str, Any]) -> str:
    if kind in _WORDS:
        return _WORDS[kind]
    context = problem.get("ctx", {})
    if kind in ("enum", "literal_error"):
        return f"{shown(problem['input'])} is not one of {context['expected']}"
    if kind == "union_tag_invalid":
        return f"{shown(context['tag'])} is not one of {context['expected_tags']}"
    if kind == "string_pattern_mismatch":
        if context["pattern"] == IDENTIFIER_PATTERN:
            return f"{shown(problem['input'])} is not an identifier (a letter, then letters, digits, '_', '.', '-')"
        return f"{shown(problem['input'])} does not match {context['pattern']}"
    if kind == "missing":
        return f"entry {problem['loc'][-1] + 1} is missing"
    if kind == "too_short":
        return f"at least {_entries(context['min_length'])} expected"
    if kind == "too_long":
        return f"at most {_entries(context['max_length'])} expected"
    if kind == "quantity":
        return str(context["message"])
    if kind == "value_error":
        return str(context["error"])
    message = str(problem["msg"])
    return message[:1].lower() + message[1:]


def _entries(count: int) -> str:
    return "1 entry is" if count == 1 else f"{count} entries are"


def _siblings(location: tuple[str | int, ...], model: type[BaseModel]) -> list[str]:
    """Allowed keys of the mapping with an unknown key."""
    kinds: list[Any] = [model]
    for part in location[:-1]:
        # A part without a position is the tag of a union, which is not a level of the file.
        kinds = _alternatives([inner for kind in kinds for inner in _inside(kind, part)]) or kinds
    return sorted({field.alias or name for kind in kinds for name, field in _fields_of(kind).items()})


def _fields_of(kind: Any) -> Mapping[str, FieldInfo]:
    """Fields of a model or a pydantic dataclass; empty for any other type."""
    if not isinstance(kind, type):
        return {}
    if issubclass(kind, BaseModel):
        return kind.model_fields
    return kind.__pydantic_fields__ if is_pydantic_dataclass(kind) else {}


def _inside(kind: Any, part: str | int) -> list[Any]:
    """Annotations of the values under a key or an index of a value of some kind."""
    if fields := _fields_of(kind):
        return [field.annotation for name, field in fields.items() if part in (name, field.alias)]
    origin, arguments = get_origin(kind), [each for each in get_args(kind) if each is not Ellipsis]
    if isinstance(origin, type) and issubclass(origin, Mapping):
        return arguments[1:] if isinstance(part, str) else []
    return arguments if isinstance(part, int) else []


def _alternatives(annotations: list[Any]) -> list[Any]:
    """Annotations with unions and Annotated flattened."""
    found: list[Any] = []
    for annotation in annotations:
        origin = get_origin(annotation)
        if origin is Annotated:
            written = [each.model for each in get_args(annotation)[1:] if isinstance(each, ReadFrom)]
            found += _alternatives(written or [get_args(annotation)[0]])
        elif origin is Union or origin is UnionType:
            found += _alternatives(list(get_args(annotation)))
        else:
            found.append(annotation)
    return found
