"""ReqIF with a part of the elements, with default values, and with another prefix of its namespace."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from lxml import etree

from rgss.exchange import ImportDefaults, compare, with_absent_links
from rgss.exchange.attributes import ATTRIBUTES, Part
from rgss.exchange.comparison import ChangeKind

NOTHING_ASSUMED = ImportDefaults(part=None, defaults={})


def without(text, prefix):
    """The file without the elements whose ids begin so, and without what names them."""
    tree = etree.fromstring(text.encode("utf-8"))
    of = {"r": tree.nsmap[None]}
    gone = set()
    for each in tree.xpath("//r:SPEC-OBJECT", namespaces=of):
        values = each.xpath(".//r:ATTRIBUTE-VALUE-STRING/@THE-VALUE", namespaces=of)
        if any(value.startswith(prefix) for value in values[:1]):
            gone.add(each.get("IDENTIFIER"))
            each.getparent().remove(each)
    assert gone
    for each in tree.xpath("//r:SPEC-RELATION | //r:SPEC-HIERARCHY", namespaces=of):
        named = each.xpath(
            "./r:OBJECT/r:SPEC-OBJECT-REF/text() | ./r:SOURCE/* /text() | ./r:TARGET/*/text()", namespaces=of
        )
        if gone & set(named):
            each.getparent().remove(each)
    return etree.tostring(tree, encoding="UTF-8", xml_declaration=True)


def test_a_part_of_the_elements_removes_no_link_to_the_others(project, text, read):
    foreign = with_absent_links(project.content, read(without(text, "STK-")), remove=False)

    changes = compare(project.content, foreign, NOTHING_ASSUMED)
    assert {change.kind for change in changes} == {ChangeKind.REMOVED}
    assert {change.part for change in changes} == {Part.STAKEHOLDER}


def test_links_to_what_is_removed_are_removed(project, text, read):
    foreign = with_absent_links(project.content, read(without(text, "STK-")), remove=True)

    changed = [one for one in compare(project.content, foreign, NOTHING_ASSUMED) if one.kind is ChangeKind.CHANGED]
    assert changed
    assert all("STK-" in each.old and "STK-" not in each.new for one in changed for each in one.attributes)


def test_a_link_between_elements_of_the_file_is_removed_as_before(project, read, text):
    foreign = read(text)
    derived = next(row for row in foreign.rows if row.cells.get("derived_from"))
    rows = tuple(
        replace(row, cells={**row.cells, "derived_from": ""}) if row.id == derived.id else row for row in foreign.rows
    )
    kept = with_absent_links(project.content, replace(foreign, rows=rows), remove=False)

    assert next(row for row in kept.rows if row.id == derived.id).cells["derived_from"] == ""


def test_another_prefix_of_the_namespace_is_the_same_file(text, read):
    prefixed = re.sub(r"(</?)(?=[A-Z])", r"\1reqif:", text).replace(" xmlns=", " xmlns:reqif=", 1)
    assert "<reqif:REQ-IF " in prefixed

    assert read(prefixed) == read(text)


@pytest.mark.parametrize("name", ["owner", "priority", "rationale"])
def test_an_object_without_a_value_has_the_default_of_its_type(project, text, read, name):
    """A string, a choice and formatted text."""
    attribute = next(each for each in ATTRIBUTES[Part.SYSTEM] if each.name == name)
    expected = next(row for row in project.content.rows if row.part is Part.SYSTEM and row.cells[name])
    tree = etree.fromstring(text.encode("utf-8"))
    of = {"r": tree.nsmap[None]}
    (definition,) = tree.xpath(
        f"//r:SPEC-OBJECT-TYPE[@LONG-NAME='System requirement']//*[@LONG-NAME='{name}']", namespaces=of
    )
    values = tree.xpath(
        f"//*[starts-with(local-name(), 'ATTRIBUTE-VALUE-')][r:DEFINITION/*='{definition.get('IDENTIFIER')}']",
        namespaces=of,
    )
    value = next(each for each in values if each.getparent().xpath(f".//@THE-VALUE='{expected.id}'", namespaces=of))
    value.getparent().remove(value)
    default = etree.SubElement(definition, f"{{{of['r']}}}DEFAULT-VALUE")
    default.append(value)
    foreign = read(etree.tostring(tree, encoding="UTF-8", xml_declaration=True))

    assert next(row for row in foreign.rows if row.id == expected.id).cells[attribute.name] == expected.cells[name]
