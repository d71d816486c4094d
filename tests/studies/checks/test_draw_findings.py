"""Draws that the geometry of a scene excludes are found before anything is simulated."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from rgss.findings import Severity
from rgss.studies.checks.draw_check import draw_findings
from rgss.studies.project import load_project

REPOSITORY = Path(__file__).parents[3]


@pytest.fixture
def found_with(tmp_path):
    """Findings with an uncertain quantity in the scene's or the study's file."""
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)

    def find(line, file="scenes/restaurant.yaml"):
        study = tmp_path / "studies" / "pick_place.yaml"
        text = study.read_text(encoding="utf-8")
        study.write_text(re.sub(r"(?m)^(uncertainty|correlations):.*\n(^[ #].*\n|^\n)*", "", text), encoding="utf-8")
        path = tmp_path / file
        text = path.read_text(encoding="utf-8")
        assert "\nuncertainty:" not in text
        path.write_text(f"{text}\nuncertainty:\n  {line}\n", encoding="utf-8")
        return list(draw_findings(load_project(tmp_path)))

    return find


# The cup, 100 mm high, stands 250 mm from one edge of a counter of 600 mm along x.
@pytest.mark.parametrize(
    ("name", "ends", "share", "where"),
    [
        ("workpiece.centre_of_mass", 80, 37.5, "outside cup, by up to 29.9"),
        ("workpiece.x", 300, 100 * 50 / 600, "beyond the edge of counter_pick, by up to 49.7"),
    ],
)
def test_the_share_of_impossible_draws_is_a_warning_at_the_quantity(found_with, name, ends, share, where):
    (one,) = found_with(f"{name}: {{uniform: {{low: -{ends} mm, high: {ends} mm}}, rationale: r}}")
    assert (one.rule, one.severity, one.file) == ("uncertainty.outside", Severity.WARNING, "scenes/restaurant.yaml")
    assert f" of the draws of {name} have the centre of mass {where}" in one.message
    assert float(one.message.split(" %")[0]) == pytest.approx(share, abs=0.2)


def test_offsets_of_joints_that_the_arm_does_not_have_are_a_warning(found_with):
    (one,) = found_with("robot.slide_offset: {normal: {mean: 0 mm, sd: 1 mm}, rationale: r}")
    assert (one.rule, one.severity, one.file) == ("uncertainty.no-joint", Severity.WARNING, "scenes/restaurant.yaml")
    assert one.message == "robot.slide_offset has no effect: the arm has no sliding joint"
    assert one.hint == "use robot.joint_offset for turning joints, or remove it"


@pytest.mark.parametrize(
    "line",
    [
        "workpiece.centre_of_mass: {uniform: {low: -50 mm, high: 49 mm}, rationale: r}",
        "workpiece.x: {uniform: {low: -250 mm, high: 340 mm}, rationale: r}",
        "workpiece.y: {normal: {mean: 0 mm, sd: 3 mm}, rationale: r}",
        "perception.x: {uniform: {low: -300 mm, high: 300 mm}, rationale: r}",
        "robot.joint_offset: {normal: {mean: 0 deg, sd: 1 deg}, rationale: r}",
    ],
)
def test_possible_draws_have_no_finding(found_with, line):
    assert found_with(line) == []


def test_the_uncertainty_of_a_study_is_found_in_its_file(found_with):
    (one,) = found_with("workpiece.y: {constant: 2 m, rationale: r}", file="studies/pick_place.yaml")
    assert one.file == "studies/pick_place.yaml"
    assert one.message.startswith("100 % of the draws of workpiece.y have the centre of mass beyond the edge of ")
