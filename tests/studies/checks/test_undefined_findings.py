"""An expression without a value is found before anything is simulated."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from rgss.findings import Severity
from rgss.studies.checks import undefined_findings
from rgss.studies.project import load_project

REPOSITORY = Path(__file__).parents[3]
FILE = "requirements/measures.yaml"
FORCE = "\n    expression: N_f * f_f\n"
TIME = "\n    expression: t_gc + sum(L / v_m)\n"


@pytest.fixture
def folder(tmp_path):
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    return tmp_path


@pytest.fixture
def found(folder):
    """Findings after an expression of the reference measures was replaced, and the line of the new one."""

    def find(old, new):
        text = (folder / FILE).read_text(encoding="utf-8")
        assert text.count(old) >= 1
        changed = text.replace(old, f"\n    expression: {new}\n", 1)
        (folder / FILE).write_text(changed, encoding="utf-8")
        line = next(number for number, one in enumerate(changed.splitlines(), start=1) if one.strip().endswith(new))
        return list(undefined_findings(load_project(folder))), line

    return find


def test_every_shipped_measure_is_defined():
    for study in ("pick_place", "lite6_cubes", "yumi_widget"):
        assert list(undefined_findings(load_project(REPOSITORY, study))) == []


@pytest.mark.parametrize(
    ("expression", "which"),
    [
        ("f_f / (k_s - k_s)", "any design"),
        ("f_f * sqrt(2 - N_f)", "36 of 72 designs (1, 2, 3, 4 …)"),
    ],
)
def test_a_measure_of_the_design_must_be_defined_for_every_design(found, expression, which):
    (finding,), line = found(FORCE, expression)
    assert (finding.rule, finding.severity, finding.line) == ("measures.undefined", Severity.ERROR, line)
    # Measures that depend on it are not reported as well.
    assert finding.message == f"measure 'F_max' is not defined for {which}: {expression}"
    assert finding.hint == "look for a division by zero or the root of a negative number"


@pytest.mark.parametrize(
    "expression", ["sum(L) / (v_m - v_m)", "sum(L / v_m) * sqrt(-k_s)", "t_gc * (k_s - k_s) ** -1 + sum(L / v_m)"]
)
def test_a_measure_of_trials_that_no_trial_can_give_a_value_is_found(found, expression):
    findings, line = found(TIME, expression)
    assert [(one.rule, one.line) for one in findings] == [("measures.undefined", line)]
    assert findings[0].message == f"measure 't_m' is not defined for any design: {expression}"


def test_a_measure_of_trials_may_be_undefined_for_some_designs(found):
    assert found(TIME, "sum(L / v_m) * sqrt(2 - N_f)")[0] == []
