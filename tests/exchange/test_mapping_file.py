"""The file that maps the names of another tool."""

from __future__ import annotations

import pytest
from jsonschema import Draft7Validator

from rgss.documents import read_document
from rgss.errors import DocumentError
from rgss.exchange import MAPPING_KIND, Part, read_mapping

DOORS = """\
# Names of the supplier's DOORS.
attributes:
  Object Text: text
  Created On:
values:
  priority: {Mandatory: high, "1": low}
types: {Customer need: stakeholder}
defaults: {owner: gripper engineer}
"""


@pytest.fixture
def read(tmp_path):
    def of(text):
        (tmp_path / "doors.yaml").write_text(text, encoding="utf-8")
        return read_mapping(tmp_path / "doors.yaml")

    return of


def test_a_mapping_has_names_values_types_and_defaults(read):
    found = read(DOORS)
    assert found.names.target("OBJECT text") == "text"
    assert found.names.target("Created On") == ""
    assert found.names.target("Weight") is None
    assert found.names.value("priority", "mandatory") == "high"
    assert found.names.part_of_type("customer need") is Part.STAKEHOLDER
    assert found.defaults == {"owner": "gripper engineer"}


def test_an_empty_mapping_maps_nothing(read):
    assert not read("{}").names.is_given


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        (
            "Object Text: text",
            "Object Text: txt",
            "3:16: error: 'txt' is not an attribute of rgss (did you mean 'text'?)",
        ),
        ("priority:", "prio:", "6:3: error: 'prio' is not an attribute of rgss (did you mean 'priority'?)"),
        ("owner:", "boss:", "8:12: error: 'boss' is not an attribute of rgss (attributes: kind, parent, text, "),
        ("stakeholder", "customer", "'customer' is not one of 'stakeholder', 'system', 'block' or 'behaviour'"),
        ("types:", "kinds:", "unknown key 'kinds'"),
        ("Object Text: text", "Object Text: [text]", "a text is expected"),
    ],
)
def test_a_mapping_that_is_wrong_is_one_line(read, old, new, complaint):
    with pytest.raises(DocumentError) as caught:
        read(DOORS.replace(old, new))
    (finding,) = caught.value.findings
    assert complaint in str(finding)


RELATIONS = """\
relations:
  Fulfils: derived_from
  Decomposed to: [target.derived_from, target.satisfied_by]
  See also:
id_prefix: SYS-
"""


def test_a_mapping_has_relations_and_a_prefix(read):
    names = read(RELATIONS).names
    assert names.links_of("fulfils") == ("derived_from",)
    assert names.links_of("Decomposed  to") == ("target.derived_from", "target.satisfied_by")
    assert names.links_of("See also") == ()
    assert names.links_of("Other") is None
    assert [names.own_id(text) for text in ("12", "SYS-12", "REQ 1", "")] == ["SYS-12", "SYS-12", "REQ 1", ""]


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        (": derived_from", ": derives", "2:12: error: 'derives' is not what a relation may state (did you mean "),
        ("target.satisfied_by", "measure", "3:40: error: 'measure' is not what a relation may state (one of actors, "),
        ("SYS-", "1-", "5:12: error: "),
        ("id_prefix: SYS-", "defaults: {id: a}", "5:12: error: id has no default (did you mean "),
    ],
)
def test_relations_and_a_prefix_that_are_wrong_are_one_line(read, old, new, complaint):
    with pytest.raises(DocumentError) as caught:
        read(RELATIONS.replace(old, new))
    (finding,) = caught.value.findings
    assert complaint in str(finding)


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        (DOORS + RELATIONS, True),
        ("{}", True),
        ("attributes: {Object Text: txt}", False),
        ("values: {prio: {a: high}}", False),
        ("types: {Need: customer}", False),
        ("relations: {Fulfils: derives}", False),
        ("relations: {Fulfils: [derives]}", False),
        ("id_prefix: 1-", False),
        ("defaults: {part: system}", False),
        ("surprise: 1", False),
    ],
)
def test_its_schema_takes_what_the_reader_takes(read, tmp_path, text, is_one):
    try:
        taken = bool(read(text))
    except DocumentError:
        taken = False
    data = read_document(tmp_path / "doors.yaml").data
    assert (taken, Draft7Validator(MAPPING_KIND.schema()).is_valid(data)) == (is_one, is_one)
