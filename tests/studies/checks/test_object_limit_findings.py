"""Objects that the robot cannot carry, or that every grip damages, are found before anything is simulated."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.evidence import Fidelity
from rgss.findings import Severity
from rgss.studies.checks.object_limit_check import object_limit_findings
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project

REPOSITORY = Path(__file__).parents[3]
SCENE = "scenes/restaurant.yaml"


@pytest.fixture
def folder(tmp_path):
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    return tmp_path


def change(folder, file, old, new):
    text = (folder / file).read_text(encoding="utf-8")
    assert text.count(old) == 1
    (folder / file).write_text(text.replace(old, new), encoding="utf-8")


def found_in(folder):
    return list(object_limit_findings(load_project(folder)))


def test_the_reference_study_is_within_the_limits(folder):
    assert found_in(folder) == []


@pytest.mark.parametrize(("mass", "found"), [("mass: 10 kg", 0), ("mass: 10.2 kg", 1), ("density: 40 g/cm^3", 1)])
def test_an_object_heavier_than_the_payload_of_the_robot(folder, mass, found):
    change(folder, SCENE, "\n  mass: 0.25 kg", f"\n  {mass}")
    findings = [one for one in found_in(folder) if one.rule == "scene.payload"]
    assert len(findings) == found
    for one in findings:
        assert one.severity == Severity.WARNING
        assert one.message.startswith("cup of 1")
        assert one.message.endswith(" kg exceeds the payload of the robot, 10 kg")
        text = (folder / SCENE).read_text(encoding="utf-8").splitlines()
        assert mass in text[one.line - 1]


def test_an_object_that_the_friction_of_no_fingers_bears(folder):
    """The strongest of the designs presses with the greatest mu N F."""
    project = load_project(folder)
    grippers = [spec.gripper for spec in trial_specs(project, seeds=(1,))]
    cup = project.scene.workpiece
    borne_n = [one.geometry.fingers * one.finger_force_n * one.friction * cup.friction for one in grippers]
    heaviest_kg = max(borne_n) / project.scene.gravity_m_s2
    for share, found in ((0.999, 0), (1.001, 1)):
        heavy = replace(cup, mass_kg=share * heaviest_kg)
        scene = replace(project.scene, workpiece=heavy, robot=replace(project.scene.robot, payload_kg=100.0))
        findings = list(object_limit_findings(replace(project, scene=scene)))
        assert len(findings) == found
    (one,) = findings
    force_n = grippers[borne_n.index(max(borne_n))].finger_force_n
    assert (one.rule, one.severity) == ("scene.grip", Severity.WARNING)
    assert one.message == (
        f"the friction of no design's fingers bears cup of {heavy.mass_kg:.3g} kg: that takes "
        f"{1.001 * force_n:.3g} N on each, and they press with {force_n:.3g} N at most"
    )
    kinematic = replace(project, scene=scene, study=replace(project.study, fidelity=Fidelity.KINEMATIC))
    assert list(object_limit_findings(kinematic)) == []


def test_an_object_that_no_grip_leaves_whole(folder):
    change(folder, SCENE, "force_limit: 40 N", "force_limit: 5 N")
    project = load_project(folder)
    # The least force of any design, of which the grip holds 70 %.
    held_n = 0.7 * min(spec.gripper.finger_force_n for spec in trial_specs(project, seeds=(1,)))
    (one,) = object_limit_findings(project)
    assert (one.rule, one.severity) == ("scene.force-limit", Severity.WARNING)
    assert one.message == (
        f"cup bears 5 N, and the fingers hold it with {held_n:.3g} N or more in 72 variants, such as 1"
    )


def test_an_object_that_some_grips_leave_whole_is_a_result():
    """The YuMi's designs press with 5, 10 and 20 N."""
    project = load_project(REPOSITORY, "studies/yumi_widget.yaml")
    weak = replace(project.scene.workpiece, force_limit_n=10.0)
    project = replace(project, scene=replace(project.scene, workpiece=weak))
    (one,) = object_limit_findings(project)
    assert one.severity is Severity.INFO
    assert "hold it with 14 N or more in 8 variants" in one.message
    kinematic = replace(project, study=replace(project.study, fidelity=Fidelity.KINEMATIC))
    assert list(object_limit_findings(kinematic)) == []
