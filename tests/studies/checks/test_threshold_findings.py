"""Thresholds beyond the values that a measure can have are found before anything is simulated."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.findings import Severity
from rgss.requirements import Comparison, Statistic
from rgss.studies.checks import threshold_findings
from rgss.studies.project import load_project

REPOSITORY = Path(__file__).parents[3]
TIME = "t_e_simulated"


@pytest.fixture
def folder(tmp_path):
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    return tmp_path


@pytest.fixture
def found(folder):
    """Findings after the criterion on a measure was replaced."""

    def find(measure, comparison, threshold):
        for path in (folder / "requirements/system").glob("*.yaml"):
            text = path.read_text(encoding="utf-8")
            pattern = rf"criterion: {{measure: {measure},.*}}"
            new = f'criterion: {{measure: {measure}, comparison: "{comparison}", threshold: "{threshold}"}}'
            if re.search(pattern, text):
                path.write_text(re.sub(pattern, new, text, count=1), encoding="utf-8")
                return list(threshold_findings(load_project(folder)))
        raise AssertionError(measure)

    return find


def test_every_shipped_threshold_decides(folder):
    for study in ("pick_place", "lite6_cubes", "yumi_widget"):
        assert list(threshold_findings(load_project(folder, study))) == []


@pytest.mark.parametrize(
    ("measure", "comparison", "threshold", "words", "severity"),
    [
        ("S", ">=", "1.2", "S is at most 1: no design can meet it", Severity.ERROR),
        ("S", ">=", "90", "S is at most 1: no design can meet it", Severity.ERROR),
        ("S", "<=", "1.2", "S is at most 1: every design meets it", Severity.WARNING),
        ("S", ">=", "-0.1", "S is at least 0: every design meets it", Severity.WARNING),
        (TIME, "<=", "-20 s", f"{TIME} is at least 0 s: no design can meet it", Severity.ERROR),
        (TIME, "<=", "100 s", f"{TIME} is at most 90 s: every design meets it", Severity.WARNING),
    ],
)
def test_a_threshold_beyond_the_bounds_is_found(found, measure, comparison, threshold, words, severity):
    (finding,) = found(measure, comparison, threshold)
    assert finding.rule == "study.threshold-range"
    assert finding.severity is severity
    assert finding.message.endswith(words)


@pytest.mark.parametrize(
    ("measure", "comparison", "threshold"), [("S", ">=", "100 %"), ("S", ">=", "0"), (TIME, "<=", "90 s")]
)
def test_a_threshold_at_a_bound_is_none(found, measure, comparison, threshold):
    assert found(measure, comparison, threshold) == []


@pytest.mark.parametrize(
    ("one", "other", "is_found"),
    [
        (("value", ">=", 0.5), ("value", "<=", 0.4), True),
        (("value", "<=", 0.4), ("value", ">=", 0.5), True),
        (("value", ">=", 0.4), ("value", "<=", 0.4), False),
        (("value", ">", 0.4), ("value", "<=", 0.4), True),
        (("value", ">=", 0.4), ("value", "<=", 0.5), False),
        (("value", ">=", 0.5), ("value", ">=", 0.4), False),
        # The interval lies about the value: its lower end below, its upper end above.
        (("low", ">=", 0.5), ("value", "<=", 0.4), True),
        (("low", ">=", 0.5), ("high", "<=", 0.4), True),
        (("value", ">=", 0.5), ("high", "<=", 0.4), True),
        (("high", ">=", 0.5), ("value", "<=", 0.4), False),
        (("value", ">=", 0.5), ("low", "<=", 0.4), False),
        (("high", ">=", 0.5), ("low", "<=", 0.4), False),
    ],
)
def test_criteria_that_exclude_each_other_are_found(folder, one, other, is_found):
    project = load_project(folder)
    judged = [item for item in project.requirements.system if item.criterion is not None][:2]
    made = {
        item.id: replace(
            item.criterion,
            measure="S",
            statistic=Statistic(statistic),
            comparison=Comparison(comparison),
            threshold=threshold,
            unit="1",
        )
        for item, (statistic, comparison, threshold) in zip(judged, (one, other), strict=True)
    }
    system = tuple(
        replace(item, criterion=made[item.id]) if item.id in made else item
        for item in project.requirements.system
        if item.id in made or item.criterion is None or item.criterion.measure != "S"
    )
    changed = replace(project, requirements=replace(project.requirements, system=system))
    found = list(threshold_findings(changed))
    assert [finding.rule for finding in found] == ["study.contradiction"] * is_found
    if is_found:
        first, second = (item.id for item in judged)
        assert found[0].message == (
            f"{second} demands {made[second]}, and {first} demands {made[first]}: no design can meet both"
        )
