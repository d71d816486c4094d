"""Relations of other tools that cannot be imported change no link; files of an archive may name each other."""

from __future__ import annotations

import io
import re
import zipfile

import pytest

from rgss.exchange.attributes import Part
from rgss.exchange.reqif import read_reqif, reqif_text
from rgss.exchange.reqif.identifiers import object_identifier, relation_type_identifier

RELATION = re.compile(r"<SPEC-RELATION .*?</SPEC-RELATION>\n", re.DOTALL)


@pytest.fixture
def text(project):
    return reqif_text(project.content, title="t")


def with_relations(text, kind, name, pairs):
    """The file with one type of relations replaced by one of another tool, and its relations by others."""
    own, foreign = relation_type_identifier(kind), "_foreign"
    assert own in text
    text = RELATION.sub(lambda match: "" if own in match[0] else match[0], text)
    text = text.replace(f'LONG-NAME="{kind}"', f'LONG-NAME="{name}"').replace(own, foreign)
    relations = "".join(
        f'<SPEC-RELATION IDENTIFIER="_r{number}" LAST-CHANGE="2000-01-01T00:00:00Z">\n<TYPE>\n'
        f"<SPEC-RELATION-TYPE-REF>{foreign}</SPEC-RELATION-TYPE-REF>\n</TYPE>\n<SOURCE>\n"
        f"<SPEC-OBJECT-REF>{object_identifier(source)}</SPEC-OBJECT-REF>\n</SOURCE>\n<TARGET>\n"
        f"<SPEC-OBJECT-REF>{object_identifier(target)}</SPEC-OBJECT-REF>\n</TARGET>\n</SPEC-RELATION>\n"
        for number, (source, target) in enumerate(pairs)
    )
    return text.replace("<SPEC-RELATIONS>\n", f"<SPEC-RELATIONS>\n{relations}")


def changed(project, foreign):
    return {
        (change.id, each.attribute.name): each.new
        for change in project.compare(foreign)
        for each in change.attributes
        if change.kind.value == "changed"
    }


@pytest.mark.parametrize(
    ("kind", "name", "pairs", "changes", "left"),
    [
        ("satisfy", "satisfies", [("SYS-1", "STK-1")], {}, 1),
        ("satisfy", "satisfies", [("SYS-2", "SYS-1")], {}, 1),
        ("deriveReqt", "derives", [("STK-2", "SYS-1")], {}, 1),
        ("deriveReqt", "derives", [("SYS-1", "BLK-arm")], {}, 1),
        ("satisfy", "satisfies", [("BLK-arm", "SYS-1")], {("SYS-1", "satisfied_by"): "BLK-arm"}, 0),
        (
            "satisfy",
            "satisfies",
            [("BLK-arm", "SYS-1"), ("SYS-1", "STK-1")],
            {("SYS-1", "satisfied_by"): "BLK-arm"},
            1,
        ),
        ("deriveReqt", "derives", [("SYS-1", "STK-1")], {("SYS-1", "derived_from"): "STK-1"}, 0),
    ],
)
def test_relations_that_cannot_be_imported_remove_no_link(project, as_xml, text, kind, name, pairs, changes, left):
    foreign = read_reqif(as_xml(with_relations(text, kind, name, pairs)))

    found = changed(project, foreign)
    assert {place: found.get(place) for place in changes} == changes
    # Where each relation of a type is imported, a missing one was removed.
    assert (left == 0) or found == changes
    said = f"1 relation of type {name!r} is not imported: rgss has no such link between such elements"
    notes = [note for note in foreign.notes if " of type " in note]
    assert (len(notes), [note.startswith(said) for note in notes]) == (left, [True] * left)


def test_a_relation_of_our_own_type_is_complete_whatever_another_tool_adds(project, as_xml, text):
    own = relation_type_identifier("satisfy")
    without = RELATION.sub(lambda match: "" if own in match[0] else match[0], text)
    assert changed(project, read_reqif(as_xml(without))) == {
        ("SYS-1", "satisfied_by"): "",
        ("SYS-2", "satisfied_by"): "",
    }


def test_files_of_an_archive_relate_to_each_others_objects(project, as_xml, text, tmp_path):
    """The requirements are divided among two files, with all relations and the hierarchy in the second."""
    objects = re.search(r"<SPEC-OBJECTS>\n(.*)</SPEC-OBJECTS>\n", text, re.DOTALL)[1]
    each = re.findall(r"<SPEC-OBJECT .*?</SPEC-OBJECT>\n", objects, re.DOTALL)
    first, second = "".join(each[:3]), "".join(each[3:])
    empty = re.sub(
        r"<(SPEC-RELATIONS|SPECIFICATIONS)>.*</\1>", r"<\1>\n</\1>", text.replace(objects, first), flags=re.S
    )
    rest = text.replace(objects, second)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as file:
        file.writestr("a.reqif", empty)
        file.writestr("b.reqif", rest)
    path = tmp_path / "t.reqifz"
    path.write_bytes(out.getvalue())

    known = {row.id: row.part for row in project.content.rows}
    content = read_reqif(path, known=known, part=Part.SYSTEM)
    assert len(content.rows) == len(project.content.rows)
    assert project.compare(content) == ()
    assert "does not exist" in read_reqif(as_xml(rest), known=known).losses[0].message
