"""Relations of other tools that the user maps to the links of rgss."""

from __future__ import annotations

import pytest

from rgss.exchange import ForeignNames, Part, with_absent_links
from rgss.exchange.reqif import read_reqif

from .other_tools import reqif_of

ATTRIBUTES = (("ReqIF.ForeignID", "INTEGER"), ("ReqIF.Text", "XHTML"))
_TIME = 'LAST-CHANGE="2024-01-01T00:00:00Z"'


def requirement(number, kind="Req"):
    return kind, {"ReqIF.ForeignID": str(number), "ReqIF.Text": f"The gripper shall hold {number} kg."}


OBJECTS = (requirement(1, "Need"), requirement(2), requirement(3), requirement(4))


def relation(number, kind, source, target):
    return (
        f'<SPEC-RELATION IDENTIFIER="_r{number}" {_TIME}><TYPE><SPEC-RELATION-TYPE-REF>_t-{kind}'
        f"</SPEC-RELATION-TYPE-REF></TYPE><SOURCE><SPEC-OBJECT-REF>_o{source}</SPEC-OBJECT-REF></SOURCE>"
        f"<TARGET><SPEC-OBJECT-REF>_o{target}</SPEC-OBJECT-REF></TARGET></SPEC-RELATION>"
    )


@pytest.fixture
def read_related(as_xml):
    """Function that reads four objects with relations, by type as pairs of the numbers of objects."""

    def read(related, hierarchy="", **mapped):
        types = "".join(
            f'<SPEC-RELATION-TYPE IDENTIFIER="_t-{number}" LONG-NAME="{name}" {_TIME}/>'
            for number, name in enumerate(related)
        )
        pairs = [(number, source, target) for number, each in enumerate(related.values()) for source, target in each]
        text = reqif_of(
            {"Need": ATTRIBUTES, "Req": ATTRIBUTES},
            OBJECTS,
            relation_types=types,
            relations="".join(relation(place, *pair) for place, pair in enumerate(pairs)),
            hierarchy=hierarchy,
        )
        names = ForeignNames(types={"Need": Part.STAKEHOLDER, "Req": Part.SYSTEM}, id_prefix="R-", **mapped)
        return read_reqif(as_xml(text), names=names)

    return read


def stated(content, name):
    return {row.id: row.cells[name] for row in content.rows if row.cells.get(name)}


def test_a_relation_states_the_attribute_of_its_source_or_its_target(read_related):
    relations = {"Fulfils": [(1, 0), (2, 1)], "Decomposed to": [(1, 3)], "See also": [(3, 1)]}
    meanings = {"fulfils": ("derived_from",), "Decomposed to": ("target.derived_from",), "See also": ("traces",)}
    foreign = read_related(relations, relations=meanings)
    assert stated(foreign, "derived_from") == {"R-2": "R-1", "R-3": "R-2", "R-4": "R-2"}
    assert stated(foreign, "traces") == {"R-4": "R-2"}
    assert foreign.notes == ()
    assert foreign.relations == ("Fulfils", "Decomposed to", "See also")


def test_of_several_meanings_the_first_that_fits_the_ends_counts(read_related):
    foreign = read_related({"Link": [(0, 1), (2, 1)]}, relations={"Link": ("derived_from", "target.derived_from")})
    assert stated(foreign, "derived_from") == {"R-2": "R-1", "R-3": "R-2"}


def test_the_mapping_counts_before_the_name(read_related):
    foreign = read_related({"satisfies": [(1, 0)]}, relations={"satisfies": ("traces",)})
    assert (stated(foreign, "traces"), foreign.notes) == ({"R-2": "R-1"}, ())


def test_relations_that_are_left_out_are_not_noted_and_change_nothing(read_related):
    foreign = read_related({"Parent": [(1, 0)]}, relations={"Parent": ()})
    assert foreign.notes == ()
    assert all("derived_from" not in row.cells for row in foreign.rows)


@pytest.mark.parametrize(
    ("name", "pairs", "mapped", "options"),
    [
        ("Link", [(1, 0)], {}, "--map-relation Link=derived_from takes such"),
        ("Link", [(0, 1), (0, 2)], {}, "--map-relation Link=target.derived_from takes such"),
        ("Link", [(0, 1)], {"Link": ("derived_from",)}, "--map-relation Link=target.derived_from takes such"),
        (
            "satisfies",
            [(1, 0)],
            {},
            "--map-relation satisfies=target.satisfied_by --map-relation satisfies=derived_from",
        ),
    ],
)
def test_relations_that_are_not_imported_name_the_option(read_related, name, pairs, mapped, options):
    (note,) = read_related({name: pairs}, relations=mapped).notes
    assert f"of type {name!r} " in note
    assert f"({options}" in note


def test_a_missing_relation_of_a_mapped_type_removes_the_link(project, read_related):
    meanings = {"Link": ("derived_from",)}
    defaults = {"source": "DOORS", "rationale": "None.", "status": "draft", "owner": "me", "priority": "low"}
    defaults |= {"verification": "test", "facility": "Bench", "phase": "qualification", "success": "It holds."}
    defaults |= {"group": "gripper", "kind": "functional", "satisfied_by": "BLK-arm"}

    def read(pairs):
        return with_absent_links(project.content, read_related({"Link": pairs}, relations=meanings), remove=False)

    both = [(1, 0), (2, 0), (3, 0)]
    project.apply(read(both), defaults=defaults, remove=False)
    assert project.compare(read(both), defaults=defaults) == ()
    (change,) = project.compare(read([*both[1:], (1, 2)]), defaults=defaults)
    assert [(each.attribute.name, each.old, each.new) for each in change.attributes] == [("derived_from", "R-1", "R-3")]


def test_parents_are_those_of_a_mapped_relation_before_the_hierarchy(read_related):
    inside = "<SPEC-HIERARCHY IDENTIFIER='_h{0}' {1}><OBJECT><SPEC-OBJECT-REF>_o{0}</SPEC-OBJECT-REF></OBJECT>{2}"
    end = "</SPEC-HIERARCHY>"
    children = "".join(f"{inside.format(number, _TIME, '')}{end}" for number in (2, 3))
    hierarchy = (
        f"<SPECIFICATION IDENTIFIER='_s' {_TIME}><TYPE><SPECIFICATION-TYPE-REF>_st</SPECIFICATION-TYPE-REF></TYPE>"
        f"<CHILDREN>{inside.format(1, _TIME, f'<CHILDREN>{children}</CHILDREN>')}{end}</CHILDREN></SPECIFICATION>"
    )
    foreign = read_related({"Has parent": [(2, 3), (2, 1)]}, hierarchy, relations={"Has parent": ("parent",)})
    assert stated(foreign, "parent") == {"R-3": "R-4", "R-4": "R-2"}
    assert [loss.message for loss in foreign.losses] == ["R-3: it is under 'R-4' and under 'R-2'; 'R-4' is kept"]
    assert foreign.notes == (
        "the place of 1 element in the hierarchy is not imported: what is mapped to the parent names another",
    )
