"""Designs of which the step does not resolve the impact or pass the force are found before anything is simulated."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from rgss.cli.main import main
from rgss.findings import Severity
from rgss.studies import light_body_findings
from rgss.studies.checks.impact_check import impact_findings
from rgss.studies.project import load_project

REPOSITORY = Path(__file__).parents[2]


@pytest.fixture
def folder(tmp_path):
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    return tmp_path


def change(folder, file, old, new):
    text = (folder / file).read_text(encoding="utf-8")
    assert old in text
    (folder / file).write_text(text.replace(old, new), encoding="utf-8")


def test_the_reference_study_resolves_its_impacts(folder):
    assert tuple(impact_findings(load_project(folder))) == ()


def test_an_object_that_an_impact_may_damage_needs_a_finer_step(folder, capsys):
    change(folder, "scenes/restaurant.yaml", "force_limit: 40 N", "force_limit: 12 N")
    findings = tuple(impact_findings(load_project(folder)))
    assert findings
    for finding in findings:
        assert (finding.rule, finding.severity) == ("study.coarse-impact", Severity.WARNING)
        assert finding.hint == "step at 1000 Hz or more"
    assert "12 N that the object bears depends on the step" in findings[0].message
    main(["check", "--project", str(folder)])
    assert "study.coarse-impact" in capsys.readouterr().out
    change(folder, "studies/pick_place.yaml", "rate: 240 Hz", "rate: 1000 Hz")
    assert tuple(impact_findings(load_project(folder))) == ()


def test_trials_without_contact_have_no_impact(folder):
    change(folder, "scenes/restaurant.yaml", "force_limit: 40 N", "force_limit: 12 N")
    change(folder, "studies/pick_place.yaml", "fidelity: contact", "fidelity: kinematic")
    assert tuple(impact_findings(load_project(folder))) == ()


def test_the_reference_study_has_no_light_body(folder):
    assert tuple(light_body_findings(load_project(folder))) == ()


def test_a_cup_of_half_a_gram_needs_a_finer_step(folder):
    change(folder, "scenes/restaurant.yaml", "\n  mass: 0.25 kg", "\n  mass: 500 mg")
    found = tuple(light_body_findings(load_project(folder)))
    assert found
    for finding in found:
        assert (finding.rule, finding.severity) == ("study.light-body", Severity.WARNING)
        assert ": 0.0005 kg are too light for the solver to press with" in finding.message
    change(folder, "studies/pick_place.yaml", "fidelity: contact", "fidelity: kinematic")
    assert tuple(light_body_findings(load_project(folder))) == ()
