"""The digest of what a reader judges: what changes it, and what does not."""

from __future__ import annotations

import hashlib
from dataclasses import fields, replace
from enum import Enum

import pytest

from rgss.requirements import (
    BehaviourKind,
    Comparison,
    Connector,
    Exemption,
    Port,
    PortDirection,
    ValueProperty,
    VerificationPhase,
    content_digest_of,
)

EXCLUDED = {
    "success": {"criterion": None},
    "criterion_exemption": {"criterion": None},
    "kind": {"actors": (), "flow": None, "interaction": None, "machine": None},
    "actors": {"kind": BehaviourKind.USE_CASE, "flow": None, "interaction": None, "machine": None},
}
"""What an element cannot have together with an attribute."""

DETAILS = ("flow", "interaction", "machine")

STRUCTURAL = {
    "multiplicity": "2..3",
    "values": (ValueProperty(id="mass", unit="kg"),),
    "ports": (Port(id="shaft", direction=PortDirection.OUT, flow="Torque"),),
    "connectors": (Connector(source="BLK-0", target="BLK-1"),),
}
"""Sound values of the attributes that a block may leave out."""

ELEMENTS = ["STK-1", "SYS-1", "BLK-1", "UC-1", "ACT-9", "SEQ-9", "STM-9"]


def digests(project):
    requirements = project.load()
    return {element.id: requirements.content_digest(element.id) for element in requirements.elements}


def test_it_is_a_digest_of_each_element_alone(detailed):
    before = digests(detailed)
    assert len(set(before.values())) == len(before)
    assert all(len(digest) == 64 for digest in before.values())
    detailed.edit("stakeholder.yaml", "owner: cook", "owner: chef")
    after = digests(detailed)
    assert [name for name in before if before[name] != after[name]] == ["STK-1"]


def test_two_elements_with_the_same_attributes_differ_by_what_they_are(project):
    block = project.load().element("BLK-0")
    assert content_digest_of(block) != content_digest_of(replace(block, id="BLK-9"))


def other(value):
    """A value that a reader would take for another one; None where there is none to be made."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, Enum):
        return next(each for each in type(value) if each is not value)
    if isinstance(value, str):
        return f"{value}-too"
    if isinstance(value, tuple):
        return (*value, "MORE") if all(isinstance(part, str) for part in value) else value[:-1]
    return "OTHER" if value is None else None


@pytest.mark.parametrize("element_id", ELEMENTS)
def test_every_attribute_but_the_exemptions_is_content(detailed, element_id):
    whole = detailed.load().element(element_id)
    for field in fields(whole):
        excluded = {name: value for name, value in EXCLUDED.get(field.name, {}).items() if hasattr(whole, name)}
        element = replace(whole, **excluded)
        changed = other(getattr(element, field.name))
        if field.name == "exempt":
            changed = (Exemption(rule="r", reason="R"),)
        elif field.name == "phase":
            changed = VerificationPhase.OPERATION
        elif field.name in STRUCTURAL:
            changed = STRUCTURAL[field.name]
        elif changed is None or field.name in DETAILS:
            continue
        same = content_digest_of(replace(element, **{field.name: changed})) == content_digest_of(element)
        assert same is (field.name == "exempt"), field.name


def test_every_part_of_a_detail_is_content(detailed):
    requirements = detailed.load()
    for element_id, name in (("ACT-9", "flow"), ("SEQ-9", "interaction"), ("STM-9", "machine")):
        element = requirements.element(element_id)
        detail, before = getattr(element, name), content_digest_of(element)
        for field in fields(detail):
            entries = getattr(detail, field.name)
            changed = replace(detail, **{field.name: entries[:-1]})
            assert content_digest_of(replace(element, **{name: changed})) != before
            if isinstance(entries[0], str):
                continue
            for part in fields(entries[0]):
                value = other(getattr(entries[0], part.name))
                altered = replace(detail, **{field.name: (replace(entries[0], **{part.name: value}), *entries[1:])})
                assert content_digest_of(replace(element, **{name: altered})) != before, part.name


def test_every_part_of_a_criterion_is_content(project):
    requirement = project.load().element("SYS-1")
    before = content_digest_of(requirement)
    for name, value in {
        "measure": "Q",
        "comparison": Comparison.AT_MOST,
        "threshold": 0.0,
        "unit": "kg",
    }.items():
        criterion = replace(requirement.criterion, **{name: value})
        assert content_digest_of(replace(requirement, criterion=criterion)) != before, name


def test_a_threshold_of_zero_is_stated(project):
    requirement = project.load().element("SYS-1")
    zero, tiny = (
        content_digest_of(replace(requirement, criterion=replace(requirement.criterion, threshold=value)))
        for value in (0.0, 1e-300)
    )
    assert zero != tiny


def test_where_and_how_it_is_written_is_no_content(project):
    before = digests(project)
    project.edit(
        "system.yaml",
        "text: The gripper shall lift at least 0.8 kg.",
        "text: >-\n      The gripper shall\n      lift at   least 0.8 kg.",
    )
    project.edit("system.yaml", "[BLK-1, ACT-1]", "[ACT-1, BLK-1]")
    project.edit("system.yaml", "    group: gripper\n", "")
    project.edit("system.yaml", "    rationale:", "    group: gripper\n    rationale:")
    project.edit("stakeholder.yaml", "requirements:\n", "# A comment.\n\nrequirements:\n")
    assert digests(project) == before


def test_the_order_of_what_happens_is_content(detailed):
    before = digests(detailed)
    lines = "        - {source: both, target: lift}\n", "        - {source: both, target: look}\n"
    detailed.edit("architecture.yaml", "".join(lines), "".join(reversed(lines)))
    after = digests(detailed)
    assert [name for name in before if before[name] != after[name]] == ["ACT-9"]


def test_a_digest_is_the_same_on_every_machine(project):
    """It stands in files that are kept under version control."""
    content = (
        '{"content":{"id":"BLK-0","level":"system","name":"System","relation":"part","text":"The whole."},'
        '"element":"Block"}'
    )
    assert project.load().content_digest("BLK-0") == hashlib.sha256(content.encode("ascii")).hexdigest()
