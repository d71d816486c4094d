"""JSON Schema of a document model, for editors.

Editors validate YAML by draft 7 and show descriptions. The schema that pydantic derives from a model is converted:
names of classes are removed, fixed-length arrays are expressed in draft 7, and every key gets its description.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

from rgss.documents.model import DocumentModel

DRAFT = "http://json-schema.org/draft-07/schema#"

KeyTexts = Mapping[str, Mapping[str, str]]
"""Descriptions of keys: by the name of the model, then by the key."""

_ENDING = re.compile(r"(?<=.)(Entry|File|Model)$")
_Schema = dict[str, Any]
_OF_NAMED = ("properties", "patternProperties", "$defs")
_OF_LISTED = ("anyOf", "oneOf", "allOf", "prefixItems")
_OF_ONE = ("items", "additionalProperties", "propertyNames", "not")


def json_schema(model: type[DocumentModel], *, title: str, texts: KeyTexts) -> dict[str, Any]:
    """JSON Schema (draft 7) of a document model.

    Args:
        model: The model of a whole document.
        title: Short title of the document.
        texts: Description of each key; the model's own has precedence.

    Returns:
        Plain data that can be written as JSON. Documents that it rejects are rejected by the model too; the model also
        checks units and relations between keys.
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
        # A field may have its own text, which the texts then repeat.
        if key in texts and inner.get("description") != texts[key]:
            own = [inner["description"]] if "description" in inner else []
            inner["description"] = " ".join([texts[key], *own])


def _plain_names(definitions: Mapping[str, Any]) -> dict[str, str]:
    """Names of models without their common suffix, for completion in editors."""
    plain = {name: _ENDING.sub("", name) for name in definitions}
    taken = Counter(plain.values())
    return {name: short if taken[short] == 1 else name for name, short in plain.items()}


def _adapt(schema: _Schema, names: Mapping[str, str]) -> None:
    """Convert a schema and all nested schemas to draft 7, in place."""
    for inner in _parts(schema):
        _adapt(inner, names)
    # Names of classes and their attributes are not of use to authors of YAML.
    schema.pop("title", None)
    schema.pop("discriminator", None)
    if "description" in schema:
        # The attributes of a dataclass have their own descriptions.
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
        # In draft 7 all keywords beside a reference are ignored.
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
    """True if a default has the same form in a document, so that an editor may offer it."""
    default = schema["default"]
    if isinstance(default, bool):
        return True
    if isinstance(default, (int, float)):
        return schema.get("type") != "string"
    return isinstance(default, str)


def _fix_row(schema: _Schema) -> None:
    """Fixed-length array: one schema for all entries if they are equal."""
    entries = schema.pop("prefixItems")
    schema.setdefault("minItems", len(entries))
    schema.setdefault("maxItems", len(entries))
    schema["items"] = entries[0] if all(entry == entries[0] for entry in entries) else entries
