"""A measure of effectiveness that is made of others is allowed; what a trade-off then counts twice is a warning."""

from __future__ import annotations

import pytest

from rgss.cli.main import main
from rgss.findings import Severity
from rgss.studies import double_counting_findings, load_project
from tests.fixtures.shipped_project import copy_as_shipped

ASSUMPTION = "assumptions:\n  - about: trade_off.values.{}\n    rationale: Time of planning is to count twice.\n"
EFFORT = """\
  - id: effort
    kind: moe
    name: Effort
    definition: Time of a task that is to be done, planning twice.
    unit: s
    expression: t_e + t_p
    better: lower
    traces: [STK-095]
    estimate: {statistic: mean, over: successful}
"""


def change(folder, name, old, new):
    path = folder / name
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, old
    path.write_text(text.replace(old, new), encoding="utf-8")


@pytest.fixture
def folder(tmp_path):
    """The shipped project with one measure of effectiveness that is made of two others."""
    copied = copy_as_shipped(tmp_path / "project")
    change(copied, "requirements/measures.yaml", "  - id: S\n    kind: moe\n", EFFORT + "  - id: S\n    kind: moe\n")
    for name in ("t_p", "t_e"):
        change(
            copied,
            "requirements/measures.yaml",
            f"  - id: {name}\n    kind: moe\n",
            f"  - id: {name}\n    kind: moe\n    contributes_to: [effort]\n",
        )
    return copied


def weigh(folder, measure):
    change(folder, "studies/pick_place.yaml", "{measure: t_e_simulated,", f"{{measure: {measure},")
    # It is of the measure that has no weight then.
    change(folder, "studies/pick_place.yaml", "  - about: trade_off.values.t_e_simulated", "  - about: the time")


def test_the_shipped_studies_count_nothing_twice(tmp_path):
    folder = copy_as_shipped(tmp_path / "project")
    for study in sorted((folder / "studies").glob("*.yaml")):
        assert list(double_counting_findings(load_project(folder, f"studies/{study.name}"))) == []


def test_a_measure_of_measures_without_a_weight_is_allowed(folder, capsys):
    assert list(double_counting_findings(load_project(folder))) == []
    main(["check", "--project", str(folder)])
    said = capsys.readouterr().out
    assert "error" not in said.replace("0 errors", "")
    assert "effort" not in said


@pytest.mark.parametrize("measure", ["effort", "t_e"])
def test_what_counts_by_itself_and_within_another_is_a_warning(folder, measure):
    weigh(folder, measure)
    (finding,) = double_counting_findings(load_project(folder))
    line = (folder / "studies/pick_place.yaml").read_text(encoding="utf-8").split(f"measure: {measure},")[0].count("\n")
    assert (finding.rule, finding.severity) == ("study.double-counting", Severity.WARNING)
    assert finding.message == f"t_p is counted 2 times: by itself and in {measure}"
    assert finding.hint == f"weigh one of them, or give the reason in an assumption about trade_off.values.{measure}"
    assert (finding.file, finding.line) == ("studies/pick_place.yaml", line + 1)


def test_what_counts_within_two_others_is_a_warning(folder):
    weigh(folder, "t_e")
    change(folder, "studies/pick_place.yaml", "{measure: t_p,", "{measure: effort,")
    said = [finding.message for finding in double_counting_findings(load_project(folder))]
    assert said == ["t_e is counted 2 times: by itself and in effort", "t_p is counted 2 times: in t_e and in effort"]


def test_a_stated_assumption_accepts_it(folder):
    weigh(folder, "effort")
    change(folder, "studies/pick_place.yaml", "\nassumptions:\n", "\n" + ASSUMPTION.format("effort"))
    assert list(double_counting_findings(load_project(folder))) == []


def test_an_assumption_on_the_measure_that_counts_by_itself_does_not(folder):
    weigh(folder, "effort")
    change(folder, "studies/pick_place.yaml", "\nassumptions:\n", "\n" + ASSUMPTION.format("t_p"))
    assert len(list(double_counting_findings(load_project(folder)))) == 1
