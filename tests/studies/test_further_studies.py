"""The studies of the YuMi and of the Lite6: sound, with requirements of their own, and trials that succeed."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.cli.main import main
from rgss.findings import Severity
from rgss.studies import check_scene
from rgss.studies.project import load_project

REPOSITORY = Path(__file__).parents[2]
YUMI, LITE6 = "studies/yumi_widget.yaml", "studies/lite6_cubes.yaml"


def told(capsys, *words):
    status = main([*words, "--project", str(REPOSITORY)])
    return status, capsys.readouterr().out


@pytest.mark.parametrize("study", [YUMI, LITE6])
def test_the_study_is_sound_and_has_requirements_of_its_own(study, capsys):
    project = load_project(REPOSITORY, study)
    criteria = [one.criterion for one in project.requirements.system]

    assert told(capsys, "check", study)[0] == 0
    assert len(criteria) >= 12
    assert all(criterion is not None for criterion in criteria)
    reference = {one.text for one in load_project(REPOSITORY).requirements.system}
    assert reference.isdisjoint({one.text for one in project.requirements.system})


@pytest.mark.parametrize(("study", "variant"), [(YUMI, 1), (YUMI, 24), (LITE6, 17), (LITE6, 32)])
def test_a_trial_without_contact_succeeds(study, variant, capsys):
    status, output = told(capsys, "run", str(variant), "--study", study, "--fidelity", "kinematic")

    assert (status, "Success" in output) == (0, True)


def test_the_normal_mounting_cannot_take_the_cube_and_says_so(capsys):
    findings = check_scene(load_project(REPOSITORY, LITE6)).findings
    assert {finding.rule for finding in findings} == {"scene.unserved"}
    assert {finding.severity for finding in findings} == {Severity.INFO}
    assert all("lite6_normal.yaml" in finding.message for finding in findings)

    _, output = told(capsys, "run", "1", "--study", LITE6, "--fidelity", "kinematic")
    assert (
        "no configuration serves grasp: the object of 30 mm is too wide to enter gripper lite6_normal, "
        "which opens to 16 mm"
    ) in output
