"""The file that maps the names of another tool."""

from __future__ import annotations

import pytest

from rgss.errors import DocumentError
from rgss.exchange import Part, read_mapping

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
        ("owner:", "boss:", "8:12: error: 'boss' is not an attribute of rgss (attributes: part, id, "),
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
