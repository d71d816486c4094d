"""ReqIF written and read, with the schema of the OMG, lxml and a file of another tool as judges."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import pytest
import reqif
import xmlschema
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from rgss.errors import DefinitionError
from rgss.exchange.attributes import Part
from rgss.exchange.comparison import ChangeKind
from rgss.exchange.content import Content, Row, part_of
from rgss.exchange.reqif import read_reqif, reqif_text
from rgss.exchange.reqif.grammar import shape_of
from rgss.requirements import LinkKind

STRICTDOC = Path(__file__).parents[1] / "strictdoc" / "gripper.reqif"
DEFAULTS = {"source": "The supplier", "priority": "low", "owner": "gripper engineer"}
NAMESPACES = {"r": "http://www.omg.org/spec/ReqIF/20110401/reqif.xsd", "x": "http://www.w3.org/1999/xhtml"}


@pytest.fixture
def exported(project, tmp_path):
    path = tmp_path / "project.reqif"
    path.write_text(reqif_text(project.content, title="A & B"), encoding="utf-8", newline="")
    return path


@pytest.fixture(scope="module")
def schema():
    folder = Path(reqif.__file__).parent / "reqif_schema"
    return xmlschema.XMLSchema(folder / "reqif.xsd", base_url=str(folder.parents[1]))


def found_relations(path):
    """Kind, source and target of every relation, by ids, as lxml finds them."""
    root = etree.parse(path).getroot()
    types = {
        each.get("IDENTIFIER"): each.get("LONG-NAME") for each in root.iterfind(".//r:SPEC-RELATION-TYPE", NAMESPACES)
    }
    definitions = {each.get("IDENTIFIER") for each in root.iter() if each.get("LONG-NAME") == "ReqIF.ForeignID"}
    ids = {}
    for thing in root.iterfind(".//r:SPEC-OBJECT", NAMESPACES):
        for value in thing.iterfind(".//r:ATTRIBUTE-VALUE-STRING", NAMESPACES):
            if value.findtext(".//r:ATTRIBUTE-DEFINITION-STRING-REF", namespaces=NAMESPACES) in definitions:
                ids[thing.get("IDENTIFIER")] = value.get("THE-VALUE")
    relations = {
        (
            types[each.findtext(".//r:SPEC-RELATION-TYPE-REF", namespaces=NAMESPACES)],
            *(ids[each.findtext(f"r:{end}/r:SPEC-OBJECT-REF", namespaces=NAMESPACES)] for end in ("SOURCE", "TARGET")),
        )
        for each in root.iterfind(".//r:SPEC-RELATION", NAMESPACES)
    }
    hierarchy = {
        ("containment", *(ids[end.findtext("r:OBJECT/r:SPEC-OBJECT-REF", namespaces=NAMESPACES)] for end in pair))
        for inner in root.iterfind(".//r:SPEC-HIERARCHY", NAMESPACES)
        for around in [inner.getparent().getparent()]
        if etree.QName(around).localname == "SPEC-HIERARCHY"
        for pair in [(inner, around)]
    }
    return ids, relations | hierarchy


def test_the_file_is_valid_by_the_schema_of_the_omg(exported, schema):
    schema.validate(exported)


def test_another_reader_finds_every_element_and_every_link(project, exported):
    ids, relations = found_relations(exported)
    requirements = project.requirements
    assert sorted(ids.values()) == sorted([*(each.id for each in requirements.elements), "t_e"])
    links = {(link.kind.value, link.source, link.target) for link in requirements.links}
    assert links <= relations
    assert {kind for kind, _, _ in relations} == {*(kind.value for kind in LinkKind), "include", "actor"}
    assert relations - links == {
        ("verify", "t_e", "SYS-1"),
        ("include", "UC-lift", "ACT-close"),
        ("actor", "UC-lift", "BLK-guest"),
    }


def test_markup_in_a_text_is_text_in_the_file(exported):
    root = etree.parse(exported).getroot()
    assert not root.findall(".//x:b", NAMESPACES)
    assert any("<b>want</b> & get it" in "".join(each.itertext()) for each in root.iter("{*}div"))


def test_export_import_export_gives_the_same_bytes(project, exported):
    foreign = read_reqif(exported)
    assert reqif_text(foreign, title="A & B").encode("utf-8") == exported.read_bytes()
    assert project.compare(foreign) == ()
    assert (foreign.whole, foreign.notes) == (frozenset(Part), ())


def test_a_project_that_has_changed_is_brought_back_to_the_same_bytes(project, exported):
    for name, old, new in [
        ("stakeholder", "upright", "at once"),
        ("stakeholder", "    exempt:\n      - {rule: wording.R35", "    # gone: {rule: wording.R35"),
        ("system", "threshold: 25 s", "threshold: 1 min"),
        ("system", "traces: [STK-1]\n", "phase: acceptance\n"),
        ("system", "parent: SYS-1\n", "facility: Bench\n"),
        ("architecture", "relation: kind, ", ""),
        ("architecture", "actor: true, ", ""),
        ("architecture", ", reply: true", ""),
        ("architecture", "    actors: [BLK-guest]\n", ""),
        ("architecture", "name: End}", "name: Finish}"),
    ]:
        file = project.file(f"{name}.yaml")
        text = file.read_text(encoding="utf-8")
        assert old in text
        file.write_text(text.replace(old, new, 1), encoding="utf-8")
    assert len(project.compare(read_reqif(exported))) == 9
    project.apply(read_reqif(exported))
    assert project.compare(read_reqif(exported)) == ()
    assert reqif_text(project.content, title="A & B").encode("utf-8") == exported.read_bytes()


@settings(max_examples=25)
@given(text=st.text(st.characters(exclude_categories=("Cs", "Cc", "Cn")) | st.sampled_from("\n\t<>&'\"\r")))
def test_any_text_survives(text, tmp_path_factory):
    stripped = text.strip()
    cells = {"id": "A", "text": stripped, "rationale": "r", "source": "s", "owner": stripped, "exempt": ""}
    cells |= {"kind": "design", "parent": "", "priority": "low", "status": "draft"}
    path = tmp_path_factory.getbasetemp() / "text.reqif"
    path.write_text(
        reqif_text(Content(rows=(Row(part=Part.STAKEHOLDER, cells=cells),)), title="t"), encoding="utf-8", newline=""
    )
    (row,) = read_reqif(path).rows
    assert (row.cells["text"], row.cells["owner"]) == (stripped, stripped)


def test_a_file_of_strictdoc_is_imported(project, refused):
    assumed = {"part": Part.SYSTEM, "defaults": DEFAULTS}
    foreign = read_reqif(STRICTDOC, part=Part.SYSTEM)
    assert foreign.notes == (
        "1 object of type 'SECTION' is not imported: no id and no text among their attributes 'ReqIF.ChapterName'",
        (
            "1 object of type 'TEXT' is not imported: no id among their attributes 'ReqIF.Text' "
            "(--map IDENTIFIER=id --id-prefix … takes them)"
        ),
        "the attribute 'ReqIF.Name' is not imported: rgss has none of that name (--map 'ReqIF.Name=…' takes it)",
    )
    assert {change.kind for change in project.compare(foreign, **assumed)} == {ChangeKind.ADDED}
    project.apply(foreign, **assumed)
    first, second = (project.requirements.requirement(name) for name in ("SUP-1", "SUP-2"))
    assert first.text == "The gripper shall close its fingers within 2 s\nat a load of <b>0.5 kg</b> & more."
    assert (first.group.value, first.status.value, first.owner) == ("gripper", "draft", "gripper engineer")
    assert (second.status.value, second.derived_from) == ("approved", ("SUP-1",))
    assert second.rationale == "A smooth cup slips at less.\n\nMeasured on the bench."
    assert len(project.requirements.system) == 4
    known = {element.id: part_of(element) for element in project.requirements.elements}
    assert project.compare(read_reqif(STRICTDOC, known=known)) == ()


def test_what_a_foreign_file_leaves_open_is_asked_for(project, refused):
    lines = refused(project.compare, read_reqif(STRICTDOC, part=Part.SYSTEM), part=Part.SYSTEM)
    assert [line.split(": ", 2)[2] for line in lines[:3]] == [
        f"SUP-1: {name}: is missing (fill it in, or give --default {name}=…) [exchange.value]"
        for name in ("owner", "priority", "source")
    ]
    lines = refused(project.compare, read_reqif(STRICTDOC))
    assert "the new element 'SUP-1' has no part (give --as stakeholder or --as system)" in lines[0]


def test_relations_between_what_cannot_be_linked_are_told(project):
    foreign = read_reqif(STRICTDOC, part=Part.STAKEHOLDER)
    assert foreign.notes[-1].startswith("1 relation of type 'Parent' is not imported")


def test_layout_of_another_tool_becomes_lines(exported, as_xml, project):
    text = exported.read_text(encoding="utf-8").replace(">rgss<", ">other<")
    old = "<xhtml:div>The gripper shall close within 2 s.</xhtml:div>"
    assert old in text
    new = (
        "<xhtml:div>\n  <xhtml:p>The  <xhtml:b>gripper</xhtml:b> shall</xhtml:p><!-- c -->\n"
        "<xhtml:ul><xhtml:li>close</xhtml:li>"
        "<xhtml:li>within&#160;2 s.<xhtml:br/>Soon</xhtml:li></xhtml:ul></xhtml:div>"
    )
    row = next(row for row in read_reqif(as_xml(text.replace(old, new))).rows if row.id == "SYS-2")
    assert [line for line in row.cells["text"].split("\n") if line] == [
        "The gripper shall",
        "- close",
        "- within 2 s.",
        "Soon",
    ]


def test_comments_are_passed_over_and_lines_still_count(exported, as_xml, refused, project):
    text = exported.read_text(encoding="utf-8").replace("<VALUES>", "<VALUES><!-- one\ntwo -->")
    text = text.replace("Moves.", "Moves<![CDATA[ <!-- no comment -->]]>.")
    (change,) = project.compare(read_reqif(as_xml(text)))
    assert [(each.attribute.name, each.new) for each in change.attributes] == [("text", "Moves <!-- no comment -->.")]
    assert (
        read_reqif(as_xml(text)).rows[1].line
        == read_reqif(exported).rows[1].line + text[: text.index("STK-2")].count("<!-- one") - 1
    )


def test_what_a_file_lacks_is_removed_of_its_own_types_alone(project, exported):
    foreign = read_reqif(exported)
    fewer = replace(foreign, rows=tuple(row for row in foreign.rows if row.id != "STM-lift"))
    (change,) = project.compare(fewer)
    assert (change.kind, change.id) == (ChangeKind.REMOVED, "STM-lift")
    project.apply(fewer)
    assert [each.id for each in project.requirements.architecture.behaviours] == ["UC-lift", "ACT-close", "SEQ-lift"]


BOMB = '<?xml version="1.0"?>\n<!DOCTYPE a [<!ENTITY b "x"><!ENTITY c "&b;&b;&b;&b;">]>\n<REQ-IF>&c;</REQ-IF>'
OUTSIDE = '<?xml version="1.0"?>\n<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]>\n<REQ-IF>&b;</REQ-IF>'
SPACE = 'xmlns="http://www.omg.org/spec/ReqIF/20110401/reqif.xsd"'


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (BOMB, ":2:13: error: has a document type (DTD), which may declare entities, and is refused"),
        (OUTSIDE, ":2:13: error: has a document type (DTD)"),
        ('<!DOCTYPE a SYSTEM "http://example.org/a.dtd"><REQ-IF/>', "error: has a document type (DTD)"),
        (BOMB.encode("utf-16"), ":2:13: error: has a document type (DTD)"),
        (BOMB.encode("utf-16")[:-1], "is not in its encoding 'utf-16'"),
        ('<?xml version="1.0" encoding="utf-7"?><a/>', "is in the encoding 'utf-7', not UTF-8"),
        ("<REQ-IF>&b;</REQ-IF>", "not well-formed XML: undefined entity"),
        ("", "not well-formed XML: no element found"),
        ("<a>\xff".encode("latin-1"), "not well-formed XML: "),
        ("<a>" * 300 + "</a>" * 300, "is nested more than 250 deep"),
        ("<a/>", "is XML, but not ReqIF that can be read"),
        (f"<REQ-IF {SPACE}></REQ-IF>", "has no content of ReqIF"),
        (f"<REQ-IF {SPACE}><THE-HEADER/></REQ-IF>", "is XML, but not ReqIF that can be read"),
    ],
)
def test_xml_that_is_refused_or_no_reqif_is_one_line_each(as_xml, refused, text, complaint):
    path = as_xml(text)
    lines = refused(read_reqif, path)
    assert complaint in lines[0]
    assert all(line.startswith(f"{path}:") and "\n" not in line for line in lines)


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("</REQ-IF>", "", "not well-formed XML: no element found"),
        ("<SPEC-OBJECT-TYPE-REF>", "<SPEC-OBJECT-TYPE-REF>_", "the SPEC-OBJECT-TYPE-REF '__"),
        ("<ENUM-VALUE-REF>", "<ENUM-VALUE-REF>_", "is XML, but not ReqIF that can be read"),
        ("<ATTRIBUTE-DEFINITION-XHTML-REF>", "<ATTRIBUTE-DEFINITION-XHTML-REF>_", "but not ReqIF that can be read"),
        ('THE-VALUE="STK-2"', 'THE-VALUE="STK-1"', "'STK-1' is already in line"),
        ('THE-VALUE="STK-2"', 'THE-VALUE="2"', "id: '2' is not an identifier"),
    ],
)
def test_reqif_that_is_broken_is_one_line_each(project, exported, as_xml, refused, old, new, complaint):
    text = exported.read_text(encoding="utf-8")
    assert old in text
    path = as_xml(text.replace(old, new, 1))
    lines = refused(lambda: project.compare(read_reqif(path)))
    assert complaint in lines[0]
    assert all("\n" not in line and line.startswith(f"{path}:") for line in lines)


def test_a_character_that_xml_cannot_hold_is_refused_on_the_way_out(project):
    row = next(iter(project.content.rows))
    bad = Content(rows=(replace(row, cells={**row.cells, "text": "a\x07b"}),))
    with pytest.raises(DefinitionError, match="STK-1: text has a character that XML cannot hold"):
        reqif_text(bad, title="t")


def test_the_library_is_asked_for_in_one_line(monkeypatch, project, exported):
    monkeypatch.setitem(sys.modules, "rgss.exchange.reqif.library", None)
    monkeypatch.delattr("rgss.exchange.reqif.library")
    for call in (lambda: reqif_text(project.content, title="t"), lambda: read_reqif(exported)):
        with pytest.raises(DefinitionError, match=r"needs the package reqif.*pip install 'rgss\[exchange\]'"):
            call()


def test_the_grammar_is_that_of_the_schema(schema):
    """Every element of the schema has the children of the schema; what must stand there once must do so here."""
    pending, seen = [(schema.elements["REQ-IF"], "")], set()
    while pending:
        element, around = pending.pop()
        if (element.local_name, around) in seen:
            continue
        seen.add((element.local_name, around))
        shape = shape_of(element.local_name, around)
        assert shape is not None, (element.local_name, around)
        if shape.is_open:
            continue
        inner = list(element.type.content.iter_elements()) if element.type.has_complex_content() else []
        assert {each.local_name for each in inner} <= {*shape.one, *shape.maybe, *shape.many}, element.local_name
        demanded = {each.local_name for each in inner if each.min_occurs and each.parent.min_occurs}
        assert demanded <= {*shape.one, *shape.maybe, *shape.many}
        assert {*shape.one, *shape.maybe, *shape.many} - {each.local_name for each in inner} <= {"VALUES"}
        pending += [(each, element.local_name) for each in inner]
    assert len(seen) > 100
