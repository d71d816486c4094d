"""A guard's report for people and for programs: every text shows as text."""

from __future__ import annotations

import json
from dataclasses import replace
from xml.etree import ElementTree as ET

import pytest

from rgss.regression.comparing import Comparison, Guard, Outcome, Subject
from rgss.regression.report import Behaviour, ChangedTrial, Failing, RegressionReport, Trouble
from rgss.reports.regression_files import report_to_json, report_to_junit, report_to_markdown
from rgss.reports.regression_terminal import report_lines

HOSTILE = "a|b <img src=x> `c` *d* [e](f) \x1b[31m \x00 𝔘"


def compared(outcome=Outcome.SAME, *, phase="lift", metric="slip_m", **other):
    values = {
        "worsening": 0.004,
        "low": 0.003,
        "high": 0.005,
        "baseline_mean": 0.001,
        "current_mean": 0.005,
        "pairs": 8,
        "lost": 0,
        "seeds": 4,
        "look": 1,
        "p_values": {"worse": 0.001, "better": 1.0, "same": 0.9},
    }
    return Comparison(
        subject=Subject(run="contact", metric=metric, phase=phase),
        guard=Guard(unit="m", higher_is_better=False, margin=0.002, is_success=False),
        outcome=outcome,
        **(values | other),
    )


@pytest.fixture
def report():
    return RegressionReport(
        study="studies/s.yaml",
        baseline="studies/s.baseline.json",
        comparisons=(
            compared(Outcome.SAME, phase="grasp", identical=True),
            compared(Outcome.WORSE),
            compared(Outcome.MISSING, phase="place", pairs=0, lost=8, worsening=None, low=None, high=None),
            compared(Outcome.INCONCLUSIVE, phase="trial", lost=1),
            compared(Outcome.BETTER, phase="move_to_place", worsening=-0.004, low=-0.005, high=-0.003),
            compared(Outcome.INCONCLUSIVE, phase="move_to_grasp", pairs=0, worsening=None, low=None, high=None),
        ),
        behaviour=Behaviour(
            compared=8, changed=(ChangedTrial(run="contact", variant=3, seed=1, phase="grasp"),), platform=""
        ),
        failing=(Failing(trouble=Trouble.UNSTABLE, text="decision: variant 3 was chosen, now no variant"),),
        notes=("inputs changed since the baseline: scenes/a.yaml",),
        looks=2,
        trials={"contact": 4},
        error_rate=0.05,
    )


def test_one_line_for_each_finding_that_names_metric_and_phase(report):
    assert list(report_lines(report)) == [
        "studies/s.yaml against studies/s.baseline.json: failed",
        "  FAILED        unstable: decision: variant 3 was chosen, now no variant",
        (
            "  WORSE         slip_m at lift (run contact): 0.001 m → 0.005 m; worse by 0.004 m (0.003 … 0.005); "
            "margin 0.002 m; 8 pairs, 4 seeds"
        ),
        "  MISSING       slip_m at place (run contact): 8 trials had a value in the baseline, and none has one now",
        (
            "  INCONCLUSIVE  slip_m of the trial (run contact): 0.001 m → 0.005 m; worse by 0.004 m (0.003 … 0.005); "
            "margin 0.002 m; 8 pairs, 4 seeds; 1 trial of the baseline has no value now"
        ),
        (
            "  INCONCLUSIVE  slip_m at move_to_grasp (run contact): neither the baseline's trials nor these have a "
            "value with these seeds"
        ),
        (
            "  BETTER        slip_m at move_to_place (run contact): 0.001 m → 0.005 m; better by 0.004 m "
            "(0.003 … 0.005); margin 0.002 m; 8 pairs, 4 seeds"
        ),
        "6 comparisons: 1 worse, 1 missing, 2 inconclusive, 1 better, 1 same; seeds after 2 looks: contact 4",
        "behaviour changed: 1 of 8 trials not the same bit for bit; first different phase: grasp in 1",
        "note: inputs changed since the baseline: scenes/a.yaml",
    ]
    assert any("bit for bit the same" in line for line in report_lines(report, everything=True))


def test_behaviour_in_words(report):
    same = replace(report, behaviour=Behaviour(compared=1, changed=()))
    assert "behaviour unchanged: 1 trial the same bit for bit" in list(report_lines(same))
    other = replace(report, behaviour=Behaviour(compared=0, changed=(), platform="another machine"))
    assert "behaviour not compared: another machine" in list(report_lines(other))


@pytest.mark.parametrize(
    ("outcomes", "verdict", "fails"),
    [
        ([Outcome.SAME], "same", False),
        ([Outcome.SAME, Outcome.BETTER], "better", False),
        ([Outcome.BETTER, Outcome.INCONCLUSIVE], "inconclusive", False),
        ([Outcome.INCONCLUSIVE, Outcome.WORSE], "worse", True),
        ([Outcome.WORSE, Outcome.MISSING], "failed", True),
        ([], "same", False),
    ],
)
def test_the_verdict(report, outcomes, verdict, fails):
    found = replace(report, failing=(), comparisons=tuple(compared(outcome) for outcome in outcomes))
    assert (found.verdict, found.fails) == (verdict, fails)


def test_as_json(report):
    document = json.loads(json.dumps(report_to_json(report), allow_nan=False))
    assert document["fails"] is True
    assert document["comparisons"][1] == {
        "run": "contact",
        "metric": "slip_m",
        "phase": "lift",
        "verdict": "worse",
        "unit": "m",
        "better": "lower",
        "margin": 0.002,
        "baseline": 0.001,
        "now": 0.005,
        "worse_by": 0.004,
        "low": 0.003,
        "high": 0.005,
        "pairs": 8,
        "lost": 0,
        "seeds": 4,
        "look": 1,
        "identical": False,
        "p_values": {"worse": 0.001, "better": 1.0, "same": 0.9},
    }
    assert document["behaviour"]["changed"] == [{"run": "contact", "variant": 3, "seed": 1, "phase": "grasp"}]


def test_as_junit(report):
    suite = ET.fromstring(report_to_junit(report))  # noqa: S314 - our own text
    assert (suite.get("tests"), suite.get("failures"), suite.get("skipped")) == ("8", "3", "2")
    cases = {(case.get("classname"), case.get("name")): case for case in suite}
    worse = cases["rgss.regress.contact", "slip_m at lift"].find("failure")
    assert worse.get("message").startswith("worse: 0.001 m → 0.005 m")
    assert cases["rgss.regress.contact", "slip_m of the trial"].find("skipped") is not None
    assert cases["rgss.regress.contact", "slip_m at grasp"].find("failure") is None
    assert "behaviour changed" in cases["rgss.regress", "behaviour"].find("system-out").text


def test_a_trial_that_could_not_be_run_is_an_error_in_junit(report):
    text = "run contact: the trial of variant 3 with seed 2 could not be run"
    lost = replace(report, failing=(Failing(trouble=Trouble.NOT_RUN, text=text),))
    suite = ET.fromstring(report_to_junit(lost))  # noqa: S314 - our own text
    (case,) = [case for case in suite if case.find("error") is not None]

    assert (suite.get("errors"), suite.get("failures")) == ("1", "2")
    assert case.find("error").get("message") == f"not run: {text}"
    assert (lost.incomplete, report.incomplete) == (True, False)


def test_as_markdown(report):
    text = report_to_markdown(report)
    assert text.startswith("### Regression guard: failed\n")
    assert "| ❌ worse | slip\\_m | lift | contact | 0.001 m | 0.005 m | 0.001 m → 0.005 m;" in text
    assert "| ✅ same" not in text


def test_hostile_text_shows_as_text(report):
    hostile = replace(
        report, study=HOSTILE, notes=(HOSTILE,), failing=(Failing(trouble=Trouble.UNSTABLE, text=HOSTILE),)
    )
    suite = ET.fromstring(report_to_junit(hostile))  # noqa: S314 - our own text
    assert any("<img src=x>" in case.get("name") and "𝔘" in case.get("name") for case in suite)
    text = report_to_markdown(hostile)
    assert "<img" not in text
    assert "a\\|b &lt;img src=x&gt; \\`c\\` \\*d\\* \\[e\\]\\(f\\)" in text
    assert all(character.isprintable() or character == "\n" for character in text)
    assert all(line.isprintable() for line in report_lines(hostile))
