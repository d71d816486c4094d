"""Plain data to a typed model, with each problem at its line and column."""

from __future__ import annotations

import difflib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from pydantic import BaseModel, ValidationError

from rgss.documents.model import DocumentModel
from rgss.documents.reader import Document, read_document
from rgss.errors import DocumentError
from rgss.findings import Finding

Model = TypeVar("Model", bound=DocumentModel)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedDocument(Generic[Model]):
    """A file as its typed model, together with the positions that later findings need.

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
        model: What the file should be.
        label: The file's name in messages; the path itself by default.

    Raises:
        DocumentError: The file is not the model; with every problem in it.
    """
    document = read_document(path, label=label)
    try:
        value = model.model_validate_json(json.dumps(document.data))
    except ValidationError as error:
        findings = {_finding(document, model, problem) for problem in error.errors(include_url=False)}
        raise DocumentError(sorted(findings)) from error
    return LoadedDocument(value=value, document=document)


def _finding(document: Document, model: type[BaseModel], problem: Mapping[str, Any]) -> Finding:
    location = problem["loc"]
    kind = problem["type"]
    if kind == "extra_forbidden":
        key = str(location[-1])
        names = _siblings(problem, model)
        near = difflib.get_close_matches(key, names, n=1)
        hint = f"did you mean {near[0]!r}?" if near else f"known keys: {', '.join(names)}" if names else ""
        return document.finding("document.unknown-key", f"unknown key {key!r}", location, hint=hint, at_key=True)
    if kind == "missing":
        key = str(location[-1])
        return document.finding("document.missing-key", f"key {key!r} is missing", location[:-1], hint=f"add {key!r}")
    message = _in_our_words(kind, problem)
    hint = str(problem.get("ctx", {}).get("hint", ""))
    name = next((str(part) for part in reversed(location) if isinstance(part, str)), "")
    return document.finding("document.value", f"{name}: {message}" if name else message, location, hint=hint)


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
    "string_too_short": "a text that is not empty is expected",
}


def _in_our_words(kind: str, problem: Mapping[str, Any]) -> str:
    if kind in _WORDS:
        return _WORDS[kind]
    context = problem.get("ctx", {})
    if kind in ("enum", "literal_error"):
        return f"{_shown(problem['input'])} is not one of {context.get('expected', '')}"
    if kind == "string_pattern_mismatch":
        return f"{_shown(problem['input'])} is not an identifier (a letter, then letters, digits, '_', '.', '-')"
    if kind == "too_short":
        return f"at least {context['min_length']} entries are expected"
    if kind == "value_error":
        return str(context.get("error", problem["msg"]))
    message = str(problem["msg"])
    return message[:1].lower() + message[1:]


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:59] + "…"


def _siblings(problem: Mapping[str, Any], model: type[BaseModel]) -> list[str]:
    """The keys that the mapping around an unknown key may have."""
    kinds: list[Any] = [model]
    for part in problem["loc"][:-1]:
        if isinstance(part, int):
            continue
        found = [
            kind.model_fields[name].annotation
            for kind in kinds
            for name in kind.model_fields
            if part in (name, kind.model_fields[name].alias)
        ]
        kinds = _models_in(found) if found else kinds
    names: dict[str, None] = {}
    for kind in kinds:
        names.update({field.alias or name: None for name, field in kind.model_fields.items()})
    return sorted(names)


def _models_in(annotations: list[Any]) -> list[Any]:
    found: list[Any] = []
    queue = list(annotations)
    while queue:
        annotation = queue.pop()
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            found.append(annotation)
        queue.extend(getattr(annotation, "__args__", ()))
    return found
