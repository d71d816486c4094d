"""From plain data to a typed model: each problem named in our words, at its place, all at once."""

from __future__ import annotations

from enum import Enum
from typing import Annotated, Literal

import pytest
from pydantic import Field, model_validator

from rgss.documents import DocumentModel, Identifier, Kilograms, Metres, Text, load_document
from rgss.errors import DocumentError


class Colour(str, Enum):
    RED = "red"
    BLUE = "blue"


class Box(DocumentModel):
    kind: Literal["box"]
    size: tuple[Metres, Metres]


class Ball(DocumentModel):
    kind: Literal["ball"]
    radius: Metres


Shape = Annotated[Box | Ball, Field(discriminator="kind")]


class Part(DocumentModel):
    id: Identifier
    mass: Kilograms | None = None
    shape: Shape | None = None
    colour: Colour = Colour.RED


class Limits(DocumentModel):
    low: int
    high: int

    @model_validator(mode="after")
    def ordered(self) -> Limits:
        if self.low > self.high:
            raise ValueError("low is above high")
        return self


class Assembly(DocumentModel):
    title: Text
    count: int = Field(default=1, ge=1)
    ratio: float = 0.5
    spare: bool = False
    parts: tuple[Part, ...] = Field(default=(), max_length=3)
    named: dict[str, Part] = Field(default_factory=dict)
    tags: Annotated[tuple[str, ...], Field(min_length=1)] | None = None
    limits: Limits | None = None
    code: Annotated[str, Field(pattern="^[A-Z]{3}$", max_length=3)] = "ABC"
    steps: tuple[int, ...] | None = Field(default=None, alias="step-list")


def problems(path):
    with pytest.raises(DocumentError) as caught:
        load_document(path, Assembly, label="a.yaml")
    return [str(finding).removeprefix("a.yaml:") for finding in caught.value.findings]


def test_a_good_file(write):
    loaded = load_document(
        write(
            "title: ' Hand '\ncount: 2\nratio: 1\nspare: true\nparts:\n  - id: finger\n    mass: 300 g\n"
            "    colour: blue\n    shape: {kind: box, size: [35 mm, 1 cm]}\nstep-list: [1, 2]\n"
        ),
        Assembly,
    )

    (finger,) = loaded.value.parts
    assert loaded.value.title == "Hand"
    assert (finger.mass, finger.colour, finger.shape) == (0.3, Colour.BLUE, Box(kind="box", size=("35 mm", "1 cm")))
    assert loaded.value.steps == (1, 2)
    assert loaded.document.values[("parts", 0, "mass")] == (7, 11)


NO_COMMAS = "(write numbers without commas, such as 43000 USD or 0.5 kg) [document.unknown-key]"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("tittle: a\ntitle: b", "1:1: error: unknown key 'tittle' (did you mean 'title'?) [document.unknown-key]"),
        (
            "title: a\nlimits: {low: 1, high: 2, q: 1}",
            "2:27: error: unknown key 'q' (known keys: high, low) [document.unknown-key]",
        ),
        (
            "title: a\nparts:\n  - id: a\n    mas: 1 kg",
            "4:5: error: unknown key 'mas' (did you mean 'mass'?) [document.unknown-key]",
        ),
        (
            "title: a\nnamed: {title: {id: a, mas: 1 kg}}",
            "2:24: error: unknown key 'mas' (did you mean 'mass'?) [document.unknown-key]",
        ),
        (
            "title: a\nparts: [{id: a, shape: {kind: ball, radius: 1 m, raduis: 1 m}}]",
            "2:50: error: unknown key 'raduis' (did you mean 'radius'?) [document.unknown-key]",
        ),
        ("title: a\nsteps: [1]", "2:1: error: unknown key 'steps' (did you mean 'step-list'?) [document.unknown-key]"),
        (
            "title: a\nlimits: {low: 43,000 USD, high: 2}",
            f"2:18: error: a comma ends a value within braces, so that '000 USD' is read as a key {NO_COMMAS}",
        ),
        (
            "title: a\nlimits: {high: 2, low: 0,5}",
            f"2:26: error: a comma ends a value within braces, so that '5' is read as a key {NO_COMMAS}",
        ),
        (
            "title: a\nlimits: {high: 2, low: 0, 5: 3}",
            "2:27: error: unknown key '5' (known keys: high, low) [document.unknown-key]",
        ),
        ("count: 1", "1:1: error: key 'title' is missing (add 'title') [document.missing-key]"),
        (
            "title: a\nparts:\n  - id: a\n  - mass: 1 kg",
            "4:5: error: key 'id' is missing (add 'id') [document.missing-key]",
        ),
        (
            "title: a\nparts: [{id: a, shape: {radius: 1 m}}]",
            "2:24: error: key 'kind' is missing (add 'kind') [document.missing-key]",
        ),
        (
            "title: a\nparts: [{id: a, shape: {kind: cone}}]",
            "2:31: error: kind: 'cone' is not one of 'box', 'ball' [document.value]",
        ),
        (
            "title: a\nparts: [{id: a, shape: {kind: box, size: [1 m]}}]",
            "2:42: error: size: entry 2 is missing [document.value]",
        ),
        (
            "title: a\nparts: [{id: a, shape: {kind: box, size: [1 m, 2 m, 3 m]}}]",
            "2:42: error: size: at most 2 entries are expected [document.value]",
        ),
        ("title: a\nparts: [{id: a, colour: green}]", "2:25: error: colour: 'green' is not one of 'red' or 'blue'"),
        ("title: 1", "1:8: error: title: a text is expected [document.value]"),
        ("title: ''", "1:8: error: title: a text that is not empty is expected [document.value]"),
        ("title: '  '", "1:8: error: title: a text that is not empty is expected [document.value]"),
        ("title:", "1:7: error: title: a text is expected [document.value]"),
        ("title: a\ncount: true", "2:8: error: count: a whole number is expected [document.value]"),
        ("title: a\ncount: 1.0", "2:8: error: count: a whole number is expected [document.value]"),
        ("title: a\ncount: 1e3", "2:8: error: count: a whole number is expected [document.value]"),
        ("title: a\ncount: '1'", "2:8: error: count: a whole number is expected [document.value]"),
        ("title: a\ncount: 0", "2:8: error: count: input should be greater than or equal to 1 [document.value]"),
        ("title: a\nratio: '0.5'", "2:8: error: ratio: a number is expected [document.value]"),
        ("title: a\nratio: true", "2:8: error: ratio: a number is expected [document.value]"),
        ("title: a\nratio: 1e999", "2:8: error: ratio: a number is expected [document.value]"),
        ("title: a\nspare: 1", "2:8: error: spare: true or false is expected [document.value]"),
        ("title: a\nspare: yes", "2:8: error: spare: true or false is expected [document.value]"),
        ("title: a\nparts: a", "2:8: error: parts: a list is expected [document.value]"),
        ("title: a\nparts: {id: a}", "2:8: error: parts: a list is expected [document.value]"),
        ("title: a\nparts: [a]", "2:9: error: parts: a mapping is expected [document.value]"),
        ("title: a\nnamed: [a]", "2:8: error: named: a mapping is expected [document.value]"),
        ("[1]", "1:1: error: a mapping is expected [document.value]"),
        ("just words", "1:1: error: a mapping is expected [document.value]"),
        ("title: a\ntags: []", "2:7: error: tags: at least 1 entry is expected [document.value]"),
        ("title: a\nlimits: {low: 2, high: 1}", "2:9: error: limits: low is above high [document.value]"),
        ("title: a\ncode: abc", "2:7: error: code: 'abc' does not match ^[A-Z]{3}$ [document.value]"),
        ("title: a\ncode: ABCD", "2:7: error: code: string should have at most 3 characters [document.value]"),
        (
            "title: a\nparts: [{id: 9lives}]",
            "2:14: error: id: '9lives' is not an identifier (a letter, then letters, digits, '_', '.', '-')",
        ),
        (
            'title: a\nparts: [{id: "a\\n"}]',
            "2:14: error: id: 'a\\n' is not an identifier (a letter, then letters, digits, '_', '.', '-')",
        ),
        (
            "title: a\nparts: [{id: a, mass: 3}]",
            "2:23: error: mass: '3' has no unit (write \"3 kg\") [document.value]",
        ),
        (
            "title: a\nparts: [{id: a, mass: 3 mm}]",
            "2:23: error: mass: unit 'mm' does not measure what 'kg' measures (give it in kg or a multiple of it)",
        ),
        (
            "title: a\nparts: [{id: a, mass: true}]",
            '2:23: error: mass: a quantity is expected (write a number and a unit, such as "1 kg") [document.value]',
        ),
    ],
)
def test_problem(write, text, expected):
    (problem,) = problems(write(text + "\n"))

    assert problem.startswith(expected)


def test_several_problems_at_once_in_the_order_of_their_places(write):
    text = "parts:\n  - {mass: heavy, id: a}\n  - {id: b, mass: 1 s}\n  - {ids: c}\nspare: maybe\ncuont: 2\n"

    assert [problem.partition(" (")[0] for problem in problems(write(text))] == [
        "1:1: error: key 'title' is missing",
        "2:12: error: mass: 'heavy' is not a quantity",
        "3:19: error: mass: unit 's' does not measure what 'kg' measures",
        "4:6: error: unknown key 'ids'",
        "5:8: error: spare: true or false is expected [document.value]",
        "6:1: error: unknown key 'cuont'",
    ]


def test_long_values_and_keys_are_shown_cut(write):
    for text in (f"title: a\ncode: {'x' * 500}\n", f"title: a\n{'k' * 500}: 1\n"):
        assert all(len(problem) < 200 for problem in problems(write(text)))


def test_braces_in_a_value_are_not_filled_in(write):
    (problem,) = problems(write("title: a\nparts: [{id: a, mass: '{hint} {message}'}]\n"))

    assert problem.startswith("2:23: error: mass: '{hint} {message}' is not a quantity (write a number and a unit")


def test_reading_problems_come_before_the_model_is_asked(write):
    (problem,) = problems(write("tittle: &a 1\n"))

    assert problem.endswith("[document.alias]")


def test_values_are_frozen(write):
    value = load_document(write("title: a\n"), Assembly).value

    with pytest.raises(ValueError, match="frozen"):
        value.title = "b"
