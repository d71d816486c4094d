"""Content of ReqIF files beside the attributes of their objects: what the object itself has, relations, documents."""

from __future__ import annotations

import re

import pytest

from rgss.exchange import ForeignNames, Part
from rgss.exchange.reqif import read_reqif

from .other_tools import reqif_of

TYPES = {"Req": (("ReqIF.ForeignID", "STRING"), ("ReqIF.Text", "XHTML"), ("ReqIF.ForeignDeleted", "BOOLEAN"))}
OBJECTS = (
    ("Req", {"ReqIF.ForeignID": "SYS-8", "ReqIF.Text": "The gripper shall hold 3 kg."}),
    ("Req", {"ReqIF.ForeignID": "SYS-9", "ReqIF.Text": "It shall hold 4 kg.", "ReqIF.ForeignDeleted": "true"}),
)
_TIME = 'LAST-CHANGE="2024-01-01T00:00:00Z"'


@pytest.fixture
def read_with(as_xml):
    """Function that reads the objects, the first of them with attributes of XML, and with further XML of the file."""

    def read(attributes="", objects=OBJECTS, *, attributes_of_rgss=None, **more):
        text = reqif_of(TYPES, objects, **more).replace('IDENTIFIER="_o0"', f'IDENTIFIER="_o0" {attributes}')
        return read_reqif(as_xml(text), part=Part.SYSTEM, names=ForeignNames(**(attributes_of_rgss or {})))

    return read


def test_a_deleted_object_is_not_imported(read_with):
    foreign = read_with()
    assert [row.id for row in foreign.rows] == ["SYS-8"]
    assert foreign.notes == ("1 object of type 'Req' is not imported: 'ReqIF.ForeignDeleted' says deleted",)


def test_the_name_and_the_description_of_an_object_are_noted(read_with):
    notes = read_with('LONG-NAME="Grip" DESC="Hold &amp; carry."').notes
    for name in ("LONG-NAME", "DESC"):
        option = f"--map '{name}=…'"
        assert f"the attribute {name!r} is not imported: rgss has none of that name ({option} takes it)" in notes


def test_a_name_that_repeats_an_attribute_is_not_noted(read_with):
    assert len(read_with('LONG-NAME="SYS-8" DESC="The gripper shall hold 3 kg."').notes) == 1


def test_the_name_the_description_and_the_identifier_can_be_mapped(read_with):
    bare = [("Req", {}), *OBJECTS[1:]]
    names = {"attributes": {"DESC": "text", "IDENTIFIER": "id", "LONG-NAME": "rationale"}, "id_prefix": "R"}
    foreign = read_with('LONG-NAME="Grip" DESC="Hold &amp; carry."', bare, attributes_of_rgss=names)
    (row,) = foreign.rows
    assert (row.id, row.cells["text"], row.cells["rationale"]) == ("R_o0", "Hold & carry.", "Grip")


def test_objects_without_an_id_name_the_option_that_takes_their_identifiers(read_with):
    (note, _) = read_with(objects=[("Req", {"ReqIF.Text": "It shall hold."}), *OBJECTS[1:]]).notes
    assert note.endswith("(--map IDENTIFIER=id --id-prefix … takes them)")


def test_attributes_of_relations_and_specifications_are_noted(read_with):
    definition = (
        f'<SPEC-ATTRIBUTES><ATTRIBUTE-DEFINITION-STRING IDENTIFIER="{{0}}" LONG-NAME="{{1}}" {_TIME}><TYPE>'
        "<DATATYPE-DEFINITION-STRING-REF>_d-STRING</DATATYPE-DEFINITION-STRING-REF></TYPE>"
        "</ATTRIBUTE-DEFINITION-STRING></SPEC-ATTRIBUTES>"
    )
    value = (
        '<VALUES><ATTRIBUTE-VALUE-STRING THE-VALUE="x"><DEFINITION><ATTRIBUTE-DEFINITION-STRING-REF>{0}'
        "</ATTRIBUTE-DEFINITION-STRING-REF></DEFINITION></ATTRIBUTE-VALUE-STRING></VALUES>"
    )
    types = (
        f'<SPEC-RELATION-TYPE IDENTIFIER="_rt" LONG-NAME="derives" {_TIME}>{definition.format("_ra", "Comment")}'
        f'</SPEC-RELATION-TYPE><SPECIFICATION-TYPE IDENTIFIER="_st" LONG-NAME="Document" {_TIME}>'
        f"{definition.format('_sa', 'Scope')}</SPECIFICATION-TYPE>"
    )
    relation = (
        f'<SPEC-RELATION IDENTIFIER="_r" {_TIME}><TYPE><SPEC-RELATION-TYPE-REF>_rt</SPEC-RELATION-TYPE-REF></TYPE>'
        "<SOURCE><SPEC-OBJECT-REF>_o0</SPEC-OBJECT-REF></SOURCE><TARGET><SPEC-OBJECT-REF>_o1</SPEC-OBJECT-REF></TARGET>"
        f"{value.format('_ra')}</SPEC-RELATION>"
    )
    specification = (
        f'<SPECIFICATION IDENTIFIER="_s" {_TIME}><TYPE><SPECIFICATION-TYPE-REF>_st</SPECIFICATION-TYPE-REF></TYPE>'
        f"{value.format('_sa')}</SPECIFICATION>"
    )
    kept = [OBJECTS[0], ("Req", {"ReqIF.ForeignID": "SYS-9", "ReqIF.Text": "It shall hold 4 kg."})]
    foreign = read_with(objects=kept, relation_types=types, relations=relation, hierarchy=specification)
    assert foreign.rows[0].cells["derived_from"] == "SYS-9"
    assert foreign.notes == (
        "the attributes of 1 relation are not imported: 'Comment'",
        "the attributes of 1 specification are not imported: 'Scope'",
    )


@pytest.mark.parametrize(
    ("first", "second", "text", "losses"),
    [
        ("It shall hold.", "gripper", "It shall hold.", ["'gripper'"]),
        ("It shall hold.", "It shall hold.", "It shall hold.", []),
        ("", "gripper", "gripper", []),
        ("It shall hold.", "", "It shall hold.", []),
    ],
)
def test_of_two_attributes_of_one_name_the_first_counts_and_the_other_is_a_loss(as_xml, first, second, text, losses):
    types = {"Req": (*TYPES["Req"], ("Group", "STRING"))}
    values = {"ReqIF.ForeignID": "SYS-8", "ReqIF.Text": first, "Group": second}
    file = reqif_of(types, [("Req", values)]).replace('LONG-NAME="Group"', 'LONG-NAME="ReqIF.Text"')
    foreign = read_reqif(as_xml(file), part=Part.SYSTEM)
    assert [row.cells["text"] for row in foreign.rows] == [text]
    said = "SYS-8: ReqIF.Text: the value {} of another attribute of that name is omitted"
    assert [loss.message for loss in foreign.losses] == [said.format(loss) for loss in losses]


def test_two_values_of_one_attribute_are_refused(as_xml, refused):
    text = reqif_of(TYPES, OBJECTS[:1])
    value = re.search("<ATTRIBUTE-VALUE-XHTML.*?</ATTRIBUTE-VALUE-XHTML>", text)[0]
    (line,) = refused(read_reqif, as_xml(text.replace(value, value + value.replace("3 kg", "4 kg"))), part=Part.SYSTEM)
    assert "the object '_o0' has two values of one attribute" in line
