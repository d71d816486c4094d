"""Attributes, values and types of other tools that the user maps to those of rgss."""

from __future__ import annotations

import pytest

from rgss.exchange import ForeignNames, Part, with_values_mapped
from rgss.exchange.reqif import read_reqif

from .other_tools import reqif_of

DOORS = (
    ("ReqIF.ForeignID", "INTEGER"),
    ("Object Identifier", "STRING"),
    ("Object Heading", "STRING"),
    ("Object Text", "XHTML"),
    ("Priority", "ENUMERATION"),
    ("Verification Method", "ENUMERATION"),
    ("Object Type", "ENUMERATION"),
    ("Rationale_", "XHTML"),
    ("Parent ID", "STRING"),
    ("Created On", "DATE"),
)
CHOICES = {
    "Priority": ["Mandatory", "Desirable"],
    "Verification Method": ["T", "A"],
    "Object Type": ["Requirement", "Info"],
}
OBJECTS = (
    ("Req", {"ReqIF.ForeignID": "1", "Object Identifier": "SYS-10", "Object Heading": "Grip"}),
    (
        "Req",
        {
            "ReqIF.ForeignID": "2",
            "Object Identifier": "SYS-11",
            "Object Text": "The gripper shall hold 3 kg.",
            "Priority": ["Mandatory"],
            "Verification Method": ["T"],
            "Object Type": ["Requirement"],
            "Rationale_": "It is heavy.",
            "Parent ID": "SYS-1",
            "Created On": "2024-01-01T00:00:00Z",
        },
    ),
    ("Req", {"ReqIF.ForeignID": "3", "Object Identifier": "SYS-12", "Object Text": "See.", "Object Type": ["Info"]}),
)
NAMES = {"Object Text": "text", "Object Identifier": "id", "Rationale_": "rationale"}
DEFAULTS = {"group": "gripper", "source": "DOORS", "status": "draft", "owner": "me", "verification": "test"}
DEFAULTS |= {"facility": "Bench", "phase": "qualification", "success": "It holds."}


@pytest.fixture
def read_doors(as_xml):
    def read(objects=OBJECTS, kinds=None, **mapped):
        names = ForeignNames(**mapped)
        path = as_xml(reqif_of(kinds or {"Req": DOORS}, objects, choices=CHOICES))
        return with_values_mapped(read_reqif(path, part=Part.SYSTEM, names=names), names)

    return read


def test_an_attribute_is_what_it_is_mapped_to(read_doors):
    foreign = read_doors(attributes=NAMES)
    assert [(row.id, row.cells["text"]) for row in foreign.rows] == [
        ("SYS-11", "The gripper shall hold 3 kg."),
        ("SYS-12", "See."),
    ]
    assert foreign.rows[0].cells["rationale"] == "It is heavy."


def test_names_are_compared_without_regard_to_case_and_blanks(read_doors):
    foreign = read_doors(attributes={"object  TEXT": "text", " Object Identifier": "id"})
    assert foreign.rows[0].cells["text"] == "The gripper shall hold 3 kg."


def test_each_attribute_that_is_not_mapped_is_noted_with_its_option(read_doors):
    notes = read_doors(attributes=NAMES).notes
    assert "the attribute 'ReqIF.ForeignID' is not imported: 'Object Identifier' is the id" in notes
    option = "--map 'Verification Method=verification'"
    assert (
        f"the attribute 'Verification Method' is not imported: rgss has none of that name ({option} takes it)" in notes
    )
    assert (
        "the attribute 'Created On' is not imported: rgss has none of that name (--map 'Created On=…' takes it)"
        in notes
    )
    assert not [note for note in notes if "'Priority'" in note or "'Rationale_'" in note]


def test_objects_without_a_mapped_text_name_the_likely_option(read_doors):
    (note,) = read_doors().notes
    assert note.startswith("3 objects of type 'Req' are not imported: no text among their attributes 'ReqIF.ForeignID'")
    assert note.endswith("(--map 'Object Text=text' takes them)")


def test_an_attribute_that_is_left_out_is_not_noted(read_doors):
    foreign = read_doors(attributes={**NAMES, "Created On": "", "Priority": ""})
    assert not [note for note in foreign.notes if "Created On" in note]
    assert "priority" not in foreign.rows[0].cells


def test_values_of_an_enumeration_are_mapped(read_doors):
    values = {"priority": {"mandatory": "high"}, "verification": {"T": "test"}}
    foreign = read_doors(attributes={**NAMES, "Verification Method": "verification"}, values=values)
    assert (foreign.rows[0].cells["priority"], foreign.rows[0].cells["verification"]) == ("high", "test")


@pytest.mark.parametrize(
    ("values", "result"),
    [
        ({"T": "test"}, "T; A"),
        ({"T": "test", "A": "test"}, "test"),
        ({"T": "test", "A": "analysis"}, "T; A"),
        ({"T; A": "demonstration"}, "demonstration"),
    ],
)
def test_several_chosen_values_are_mapped_as_a_whole_or_to_one(values, result):
    assert ForeignNames(values={"verification": values}).value("verification", "T; A") == result


def test_objects_are_of_the_part_that_a_mapped_attribute_states(read_doors):
    foreign = read_doors(attributes={**NAMES, "Object Type": "part"}, values={"part": {"Requirement": "stakeholder"}})
    assert [(row.id, row.part) for row in foreign.rows] == [("SYS-11", Part.STAKEHOLDER)]
    option = "(--map-value 'part:Info=…' takes such)"
    assert f"1 object is not imported: 'Info' of 'Object Type' is no part {option}" in foreign.notes


def test_objects_are_of_the_part_for_which_their_type_is_mapped(read_doors):
    kinds = {"Customer need": DOORS, "Req": DOORS}
    need = ("Customer need", {"Object Identifier": "STK-9", "Object Text": "It shall serve."})
    foreign = read_doors((*OBJECTS, need), kinds, attributes=NAMES, types={"customer need": Part.STAKEHOLDER})
    assert [(row.id, row.part) for row in foreign.rows][1:] == [("SYS-12", Part.SYSTEM), ("STK-9", Part.STAKEHOLDER)]


def test_ids_are_taken_from_an_attribute_only_if_it_is_mapped(read_doors):
    assert "parent" not in read_doors(attributes=NAMES).rows[0].cells
    assert read_doors(attributes={**NAMES, "Parent ID": "parent"}).rows[0].cells["parent"] == "SYS-1"
    several = ("Req", {"Object Identifier": "SYS-9", "Object Text": "x", "Parent ID": "STK-1, STK-2\nSYS-1"})
    foreign = read_doors([several], attributes={**NAMES, "Parent ID": "derived_from"})
    assert foreign.rows[0].cells["derived_from"] == "STK-1; STK-2; SYS-1"


def test_of_two_mapped_names_the_first_with_a_value_counts_and_the_other_is_a_loss(read_doors):
    names = {"Object Text": "text", "Object Heading": "text", "Object Identifier": "id"}
    both = ("Req", {"Object Identifier": "SYS-13", "Object Heading": "Grip", "Object Text": "It shall grip."})
    foreign = read_doors((*OBJECTS, both), attributes=names)
    assert {row.id: row.cells["text"] for row in foreign.rows} == {
        "SYS-10": "Grip",
        "SYS-11": "The gripper shall hold 3 kg.",
        "SYS-12": "See.",
        "SYS-13": "It shall grip.",
    }
    assert [loss.message for loss in foreign.losses] == [
        "SYS-13: Object Heading: the value 'Grip' is omitted, since 'Object Text' is the text"
    ]


def test_an_import_with_defaults_changes_nothing_the_second_time(project, read_doors):
    """The second object has no rationale: that of the default is then its own."""
    values = {"priority": {"Mandatory": "high"}}
    defaults = {**DEFAULTS, "rationale": "None was given.", "priority": "low"}

    def read():
        return read_doors(attributes={**NAMES, "Created On": ""}, values=values)

    project.apply(read(), part=Part.SYSTEM, defaults=defaults, remove=False)
    assert [change.kind.value for change in project.compare(read(), defaults=defaults)] == []


def test_a_missing_attribute_and_a_value_of_another_list_name_their_options(project, read_doors, refused):
    names = {"Object Text": "text", "Object Identifier": "id"}
    lines = refused(project.compare, read_doors(OBJECTS[:2], attributes=names), part=Part.SYSTEM, defaults=DEFAULTS)
    assert [line.partition("error: ")[2] for line in lines] == [
        (
            "SYS-11: priority: 'Mandatory' is not one of 'high', 'medium' or 'low' "
            "(--map-value 'priority:Mandatory=…' maps it) [exchange.value]"
        ),
        (
            "SYS-11: rationale: is missing (fill it in, or give --map Rationale_=rationale, "
            "or give --default rationale=…) [exchange.value]"
        ),
    ]


def test_an_attribute_without_a_part_that_has_it_is_noted(read_doors):
    foreign = read_doors(
        attributes={**NAMES, "Object Heading": "kind"},
        objects=[("Req", {"Object Identifier": "SYS-9", "Object Text": "x", "Object Heading": "Grip"})],
    )
    assert "the attribute 'Object Heading' is not imported: an element 'system' has no 'kind'" in foreign.notes
