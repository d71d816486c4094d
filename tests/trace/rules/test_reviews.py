"""Reviews: what they stamp, and what makes them suspect."""

from __future__ import annotations

import os

import pytest

from rgss.errors import DefinitionError, StorageError
from rgss.requirements import load_requirements
from rgss.trace.rules.review_stamps import LONGEST_REVIEWER, expanded, reviews_yaml, stamped, write_reviews
from rgss.trace.rules.upstream import upstream_of_each

SECOND = """\
  - id: SYS-2
    group: gripper
    text: The gripper shall open.
    rationale: A closed one holds on.
    source: catalogue
    priority: low
    status: draft
    owner: engineer
    derived_from: [SYS-1]
    satisfied_by: [BLK-1]
    verification: test
    success: It opens.
    facility: desk
    phase: development
"""


@pytest.fixture
def reviewed(project):
    """A project in which a chain of three and the block below it are reviewed."""
    project.append("system.yaml", SECOND)
    review(project, "STK-1", "SYS-1", "SYS-2", "BLK-1")
    assert project.findings() == []
    return project


def review(project, *ids, reviewer="A. Reader"):
    requirements = load_requirements(project.folder)
    return write_reviews(project.folder, stamped(requirements, ids, reviewer))


def test_a_stamp_is_of_the_element_and_of_what_it_rests_on(reviewed):
    requirements = load_requirements(reviewed.folder)
    reviews = requirements.reviews

    assert set(reviews) == {"STK-1", "SYS-1", "SYS-2", "BLK-1"}
    assert {name: set(one.upstream) for name, one in reviews.items()} == {
        "STK-1": set(),
        "SYS-1": {"STK-1"},
        "SYS-2": {"SYS-1"},
        "BLK-1": {"SYS-1", "SYS-2"},
    }
    assert {one.reviewer for one in reviews.values()} == {"A. Reader"}
    for element, one in reviews.items():
        assert one.digest == requirements.content_digest(element)
        assert all(digest == requirements.content_digest(name) for name, digest in one.upstream.items())


def test_links_below_a_text_that_changed_are_suspect(reviewed):
    reviewed.edit("stakeholder.yaml", "serve the cup", "bring the cup")
    assert reviewed.findings() == [
        (
            f"{reviewed.position('stakeholder.yaml', 'STK-1')}: warning: 'STK-1' has changed since A. Reader reviewed "
            "it (rgss check --review STK-1) [review.changed]"
        ),
        (
            f"{reviewed.position('system.yaml', 'STK-1]')}: warning: 'SYS-1' was reviewed when 'STK-1' said something "
            "else (read both, then rgss check --review SYS-1) [review.suspect-link]"
        ),
    ]


def test_what_satisfies_a_requirement_that_changed_is_suspect_where_the_requirement_says_so(reviewed):
    reviewed.edit("system.yaml", "text: The gripper shall open.", "text: The gripper shall open wide.")
    changed, suspect = reviewed.findings()

    assert "'SYS-2' has changed since" in changed
    assert "'BLK-1' was reviewed when 'SYS-2' said something else" in suspect
    assert suspect.startswith("requirements/system.yaml:25:20: ")


def test_a_review_makes_links_clean_again(reviewed):
    reviewed.edit("stakeholder.yaml", "serve the cup", "bring the cup")
    review(reviewed, "STK-1")
    assert reviewed.rules() == ["review.suspect-link"]
    review(reviewed, "SYS-1")
    assert reviewed.rules() == []


def test_a_text_that_changes_back_is_what_was_reviewed(reviewed):
    reviewed.edit("stakeholder.yaml", "serve the cup", "bring the cup")
    assert reviewed.edit("stakeholder.yaml", "bring the cup", "serve the cup").rules() == []


def test_what_is_no_content_changes_nothing(reviewed):
    reviewed.edit(
        "system.yaml",
        "    text: The gripper shall open.\n",
        "    # a remark\n    text: >-\n      The gripper\n      shall open.\n",
    )
    assert reviewed.rules() == []


def test_a_link_that_was_added_is_suspect(reviewed):
    block = "  - {id: BLK-2, name: Arm, level: subsystem, text: Moves.}\n"
    reviewed.append("architecture.yaml", block)
    review(reviewed, "BLK-2")
    reviewed.edit(
        "system.yaml",
        "    satisfied_by: [BLK-1]\n    verification: test",
        "    satisfied_by: [BLK-1, BLK-2]\n    verification: test",
    )
    changed, *suspect = reviewed.findings()

    assert "'SYS-2' has changed" in changed
    assert "'BLK-1' was reviewed when 'SYS-2' said something else" in suspect[0]
    assert "'BLK-2' was reviewed before it rested on 'SYS-2'" in suspect[1]


def test_what_was_not_reviewed_is_noted_and_not_suspect(project):
    project.write("rules.yaml", "rules: {}\n").append("system.yaml", SECOND)
    review(project, "SYS-2")
    need, requirement = project.findings()
    told = "has not been reviewed (rgss check --review"
    assert need == f"requirements/stakeholder.yaml:2:9: info: 'STK-1' {told} STK-1) [review.missing]"
    assert requirement == f"requirements/system.yaml:2:9: info: 'SYS-1' {told} SYS-1) [review.missing]"
    project.edit("system.yaml", "lift at least", "raise at least")
    assert project.rules().count("review.suspect-link") == 1


def test_where_nobody_reviews_one_note_says_so(project):
    assert project.write("rules.yaml", "rules: {}\n").findings() == [
        (
            "requirements/stakeholder.yaml:2:9: info: none of the 2 stakeholder and system requirements has been "
            "reviewed (rgss check --review ID, or all) [review.missing]"
        )
    ]


def test_all_is_every_requirement_and_what_was_reviewed_before(project):
    assert expanded(load_requirements(project.folder), ["all"]) == ("STK-1", "SYS-1")
    review(project, "BLK-1")
    assert expanded(load_requirements(project.folder), ["all", "SYS-1"]) == ("STK-1", "SYS-1", "BLK-1")


def test_reviews_of_elements_that_are_gone_are_dropped(reviewed):
    reviewed.edit("system.yaml", SECOND, "")
    assert reviewed.rules() == ["review.unknown-id"]
    review(reviewed, "STK-1")
    assert set(load_requirements(reviewed.folder).reviews) == {"STK-1", "SYS-1", "BLK-1"}


def test_the_file_is_canonical(reviewed):
    path = reviewed.folder / "reviews.yaml"
    text = path.read_text(encoding="utf-8")
    reviews = load_requirements(reviewed.folder).reviews

    assert reviews_yaml(reviews) == reviews_yaml(dict(reversed(reviews.items()))) == text
    assert text.startswith("# Written by 'rgss check --review'")
    assert [line for line in text.splitlines() if line.startswith("  ") and line[2] != " "] == [
        "  BLK-1:",
        "  STK-1:",
        "  SYS-1:",
        "  SYS-2:",
    ]
    review(reviewed, "SYS-2", "STK-1")
    assert path.read_text(encoding="utf-8") == text


def test_no_reviews_are_a_file_too(project):
    write_reviews(project.folder, {})
    assert load_requirements(project.folder).reviews == {}


@pytest.mark.parametrize("reviewer", ["O'Neil", 'says "yes"', "back\\slash", "Zoë: #1", "{a}", "审阅者", "yes", "0x1F"])
def test_any_printable_name_survives(project, reviewer):
    review(project, "SYS-1", reviewer=reviewer)
    assert load_requirements(project.folder).reviews["SYS-1"].reviewer == reviewer


@pytest.mark.parametrize("reviewer", ["", "   ", "bell\x07", "\u202eevil", "x" * (LONGEST_REVIEWER + 1)])
def test_names_that_are_none(project, reviewer):
    with pytest.raises(DefinitionError) as caught:
        review(project, "SYS-1", reviewer=reviewer)
    assert str(caught.value) == "a reviewer is named by 1 to 80 printable characters (give --reviewer NAME)"
    assert not (project.folder / "reviews.yaml").exists()


def test_an_element_that_is_not_there(project):
    with pytest.raises(DefinitionError) as caught:
        review(project, "SYS-1", "SYS-11")
    assert str(caught.value) == "'SYS-11' is not an element of the requirements (did you mean 'SYS-1'?)"
    assert not (project.folder / "reviews.yaml").exists()


def test_a_write_that_fails_leaves_what_was_there(reviewed, monkeypatch):
    before = sorted((path.name, path.read_bytes()) for path in reviewed.folder.iterdir())

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(StorageError, match=r"reviews\.yaml cannot be written: No space left .*free some space"):
        review(reviewed, "SYS-1", reviewer="Another")
    assert sorted((path.name, path.read_bytes()) for path in reviewed.folder.iterdir()) == before


def test_more_reviews_than_can_be_read_are_not_written(project, monkeypatch):
    monkeypatch.setattr("rgss.documents.small_sources.LARGEST_FILE_BYTES", 100)
    with pytest.raises(DefinitionError, match="1 reviews take more than 0 MiB"):
        review(project, "SYS-1")


def test_what_a_behaviour_rests_on(project):
    project.append(
        "architecture.yaml",
        "behaviours:\n"
        "  - id: SEQ-1\n    name: Lift\n    kind: sequence\n    allocated_to: [BLK-1]\n    refines: [STK-1]\n"
        "    text: Lifts.\n"
        "    interaction:\n      lifelines: [BLK-1]\n"
        "      messages:\n        - {id: m1, source: BLK-1, target: BLK-1, text: a}\n"
        "        - {id: m2, source: BLK-1, target: BLK-1, text: b}\n"
        "      timings: [{first: m1, last: m2, criterion_of: SYS-1, text: t}]\n",
    )
    links = upstream_of_each(load_requirements(project.folder))["SEQ-1"]

    assert [(link.target, link.at) for link in links] == [
        ("STK-1", ("refines", 0)),
        ("SYS-1", ("interaction", "timings", 0, "criterion_of")),
    ]
