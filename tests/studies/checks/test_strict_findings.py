"""A strict comparison, which no trade-off can hold, is found before anything is simulated."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from rgss.findings import Severity
from rgss.studies.checks import strict_findings
from rgss.studies.project import load_project

REPOSITORY = Path(__file__).parents[3]
FILE = "requirements/lite6/system.yaml"


@pytest.fixture
def folder(tmp_path):
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    return tmp_path


def test_no_shipped_requirement_is_strict(folder):
    for study in ("pick_place", "lite6_cubes", "yumi_widget"):
        assert list(strict_findings(load_project(folder, study))) == []


@pytest.mark.parametrize(("old", "new"), [('">="', '">"'), ('"<="', '"<"')])
def test_a_strict_comparison_is_found_at_its_place(folder, old, new):
    text = (folder / FILE).read_text(encoding="utf-8")
    line = next(number for number, one in enumerate(text.splitlines(), start=1) if old in one)
    (folder / FILE).write_text(text.replace(old, new, 1), encoding="utf-8")

    (finding,) = strict_findings(load_project(folder, "lite6_cubes"))
    assert (finding.rule, finding.severity, finding.line) == ("study.strict-comparison", Severity.WARNING, line)
    assert new.strip('"') in finding.message
    assert finding.hint == "write >= or <="
