"""Several sets of requirements in one project: each study verifies its own, and ids may repeat between them."""

from __future__ import annotations

import shutil

import pytest

from rgss.assessment import project_marks
from rgss.cli.main import main
from rgss.errors import DocumentError
from rgss.studies import load_project, named_sets, requirements_of_study, studies_by_set, unread_findings
from rgss.studies.scaffolding import write_scaffold
from rgss.studies.schemas.document_kinds import kind_of

DEFAULT, OWN = "studies/pick_place.yaml", "studies/second.yaml"
SENTENCE = "The gripper shall have a payload of at least 0.5 kg."
FILES = ("architecture.yaml", "measures.yaml", "stakeholder.yaml", "system.yaml")


@pytest.fixture
def project(tmp_path):
    """A new project with a second set, whose first requirement has the same id and another threshold."""
    folder = tmp_path / "project"
    write_scaffold(folder)
    (folder / "requirements" / "own").mkdir()
    for name in FILES:
        shutil.copy(folder / "requirements" / name, folder / "requirements" / "own" / name)
    system = folder / "requirements" / "own" / "system.yaml"
    text = system.read_text(encoding="utf-8").replace("at least 0.5 kg", "at least 0.7 kg")
    system.write_text(text.replace("threshold: 0.5 kg", "threshold: 0.7 kg"), encoding="utf-8")
    study = (folder / DEFAULT).read_text(encoding="utf-8")
    study = study.replace("study: pick_place\n", "study: second\nrequirements: requirements/own\n")
    (folder / OWN).write_text(study, encoding="utf-8")
    return folder


def command(project, *words, capsys):
    status = main([*words, "--project", str(project)])
    return status, capsys.readouterr().out


def test_each_study_has_the_requirements_that_it_names(project):
    default, own = load_project(project), load_project(project, OWN)

    assert (default.study.requirements, own.study.requirements) == ("requirements", "requirements/own")
    assert default.requirements.requirement("SYS-1").criterion.threshold == 0.5
    assert own.requirements.requirement("SYS-1").criterion.threshold == 0.7
    assert {each.file for each in own.measure_traces} == {"requirements/own/measures.yaml"}
    assert studies_by_set(project) == {"requirements": DEFAULT, "requirements/own": OWN}
    assert named_sets(project) == ("requirements/own",)
    assert unread_findings(project) == ()


def test_a_stroke_at_the_end_is_no_other_set(project):
    study = project / OWN
    text = study.read_text(encoding="utf-8").replace("requirements/own", "requirements/own/")
    study.write_text(text, encoding="utf-8")

    assert requirements_of_study(project, OWN) == load_project(project, OWN).study.requirements == "requirements/own"


def test_an_id_may_repeat_between_sets_and_not_within_one(project):
    system = project / "requirements" / "own" / "system.yaml"
    system.write_text(system.read_text(encoding="utf-8").replace("id: SYS-2", "id: SYS-1"), encoding="utf-8")

    with pytest.raises(DocumentError) as caught:
        load_project(project, OWN)
    assert any(
        finding.rule == "requirements.duplicate-id" and finding.file == "requirements/own/system.yaml"
        for finding in caught.value.findings
    )
    assert load_project(project).requirements.requirement("SYS-2").id == "SYS-2"


@pytest.mark.parametrize(
    ("name", "told", "hint"),
    [
        ("requirements/none", "there is no folder 'requirements/none'", "make it, with stakeholder"),
        ("designs", "'designs' is not a folder of requirements/", "write 'requirements', or 'requirements/NAME'"),
        ("../other", "'../other' is not a folder of requirements/", "write 'requirements', or"),
        ("requirements/..", "'requirements/..' is not a folder of requirements/", "write 'requirements', or"),
        ("requirements/a/b", "'requirements/a/b' is not a folder of requirements/", "write 'requirements', or"),
        ("requirements/system", "'requirements/system' is a part of the default set", "a set is called none of"),
        ("requirements/away", "'requirements/away' leads out of the project", "copy the folder into the project"),
    ],
)
def test_a_set_that_cannot_be_used(project, tmp_path, name, told, hint):
    (tmp_path / "elsewhere").mkdir()
    (project / "requirements" / "away").symlink_to(tmp_path / "elsewhere")
    study = project / OWN
    study.write_text(study.read_text(encoding="utf-8").replace("requirements/own", name), encoding="utf-8")

    with pytest.raises(DocumentError) as caught:
        load_project(project, OWN)
    (finding,) = [each for each in caught.value.findings if each.rule == "study.requirements"]
    assert (finding.file, finding.line, finding.message) == (OWN, 4, told)
    assert finding.hint.startswith(hint)


def test_check_without_a_study_checks_every_set(project, capsys):
    status, output = command(project, "check", capsys=capsys)
    assert (status, [line.partition(":")[0] for line in output.splitlines()]) == (0, [DEFAULT, OWN])

    system = project / "requirements" / "own" / "system.yaml"
    system.write_text(system.read_text(encoding="utf-8").replace("satisfied_by: [BLK-gripper, ACT-carry]\n", ""))
    status, output = command(project, "check", capsys=capsys)
    assert status != 0
    assert output.startswith("requirements/own/system.yaml:")

    status, output = command(project, "check", DEFAULT, capsys=capsys)
    assert (status, len(output.splitlines())) == (0, 1)


def test_check_tells_of_a_default_study_that_cannot_be_read(project, capsys):
    (project / DEFAULT).write_text("study: [\n", encoding="utf-8")

    status, output = command(project, "check", capsys=capsys)
    assert (status, output.partition(":")[0]) == (2, DEFAULT)


def test_trace_and_a_review_are_of_the_study_that_is_named(project, capsys):
    status, output = command(project, "trace", "SYS-1", "--study", OWN, capsys=capsys)
    assert (status, "at least 0.7 kg" in output, "at least 0.5 kg" in output) == (0, True, False)

    status, _ = command(project, "check", OWN, "--review", "SYS-1", "--reviewer", "somebody", capsys=capsys)
    assert status == 0
    assert (project / "requirements" / "own" / "reviews.yaml").exists()
    assert not (project / "requirements" / "reviews.yaml").exists()
    assert set(load_project(project, OWN).requirements.reviews) == {"SYS-1"}


def test_a_set_that_no_study_names_is_told(project):
    (project / OWN).unlink()

    found = unread_findings(project)
    assert [each.file for each in found] == [f"requirements/own/{name}" for name in FILES]
    assert {each.hint for each in found} == {"name its folder in a study: 'requirements: requirements/own'"}


def test_a_misnamed_file_of_a_set(project):
    (project / "requirements" / "own" / "sytem.yaml").write_text("requirements: []\n", encoding="utf-8")

    (found,) = unread_findings(project)
    assert (found.file, found.hint) == (
        "requirements/own/sytem.yaml",
        "is it meant to be 'requirements/own/system.yaml'?",
    )


def test_files_of_a_set_have_the_schemas_of_their_parts():
    assert kind_of("requirements/own/system.yaml", {}).id == "system"
    assert kind_of("requirements/own/architecture/blocks.yaml", {}).id == "architecture"
    assert kind_of("requirements/own/other.yaml", {}) is None


def test_marks_of_tests_are_of_the_set_that_they_name(project):
    (project / "tests").mkdir()
    text = 'import pytest\n\n@pytest.mark.verifies("SYS-1", "own/SYS-2")\ndef test_it(): ...\n'
    (project / "tests" / "test_it.py").write_text(text, encoding="utf-8")

    assert [each.requirements for each in project_marks(project)] == [("SYS-1",)]
    assert [each.requirements for each in project_marks(project, "requirements/own")] == [("SYS-2",)]
