"""From a typed model to the JSON Schema that editors want."""

from __future__ import annotations

from enum import Enum
from typing import Annotated

from jsonschema import Draft7Validator
from pydantic import Field

from rgss.documents import Dimensionless, DocumentModel, Identifier, Metres, Text, json_schema


class Colour(str, Enum):
    """A ``colour``
    of two."""

    RED = "red"
    BLUE = "blue"


class Leaf(DocumentModel):
    """A leaf."""

    at: tuple[Metres, Metres]
    pair: tuple[Metres, Text] | None = None
    share: Dimensionless = 0.5
    width: Metres = 0.1
    colour: Colour = Colour.RED
    title: Text = "none"


class Tree(DocumentModel):
    """A tree."""

    leaves: Annotated[tuple[Leaf, ...], Field(min_length=1)]
    by_name: dict[Identifier, Leaf] = Field(default_factory=dict)
    best: Leaf | None = None
    first: Leaf


SCHEMA = json_schema(
    Tree, title="Tree of a test", texts={"Tree": {"first": "The first one."}, "Leaf": {"at": "Where it is."}}
)
LEAF = {"at": ["1 m", "2 mm"]}


def accepts(**changed) -> bool:
    return Draft7Validator(SCHEMA).is_valid({"leaves": [LEAF], "first": LEAF, **changed})


def test_the_head():
    Draft7Validator.check_schema(SCHEMA)
    assert list(SCHEMA)[:3] == ["$schema", "title", "description"]
    assert (SCHEMA["title"], SCHEMA["description"]) == ("Tree of a test", "A tree.")
    assert set(SCHEMA["definitions"]) == {"Leaf", "Colour"}


def test_what_is_accepted():
    assert accepts()
    assert accepts(best=None)
    assert accepts(by_name={"a": LEAF})
    assert accepts(first={**LEAF, "share": "50 %", "colour": "blue", "pair": ["1 m", "text"]})
    assert not accepts(leaves=[])
    assert not accepts(surprise=1)
    assert not accepts(first=None)
    assert not accepts(by_name={"9 lives": LEAF})
    assert not accepts(first={"at": ["1 m"]})
    assert not accepts(first={"at": ["1 m"] * 3})
    assert not accepts(first={"at": ["1 m", 2]})
    assert not accepts(first={**LEAF, "pair": ["1 m", "text", "more"]})
    assert not accepts(first={**LEAF, "pair": ["1 m"]})
    assert not accepts(first={**LEAF, "share": "half"})
    assert not accepts(first={**LEAF, "colour": "green"})


def test_texts_stand_beside_references_where_editors_see_them():
    first = SCHEMA["properties"]["first"]

    assert first == {"description": "The first one.", "allOf": [{"$ref": "#/definitions/Leaf"}]}
    at = SCHEMA["definitions"]["Leaf"]["properties"]["at"]
    assert at["description"] == "Where it is."
    assert isinstance(at["items"], dict)
    assert SCHEMA["definitions"]["Colour"]["description"] == "A `colour` of two."


def test_defaults_are_those_that_may_be_written():
    keys = SCHEMA["definitions"]["Leaf"]["properties"]

    assert keys["share"]["default"] == 0.5
    assert keys["colour"]["default"] == "red"
    assert keys["title"]["default"] == "none"  # a key of that name, not the name of a class
    assert "default" not in keys["width"]
    assert "default" not in keys["pair"]
    assert "title" not in keys["width"]


class LeafEntry(DocumentModel):
    """Another leaf."""

    leaf: Leaf


class LoneEntry(DocumentModel):
    """A part whose short name is free."""

    leaf: LeafEntry


class Wood(DocumentModel):
    """A wood."""

    lone: LoneEntry
    leaf: Leaf


def test_names_lose_their_ending_where_that_is_clear():
    schema = json_schema(Wood, title="Wood", texts={})

    assert set(schema["definitions"]) == {"Leaf", "LeafEntry", "Lone", "Colour"}
    assert Draft7Validator(schema).is_valid({"lone": {"leaf": {"leaf": LEAF}}, "leaf": LEAF})
    assert not Draft7Validator(schema).is_valid({"lone": {"leaf": LEAF}, "leaf": LEAF})
