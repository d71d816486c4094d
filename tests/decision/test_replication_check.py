"""Decisions that the replicates cannot support are found by the check, before anything is simulated."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.decision import replicate_until_decided, replication_findings
from rgss.errors import TradeoffError
from rgss.findings import Severity
from rgss.studies.project import load_project
from rgss.tradeoff.sequential import SequentialRule

REPOSITORY = Path(__file__).parents[2]
STUDY = "studies/pick_place.yaml"
SYSTEM = "requirements/system/1-manipulator.yaml"
BUDGET, NONE = "until_decided: {budget: 600}\n", "until_decided: {margin: 0.02}\n"
FIXED_NUMBER = "or run a fixed number of replicates"


@pytest.fixture
def found(folder, edit):
    """The findings of a study with something in its trade-off and a section of its own."""

    def find(in_trade_off, section):
        edit(STUDY, "trade_off:\n", f"{section}trade_off:\n{in_trade_off}")
        return list(replication_findings(load_project(folder)))

    return find


@pytest.mark.parametrize(("section", "severity"), [(BUDGET, Severity.ERROR), (NONE, Severity.WARNING)])
@pytest.mark.parametrize(
    ("in_trade_off", "message"),
    [
        ("  feasible_by: verdicts\n", "cannot judge SYS-005 by an end of t_e_simulated's interval"),
        (
            "  chance:\n    - {requirement: SYS-005, probability: 60 %}\n",
            "does not support demands on replicates, such as chance:SYS-005",
        ),
        ("  decide_by: {program: tchebycheff}\n", "does not support the tchebycheff program"),
    ],
)
def test_a_trade_off_without_a_sequential_rule(found, in_trade_off, message, section, severity):
    (finding,) = found(in_trade_off, section)

    assert (finding.rule, finding.severity) == ("study.until-decided", severity)
    assert finding.message == f"replication until decided {message}"
    assert finding.hint.endswith(FIXED_NUMBER)
    assert finding.line


def test_it_is_refused_before_any_trial_is_run(folder, edit):
    edit(STUDY, "trade_off:\n", "trade_off:\n  feasible_by: verdicts\n")
    with pytest.raises(TradeoffError, match="cannot judge SYS-005 by an end of t_e_simulated's interval"):
        replicate_until_decided(load_project(folder), None, pytest.fail, rule=SequentialRule())


@pytest.mark.parametrize(("probability", "needed"), [("60 %", 3), ("75 %", 4), ("90 %", 10)])
def test_more_replicates_are_demanded_than_there_are(found, probability, needed):
    # The study has three: with 60 % one of them may fail.
    findings = found(f"  chance:\n    - {{requirement: SYS-005, probability: {probability}}}\n", "")

    assert [finding.message for finding in findings] == (
        [f"chance:SYS-005 needs {needed} replicates, the study has 3"] if needed > 3 else []
    )
    for finding in findings:
        assert (finding.rule, finding.severity) == ("study.replicates", Severity.ERROR)
        assert finding.hint.startswith(f"write 'replicates: {needed}', or ask for less: P[t_e_simulated <= 25 s] >= ")


@pytest.mark.parametrize("study", ["pick_place", "lite6_cubes", "yumi_widget"])
def test_shipped_studies_have_none(study):
    assert list(replication_findings(load_project(REPOSITORY, study))) == []


def test_a_strict_comparison_is_another_finding(folder, edit):
    edit(STUDY, "trade_off:\n", f"{BUDGET}trade_off:\n  chance:\n    - {{requirement: SYS-005, probability: 60 %}}\n")
    edit(SYSTEM, 'comparison: "<=", threshold: "25 s"', 'comparison: "<", threshold: "25 s"')
    assert list(replication_findings(load_project(folder))) == []
