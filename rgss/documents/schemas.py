"""JSON Schema of a typed model, as editors need it.

Editors check YAML against draft 7 and show the descriptions that they find. The schema that pydantic derives from a
model is converted: names of classes are left out, fixed rows become what draft 7
calls them, and every key gets its description.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

from rgss.documents.model import DocumentModel

DRAFT = "http://json-schema.org/draft-07/schema#"

KeyTexts = Mapping[str, Mapping[str, str]]
"""What each key means: by the name of the model, then by the key."""

_ENDING = re.compile(r"(?<=.)(Entry|File|Model)$")
_Schema = dict[str, Any]
_OF_NAMED = ("properties", "patternProperties", "$defs")
_OF_LISTED = ("anyOf", "oneOf", "allOf", "prefixItems")
_OF_ONE = ("items", "additionalProperties", "propertyNames", "not")


def json_schema(model: type[DocumentModel], *, title: str, texts: KeyTexts) -> dict[str, Any]:
    """The JSON Schema (draft 7) of the documents that a model reads.

    Args:
        model: The model of a whole document.
        title: Title of the document, in a few words.
        texts: Description of each key; the model's own comes first.

    Returns:
        Plain data that can be written as JSON. What it refuses the model refuses too; the model also knows
        units and what keys say of each other.
    """
    schema = model.model_json_schema(mode="validation")
    for name, definition in (
        (model.__name__, schema),
        *((key.rpartition("__")[2], inner) for key, inner in schema.get("$defs", {}).items()),
    ):
        _describe(definition, texts.get(name, {}))
    names = _plain_names(schema.get("$defs", {}))
    _adapt(schema, names)
    definitions = {names[name]: inner for name, inner in schema.pop("$defs", {}).items()}
    description = schema.pop("description", "")
    head = {"$schema": DRAFT, "title": title, "description": description}
    return {**head, **schema, **({"definitions": definitions} if definitions else {})}


def _describe(definition: _Schema, texts: Mapping[str, str]) -> None:
    for key, inner in definition.get("properties", {}).items():
        # A field may carry its text itself, which the texts then repeat.
        if key in texts and inner.get("description") != texts[key]:
            own = [inner["description"]] if "description" in inner else []
            inner["description"] = " ".join([texts[key], *own])


def _plain_names(definitions: Mapping[str, Any]) -> dict[str, str]:
    """The names of models without what every one of them ends in; editors offer them."""
    plain = {name: _ENDING.sub("", name) for name in definitions}
    taken = Counter(plain.values())
    return {name: short if taken[short] == 1 else name for name, short in plain.items()}


def _adapt(schema: _Schema, names: Mapping[str, str]) -> None:
    """Bring a schema and all within it into the form of draft 7, in place."""
    for inner in _parts(schema):
        _adapt(inner, names)
    # Names of classes and their attributes: nothing that a writer of YAML should read.
    schema.pop("title", None)
    schema.pop("discriminator", None)
    if "description" in schema:
        # The attributes of a dataclass have descriptions of their own.
        described = schema["description"].partition("\n\nAttributes:\n")[0]
        schema["description"] = " ".join(described.replace("``", "`").split())
    if "default" in schema and not _is_written_so(schema):
        del schema["default"]
    if "patternProperties" in schema:
        schema.setdefault("additionalProperties", False)
    if "prefixItems" in schema:
        _fix_row(schema)
    if "$ref" in schema:
        reference = f"#/definitions/{names[schema.pop('$ref').removeprefix('#/$defs/')]}"
        # In draft 7 nothing beside a reference counts.
        schema.update({"allOf": [{"$ref": reference}]} if schema else {"$ref": reference})


def _parts(schema: _Schema) -> Iterator[_Schema]:
    for key in _OF_NAMED:
        yield from schema.get(key, {}).values()
    for key in _OF_LISTED:
        yield from schema.get(key, ())
    for key in _OF_ONE:
        if isinstance(schema.get(key), dict):
            yield schema[key]


def _is_written_so(schema: _Schema) -> bool:
    """True if a default looks in a document as it does inside, so that an editor may offer it."""
    default = schema["default"]
    if isinstance(default, bool):
        return True
    if isinstance(default, (int, float)):
        return schema.get("type") != "string"
    return isinstance(default, str)


def _fix_row(schema: _Schema) -> None:
    """A row of a fixed length: one schema for all its entries if they are alike."""
    entries = schema.pop("prefixItems")
    schema.setdefault("minItems", len(entries))
    schema.setdefault("maxItems", len(entries))
    schema["items"] = entries[0] if all(entry == entries[0] for entry in entries) else entries
