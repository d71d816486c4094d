"""The files of the folder: parts that are one file or several, and files that may be left out."""

from __future__ import annotations

import pytest

from rgss.findings import Severity
from rgss.requirements import Exemption, Review, RuleSetting

DIGEST, OTHER = "0" * 64, "f" * 64


def divided(project):
    """The system requirements in a folder of two files, the second before the first in the alphabet of its text."""
    text = (project.folder / "system.yaml").read_text(encoding="utf-8")
    (project.folder / "system.yaml").unlink()
    project.write("system/2-late.yaml", text)
    return project.write("system/1-early.yaml", text.replace("SYS-1", "SYS-2").replace("0.8 kg", "0.9 kg"))


def test_a_part_may_be_a_folder_read_in_the_order_of_its_names(project):
    requirements = divided(project).load()
    assert [item.id for item in requirements.system] == ["SYS-2", "SYS-1"]
    assert requirements.finding("rule", "SYS-1", "m").file == "requirements/system/2-late.yaml"


def test_folders_within_a_part_are_read_too_and_hidden_files_are_not(project):
    divided(project)
    (project.folder / "system" / "inner").mkdir()
    (project.folder / "system" / "2-late.yaml").rename(project.folder / "system" / "inner" / "late.yaml")
    (project.folder / "system" / ".#1-early.yaml").write_text("of an editor", encoding="utf-8")
    (project.folder / "system" / "notes.txt").write_text("of a person", encoding="utf-8")
    assert [item.id for item in project.load().system] == ["SYS-2", "SYS-1"]


def test_blocks_and_behaviours_may_stand_in_files_of_their_own(project):
    text = (project.folder / "architecture.yaml").read_text(encoding="utf-8")
    blocks, behaviours = text.split("behaviours:\n")
    (project.folder / "architecture.yaml").unlink()
    project.write("architecture/structure.yaml", blocks).write("architecture/a.yaml", f"behaviours:\n{behaviours}")
    assert [item.id for item in project.load().elements][2:] == ["BLK-0", "BLK-1", "UC-1", "ACT-1", "ACT-2"]


def test_an_id_is_unique_across_the_files_of_a_part(project):
    divided(project).edit("system/1-early.yaml", "SYS-2", "SYS-1")
    assert project.findings() == [
        (
            "requirements/system/2-late.yaml:2:9: error: id 'SYS-1' is already declared at "
            "requirements/system/1-early.yaml:2:9 (use a unique id) [requirements.duplicate-id]"
        )
    ]


def test_problems_of_every_file_of_a_part_are_reported_at_once(project):
    divided(project)
    project.edit("system/1-early.yaml", "group: gripper", "group: hand")
    project.edit("system/2-late.yaml", "status: draft", "status: done")
    project.edit("architecture.yaml", "includes: [ACT-2]", "includes: [ACT-3]")
    assert [finding.split(": ")[0] for finding in project.findings()] == [
        project.position("architecture.yaml", "ACT-3"),
        project.position("system/1-early.yaml", "hand"),
        project.position("system/2-late.yaml", "done"),
    ]


def test_references_into_a_part_of_which_a_file_is_broken_are_left_alone(project):
    divided(project).edit("system/2-late.yaml", "derived_from: [STK-1]", "derived_from: [STK-1, SYS-2]")
    project.edit("system/1-early.yaml", "group: gripper", "group: hand")
    (finding,) = project.findings()
    assert finding.endswith("[document.value]")


def test_a_file_and_a_folder_of_one_part(project):
    text = (project.folder / "system.yaml").read_text(encoding="utf-8")
    divided(project).write("system.yaml", text)
    assert project.findings() == [
        (
            "requirements/system.yaml:1:1: error: 'system' is both a file and a folder "
            "(move system.yaml into the folder, under another name) [document.both]"
        )
    ]


def test_a_folder_without_files(project):
    (project.folder / "system.yaml").unlink()
    (project.folder / "system").mkdir()
    assert project.findings() == [
        "requirements/system:1:1: error: the folder has no .yaml file (add one) [document.missing]"
    ]


@pytest.mark.parametrize("name", ["1-early.yml", "1-early.YAML", "1-early.yaml.txt"])
def test_a_file_that_would_be_passed_over_is_reported(project, name):
    divided(project)
    (project.folder / "system" / "1-early.yaml").rename(project.folder / "system" / name)
    assert project.findings() == [
        (
            f"requirements/system/{name}:1:1: error: the name of a requirements file must end in .yaml "
            "(rename it) [document.name]"
        )
    ]


def test_an_architecture_file_of_neither_blocks_nor_behaviours(project):
    project.write("architecture.yaml", "blocks: []\n").edit("system.yaml", "[BLK-1, ACT-1]", "[]")
    assert project.findings() == [
        "requirements/architecture.yaml:1:1: error: blocks or behaviours are expected [document.value]"
    ]


def test_without_settings_and_reviews_there_are_none(project):
    requirements = project.load()
    assert (dict(requirements.settings), dict(requirements.setting_places)) == ({}, {})
    assert (dict(requirements.reviews), dict(requirements.review_places)) == ({}, {})


def test_settings_of_rules(project):
    project.write(
        "rules.yaml",
        "rules:\n"
        "  wording.R19: {severity: info, reason: Lists are short here.}\n"
        "  wording.R7: {enabled: false, terms_added: [nice], terms_removed: [some, any], reason: Later.}\n",
    )
    requirements = project.load()
    assert dict(requirements.settings) == {
        "wording.R19": RuleSetting(
            severity=Severity.INFO,
            enabled=True,
            terms_added=(),
            terms_removed=(),
            reason="Lists are short here.",
        ),
        "wording.R7": RuleSetting(
            severity=None,
            enabled=False,
            terms_added=("nice",),
            terms_removed=("some", "any"),
            reason="Later.",
        ),
    }
    place = requirements.setting_places["wording.R7"]
    assert str(place.finding("r", "m", at=("terms_removed", 1))) == "requirements/rules.yaml:3:75: error: m [r]"
    assert place.finding("r", "m", at_key=True, severity=Severity.INFO).column == 3


def test_reviews(project):
    project.write(
        "reviews.yaml",
        f"reviews:\n  SYS-1: {{digest: '{DIGEST}', reviewer: A. Reader, upstream: {{STK-1: '{OTHER}'}}}}\n"
        f"  GONE-1: {{digest: '{DIGEST}', reviewer: A. Reader, upstream: {{}}}}\n",
    )
    requirements = project.load()
    assert requirements.reviews["SYS-1"] == Review(digest=DIGEST, upstream={"STK-1": OTHER}, reviewer="A. Reader")
    assert requirements.reviews["GONE-1"].upstream == {}
    place = requirements.review_places["GONE-1"]
    assert str(place.finding("r", "m", hint="h", at_key=True)) == "requirements/reviews.yaml:3:3: error: m (h) [r]"


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("rules.yaml", "rules: {wording.R1: {severity: info}}", "1:21: error: key 'reason' is missing"),
        ("rules.yaml", "rules: {wording.R1: {severity: bad, reason: R}}", "1:32: error: severity: 'bad' is not one of"),
        ("rules.yaml", "rules: {7: {reason: R}}", "1:12: error: 7: '7' is not an identifier"),
        ("rules.yaml", "rulez: {}", "1:1: error: unknown key 'rulez' (did you mean 'rules'?)"),
        (
            "reviews.yaml",
            "reviews: {SYS-1: {digest: abc, reviewer: R, upstream: {}}}",
            "1:27: error: digest: 'abc' does",
        ),
        ("reviews.yaml", f"reviews: {{SYS-1: {{digest: {DIGEST}, upstream: {{}}}}}}", "1:18: error: key 'reviewer' is"),
        ("reviews.yaml", "", "1:1: error: the file is empty"),
    ],
)
def test_a_malformed_file_that_may_be_left_out_is_refused(project, name, text, said):
    project.write(name, text)
    assert any(finding.startswith(f"requirements/{name}:{said}") for finding in project.findings()), project.findings()


def test_exemptions(project):
    project.edit("stakeholder.yaml", "    owner: cook\n", "    owner: cook\n    exempt: [{rule: r.1, reason: Old.}]\n")
    project.edit(
        "system.yaml", "    owner: engineer\n", "    owner: engineer\n    exempt: [{rule: r.2, reason: New.}]\n"
    )
    project.edit("architecture.yaml", "text: The whole.", "text: The whole., exempt: [{rule: r.3, reason: Big.}]")
    project.edit("architecture.yaml", "text: Closes.", "text: Closes., exempt: [{rule: r.4, reason: Odd.}]")
    requirements = project.load()
    exempt = {item.id: item.exempt for item in requirements.elements if item.exempt}
    assert exempt == {
        "STK-1": (Exemption(rule="r.1", reason="Old."),),
        "SYS-1": (Exemption(rule="r.2", reason="New."),),
        "BLK-0": (Exemption(rule="r.3", reason="Big."),),
        "ACT-2": (Exemption(rule="r.4", reason="Odd."),),
    }


def test_an_exemption_that_is_stated_twice_or_without_a_reason(project):
    twice = "exempt: [{rule: r.1, reason: A.}, {rule: r.2, reason: B.}, {rule: r.1 , reason: C.}]"
    project.edit("system.yaml", "    owner: engineer\n", f"    owner: engineer\n    {twice}\n")
    expected = f"{project.position('system.yaml', 'r.1 ,')}: error: exempt: 'r.1' is named twice (keep one) "
    assert project.findings() == [f"{expected}[requirements.repeated-id]"]
    project.edit("system.yaml", "rule: r.2, reason: B.", "rule: r.2")
    assert "key 'reason' is missing (add 'reason')" in project.findings()[0]
