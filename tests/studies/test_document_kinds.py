"""The schemas of the documents, against every document that is shipped and many that are wrong."""

from __future__ import annotations

import copy
import json
import re
from pathlib import Path

import pytest
from jsonschema import Draft7Validator
from pydantic import ValidationError

from rgss.documents import read_document
from rgss.errors import DefinitionError
from rgss.quantities import parse_quantity
from rgss.scenes import GRIPPER_KINDS
from rgss.studies import FOLDERS
from rgss.studies.scaffolding import write_scaffold
from rgss.studies.schemas.document_kinds import DOCUMENT_KINDS, document_kind, key_texts, kind_of
from tests.fixtures.document_keys import possible_keys

REPOSITORY = Path(__file__).parents[2]
NOT_STRUCTURE = {"quantity", "value_error"}
"""Kinds of problems of which a schema knows nothing: units, and what keys say of each other."""

RULES = {"rules": {"wording.R7": {"terms_added": ["smooth"], "enabled": False, "reason": "So it is."}}}
REVIEWS = {"reviews": {"SYS-1": {"digest": "0" * 64, "reviewer": "A. Reader", "upstream": {"STK-2": "f" * 64}}}}
RICH_STUDY = {
    "fidelity": ["kinematic", "contact"],
    "promotion": {"keep": 3, "within": "5 %"},
    "trade_off": {
        "values": [
            {"measure": "a", "weight": 0.5, "worst": {"requirement": "SYS-1", "times": 2}, "best": "1 kg"},
            {"criterion": "b", "of": [{"measure": "c", "rank": 1, "between": [{"at": 3, "worth": 0.5}]}]},
        ],
        "decide_by": {"program": "lexicographic", "order": [{"measure": "a", "relative": "5 %"}]},
        "chance": [{"requirement": "SYS-1", "probability": 0.9}],
        "portfolio": {"at_most": 1, "studies": [{"study": "studies/a.yaml", "weight": 1}]},
    },
}


def shipped() -> dict[str, object]:
    files = [path for name in FOLDERS for path in sorted((REPOSITORY / name).rglob("*.yaml"))]
    return {path.relative_to(REPOSITORY).as_posix(): read_document(path).data for path in files}


SHIPPED = shipped()
# Names of uncertain quantities and of planners are looked up after the structure is read, so not these two sections.
NOMINAL_STUDY = SHIPPED["studies/nominal_world.yaml"]
SMALL_STUDY = {**NOMINAL_STUDY, "assumptions": []}
# Only the first entry of a list is spoilt, and each metric is compared with a hundred names.
GUARDED = SHIPPED["studies/pick_place.yaml"]["regression"]
SMALL_GUARD = {**GUARDED, "runs": GUARDED["runs"][:2], "metrics": GUARDED["metrics"][:2]}


def beginning_of(name):
    """A document with the first two entries of each of its lists."""
    return {key: value[:2] if isinstance(value, list) else value for key, value in SHIPPED[name].items()}


def wrong_ways(data):
    """A document with one part spoilt, over and over: a key more, a key less, another kind of value."""
    for place in places(data):
        yield from spoilt(data, place)


def places(data, place=()):
    yield place
    if isinstance(data, dict):
        for key, value in data.items():
            yield from places(value, (*place, key))
    elif isinstance(data, list):
        for index, value in enumerate(data[:1]):
            yield from places(value, (*place, index))


def spoilt(data, place):
    for value in ([], {}, "no such thing", "", "  ", 7, -1, 0.5, True, None):
        yield replaced(data, place, lambda _, value=value: value)
    yield replaced(data, place, lambda old: {**old, "surprise": 1} if isinstance(old, dict) else old)
    yield replaced(data, place, lambda old: {**old, "9 lives": 1} if isinstance(old, dict) else old)
    yield replaced(data, place, lambda old: dict(list(old.items())[1:]) if isinstance(old, dict) else old)
    yield replaced(data, place, lambda old: old[:1] if isinstance(old, list) else old)
    yield replaced(data, place, lambda old: [*old, *old[:1]] if isinstance(old, list) else old)


def replaced(data, place, change):
    if not place:
        return change(data)
    result = copy.copy(data)
    result[place[0]] = replaced(data[place[0]], place[1:], change)
    return result


def loader_error(kind, data) -> ValidationError | None:
    try:
        kind.model.model_validate_json(json.dumps(data))
    except ValidationError as error:
        return error
    return None


@pytest.mark.parametrize("kind", DOCUMENT_KINDS, ids=lambda kind: kind.id)
def test_schemas_are_schemas_of_draft_7(kind):
    schema = kind.schema()

    Draft7Validator.check_schema(schema)
    assert schema["title"] == kind.title
    assert json.loads(kind.schema_text()) == schema
    assert "$defs" not in kind.schema_text()
    assert not re.search(r'"\w+(Entry|File|Model)"', kind.schema_text())  # names of classes say nothing to a writer


@pytest.mark.parametrize("name", SHIPPED)
def test_every_shipped_document_fits_its_schema(name):
    kind = kind_of(name, SHIPPED[name])

    assert kind is not None
    assert [error.message for error in Draft7Validator(kind.schema()).iter_errors(SHIPPED[name])] == []


def test_every_document_of_a_new_project_fits_its_schema(tmp_path):
    for name in write_scaffold(tmp_path):
        if name.endswith(".yaml"):
            data = read_document(tmp_path / name).data
            schema = json.loads((tmp_path / "schemas" / f"{kind_of(name, data).id}.schema.json").read_text())
            assert list(Draft7Validator(schema).iter_errors(data)) == [], name


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("stakeholder", {"requirements": SHIPPED["requirements/stakeholder.yaml"]["requirements"][2:4]}),
        ("system", {"requirements": SHIPPED["requirements/system/2-gripper.yaml"]["requirements"][3:5]}),
        ("architecture", {"blocks": SHIPPED["requirements/architecture/structure.yaml"]["blocks"][:2]}),
        ("architecture", {"behaviours": SHIPPED["requirements/architecture/task_sequences.yaml"]["behaviours"][:1]}),
        ("architecture", SHIPPED["requirements/architecture/simulation_states.yaml"]),
        ("measures", beginning_of("requirements/measures.yaml")),
        ("rules", RULES),
        ("reviews", REVIEWS),
        ("design-space", beginning_of("designs/grasping_system.yaml")),
        ("catalogue", beginning_of("designs/catalogue.yaml")),
        ("scene", beginning_of("scenes/restaurant.yaml")),
        ("robot", SHIPPED["scenes/robots/ur10.yaml"]),
        ("gripper", SHIPPED["scenes/grippers/kg-2.yaml"]),
        ("study", {**NOMINAL_STUDY, "regression": None}),
        ("study", {**SMALL_STUDY, **RICH_STUDY, "regression": SMALL_GUARD}),
    ],
)
def test_a_schema_refuses_what_the_loader_refuses_and_nothing_else(name, data):
    kind = document_kind(name)
    validator = Draft7Validator(kind.schema())
    assert loader_error(kind, data) is None
    assert validator.is_valid(data)

    refused = 0
    for wrong in wrong_ways(data):
        error = loader_error(kind, wrong)
        accepted = validator.is_valid(wrong)
        assert accepted or error, f"refused by the schema alone: {next(validator.iter_errors(wrong)).message}"
        if accepted and error:
            structural = {problem["type"] for problem in error.errors()} - NOT_STRUCTURE
            assert not structural, f"refused by the loader alone: {error}"
        refused += not accepted
    assert refused > 15


def test_every_key_is_described_and_no_text_is_left_over():
    keys: dict[str, set[str]] = {}
    for kind in DOCUMENT_KINDS:
        for model, names in possible_keys(kind.model).items():
            keys.setdefault(model, set()).update(names)
    texts = {model: set(of_model) for model, of_model in key_texts().items()}

    silent = {model: sorted(names - texts.get(model, set())) for model, names in keys.items()}
    left_over = {model: sorted(names - keys.get(model, set())) for model, names in texts.items()}
    assert {model: names for model, names in silent.items() if names} == {}, "say in field_descriptions.yaml"
    assert {model: names for model, names in left_over.items() if names} == {}


@pytest.mark.parametrize("kind", DOCUMENT_KINDS, ids=lambda kind: kind.id)
def test_descriptions_are_prose(kind):
    assert "Attributes:" not in json.dumps(kind.schema())


def test_descriptions_reach_the_keys():
    body = document_kind("scene").schema()["definitions"]["Body"]["properties"]

    assert body["foot"]["description"].startswith("Centre of its bottom face in the world")
    assert "A quantity in rad" in body["yaw"]["description"]
    assert body["yaw"]["errorMessage"] == "write a number and a unit, such as 90 deg"
    assert "default" not in body["yaw"]  # 0.0 inside, but a text with a unit in a document
    assert document_kind("study").schema()["definitions"]["Planning"]["properties"]["clock"]["enum"] == [
        "counted",
        "wall",
    ]


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        ("120 mm", True),
        ("-.5e-3m", True),
        ("  3. µm ", True),
        ("1 m/s^2", False),
        ("12", False),
        ("mm", False),
        ("1,2 m", False),
        ("1 2 m", False),
        ("", False),
    ],
)
def test_quantities_look_the_same_to_schema_and_reader(text, is_one):
    schema = document_kind("scene").schema()["definitions"]["Cylinder"]["properties"]["radius"]
    looks = Draft7Validator(schema).is_valid(text)
    try:
        reads = bool(parse_quantity(text, "m")) or True
    except ValueError:
        reads = False

    assert reads is is_one
    assert looks or not reads
    assert looks is (is_one or text == "1 m/s^2")  # units are the reader's affair


def test_kinds_of_files():
    assert kind_of("requirements/system/2-gripper.yaml", {}).id == "system"
    assert kind_of("requirements/rules.yaml", None).id == "rules"
    assert kind_of("requirements/notes.yaml", {}) is None
    assert kind_of("scenes/a.yaml", {"scene": "a", "robot": {}, "bodies": []}).id == "scene"
    assert kind_of("scenes/a.yaml", ["robot"]) is None
    assert kind_of("elsewhere/a.yaml", {"study": "a"}) is None


@pytest.mark.parametrize("kind", GRIPPER_KINDS.values(), ids=lambda kind: kind.name)
def test_a_key_tells_the_files_of_each_kind_of_gripper_apart(kind):
    others = [one for one in GRIPPER_KINDS.values() if one is not kind]

    assert kind.model.model_fields[kind.own_key].is_required()
    assert all(kind.own_key not in one.model.model_fields for one in others)
    assert kind_of("scenes/grippers/a.yaml", {"gripper": "a", kind.own_key: {}}).model is kind.model


def test_an_unknown_kind():
    with pytest.raises(DefinitionError, match="unknown document 'scenes'") as caught:
        document_kind("scenes")
    assert caught.value.hint.startswith("documents: stakeholder, system, architecture, measures")
