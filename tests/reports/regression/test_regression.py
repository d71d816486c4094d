"""A guard's report for people and for programs: every text shows as text."""

from __future__ import annotations

import json
from dataclasses import replace
from xml.etree import ElementTree as ET

import pytest

from rgss.regression.comparing import Comparison, Guard, Outcome, Subject
from rgss.regression.input_changes import InputChange, InputKind
from rgss.regression.power import Power
from rgss.regression.report import Behaviour, ChangedTrial, Failing, FailureCause, RegressionReport
from rgss.reports.regression.files import report_to_json, report_to_junit, report_to_markdown
from rgss.reports.regression.terminal import report_lines

INPUTS = (
    InputChange(kind=InputKind.VALUE, name="workpiece.friction", then="1.0", now="0.98", where="contact 3"),
    InputChange(kind=InputKind.ENGINE, name="ompl", then="1.6.0", now="1.7.0"),
    InputChange(kind=InputKind.CONSTANT, name="rgss.physics.world._ARM_POSITION_GAIN", then="0.4", now="0.1"),
    InputChange(kind=InputKind.CODE, name="rgss.physics.world"),
    InputChange(kind=InputKind.FILE, name="scenes/a.yaml"),
)
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
        behaviour=Behaviour(compared=8, changed=(ChangedTrial(run="contact", variant=3, seed=1, phase="grasp"),)),
        failing=(Failing(trouble=FailureCause.UNSTABLE, text="decision: variant 3 was chosen, now no variant"),),
        notes=("decision: variant 3 left the Pareto front; within the noise",),
        looks=2,
        trials={"contact": 4},
        error_rate=0.05,
        inputs=INPUTS,
        powers={
            Subject(run="contact", metric="slip_m", phase="lift"): Power(
                loss=0.004, probability=0.31, seeds=12, seeds_needed=38, detectable=0.0062
            ),
            Subject(run="contact", metric="slip_m", phase="grasp"): Power(
                loss=0.004, probability=0.91, seeds=12, seeds_needed=9
            ),
            Subject(run="contact", metric="slip_m", phase="trial"): Power(
                loss=0.004, probability=0.95, seeds=12, seeds_needed=8
            ),
        },
    )


def test_one_line_for_each_finding_that_names_metric_and_phase(report):
    assert list(report_lines(report)) == [
        "studies/s.yaml against studies/s.baseline.json: failed",
        "  FAILED        unstable: decision: variant 3 was chosen, now no variant",
        (
            "  CHANGED       behaviour changed: 1 of 8 trials not the same bit for bit; first different phase: grasp "
            "in 1"
        ),
        "  CHANGED       engine changed: ompl 1.6.0 → 1.7.0",
        (
            "  WORSE         slip_m at lift (run contact): 0.001 m → 0.005 m; worse by 0.004 m (0.003 … 0.005); "
            "margin 0.002 m, lower is better; 8 pairs, 4 seeds"
        ),
        "  MISSING       slip_m at place (run contact): 8 trials had a value in the baseline, and none has one now",
        (
            "  INCONCLUSIVE  slip_m of the trial (run contact): 0.001 m → 0.005 m; worse by 0.004 m (0.003 … 0.005); "
            "margin 0.002 m, lower is better; 8 pairs, 4 seeds; 1 trial of the baseline has no value now"
        ),
        (
            "  INCONCLUSIVE  slip_m at move_to_grasp (run contact): neither the baseline's trials nor these have a "
            "value with these seeds"
        ),
        (
            "  BETTER        slip_m at move_to_place (run contact): 0.001 m → 0.005 m; better by 0.004 m "
            "(0.003 … 0.005); margin 0.002 m, lower is better; 8 pairs, 4 seeds"
        ),
        "6 comparisons: 1 worse, 1 missing, 2 inconclusive, 1 better, 1 same; seeds after 2 looks: contact 4",
        "input changed: workpiece.friction 1.0 → 0.98 (contact 3)",
        "constant changed: rgss.physics.world._ARM_POSITION_GAIN 0.4 → 0.1",
        "code changed: rgss.physics.world",
        "file changed: scenes/a.yaml",
        "note: decision: variant 3 left the Pareto front; within the noise",
        (
            "power: slip_m at lift (run contact): a change by 0.004 m, 2 times the margin, is found with a "
            "probability of at least 31 % with up to 12 seeds; 80 % takes 38, or a change by 0.0062 m"
        ),
    ]
    everything = list(report_lines(report, everything=True))
    assert any("bit for bit the same" in line for line in everything)
    assert sum(line.startswith("power: ") for line in everything) == 2


def test_behaviour_in_words(report):
    same = replace(report, behaviour=Behaviour(compared=1, changed=()))
    assert "behaviour unchanged: 1 trial the same bit for bit" in list(report_lines(same))
    other = replace(report, behaviour=replace(report.behaviour, machine="Intel → AMD"), inputs=())
    assert (
        "behaviour not comparable: 1 of 8 trials not the same bit for bit, and nothing is known to have changed but "
        "the machine: Intel → AMD"
    ) in list(report_lines(other))
    assert not any("CHANGED" in line for line in report_lines(other))


@pytest.mark.parametrize(
    ("outcomes", "verdict", "fails"),
    [
        ([Outcome.SAME], "same", False),
        ([Outcome.SAME, Outcome.BETTER], "changed", False),
        ([Outcome.SAME, Outcome.MOVED], "changed", False),
        ([Outcome.BETTER, Outcome.INCONCLUSIVE], "changed", False),
        ([Outcome.INCONCLUSIVE, Outcome.WORSE], "worse", True),
        ([Outcome.WORSE, Outcome.MISSING], "failed", True),
        ([], "same", False),
    ],
)
def test_the_verdict(report, outcomes, verdict, fails):
    quiet = replace(report, failing=(), behaviour=Behaviour(compared=8, changed=()), inputs=())
    found = replace(quiet, comparisons=tuple(compared(outcome) for outcome in outcomes))
    assert (found.verdict, found.fails) == (verdict, fails)
    accepted = replace(found, accepted="A new gripper.")
    assert not accepted.is_unexplained
    assert (accepted.verdict, accepted.fails) == (outcomes[-1].value if verdict == "changed" else verdict, fails)


def test_a_lost_verdict_that_may_be_chance_is_inconclusive(report):
    lost = "variant 3: the verdict on SYS-1 was met and is inconclusive; the seeds neither show nor exclude more"
    quiet = replace(report, failing=(), behaviour=Behaviour(compared=8, changed=()), inputs=(), comparisons=())
    found = replace(quiet, undecided=(lost,), accepted="A new gripper.")
    assert (found.verdict, found.fails, found.is_inconclusive) == ("inconclusive", False, True)
    assert f"  INCONCLUSIVE  {lost}" in list(report_lines(found))
    assert report_to_json(found)["undecided"] == [lost]
    assert f"- ❔ **inconclusive**: {lost}" in report_to_markdown(found).replace("\\", "")
    suite = ET.fromstring(report_to_junit(found))  # noqa: S314 - our own text
    assert suite.get("skipped") == "1"


@pytest.mark.parametrize(
    ("inputs", "changed", "verdict"),
    [
        ((), False, "same"),
        ((), True, "changed"),
        # A value or code that leaves every record as it was is a refactoring.
        (("input", "constant", "code", "file", "machine"), False, "same"),
        # Of an engine no trial but those that are watched is known to be the same.
        (("engine",), False, "changed"),
    ],
)
def test_a_change_needs_a_reason(report, inputs, changed, verdict):
    behaviour = report.behaviour if changed else Behaviour(compared=8, changed=())
    kinds = [one for one in INPUTS if one.kind.value in inputs]
    found = replace(report, failing=(), comparisons=(compared(),), behaviour=behaviour, inputs=tuple(kinds))
    assert (found.verdict, found.fails) == (verdict, False)
    suite = ET.fromstring(report_to_junit(found))  # noqa: S314 - our own text
    assert suite.get("failures") == ("1" if verdict == "changed" else "0")
    remedy = "make it the baseline with 'rgss regress --update --reason TEXT', or accept it once with"
    assert any(remedy in line for line in report_lines(found)) == (verdict == "changed")
    accepted = replace(found, accepted="Another <b>engine</b>.")
    assert accepted.verdict == "same"
    assert "changed behaviour is accepted in this run: Another <b>engine</b>." in list(report_lines(accepted))
    assert ET.fromstring(report_to_junit(accepted)).get("failures") == "0"  # noqa: S314 - our own text
    assert report_to_json(accepted)["accepted"] == "Another <b>engine</b>."
    assert "Another &lt;b&gt;engine&lt;/b&gt;" in report_to_markdown(accepted)


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
        "power": {
            "loss": 0.004,
            "probability": 0.31,
            "seeds": 12,
            "target": 0.8,
            "seeds_needed": 38,
            "detectable": 0.0062,
        },
    }
    assert document["comparisons"][2]["power"] is None
    assert (document["changed"], document["accepted"]) == (True, "")
    assert document["inputs"][0] == {
        "kind": "input",
        "name": "workpiece.friction",
        "then": "1.0",
        "now": "0.98",
        "where": "contact 3",
    }
    assert document["behaviour"]["changed"] == [{"run": "contact", "variant": 3, "seed": 1, "phase": "grasp"}]


def test_as_junit(report):
    suite = ET.fromstring(report_to_junit(report))  # noqa: S314 - our own text
    assert (suite.get("tests"), suite.get("failures"), suite.get("skipped")) == ("8", "5", "2")
    cases = {(case.get("classname"), case.get("name")): case for case in suite.iter("testcase")}
    worse = cases["rgss.regress.contact", "slip_m at lift"].find("failure")
    assert worse.get("message").startswith("worse: 0.001 m → 0.005 m")
    assert cases["rgss.regress.contact", "slip_m of the trial"].find("skipped") is not None
    assert cases["rgss.regress.contact", "slip_m at grasp"].find("failure") is None
    said = cases["rgss.regress", "behaviour"].find("failure").get("message")
    assert said.startswith("changed: behaviour changed: 1 of 8 trials")
    assert "constant changed: rgss.physics.world._ARM_POSITION_GAIN 0.4 → 0.1" in said
    powers = {each.get("name"): each.get("value") for each in suite.find("properties")}
    assert "at least 31 % with up to 12 seeds" in powers["power: slip_m at lift (run contact)"]


def test_a_trial_that_could_not_be_run_is_an_error_in_junit(report):
    text = "run contact: the trial of variant 3 with seed 2 could not be run"
    lost = replace(report, failing=(Failing(trouble=FailureCause.NOT_RUN, text=text),))
    suite = ET.fromstring(report_to_junit(lost))  # noqa: S314 - our own text
    (case,) = [case for case in suite.iter("testcase") if case.find("error") is not None]

    assert (suite.get("errors"), suite.get("failures")) == ("1", "4")
    assert case.find("error").get("message") == f"not run: {text}"
    assert (lost.incomplete, report.incomplete) == (True, False)


def test_as_markdown(report):
    text = report_to_markdown(report)
    assert text.startswith("### Regression guard: failed\n")
    assert "| ❌ worse | slip\\_m | lift | contact | 0.001 m | 0.005 m | 0.001 m → 0.005 m;" in text
    assert "| ✅ same" not in text


def test_hostile_text_shows_as_text(report):
    hostile = replace(
        report, study=HOSTILE, notes=(HOSTILE,), failing=(Failing(trouble=FailureCause.UNSTABLE, text=HOSTILE),)
    )
    suite = ET.fromstring(report_to_junit(hostile))  # noqa: S314 - our own text
    assert any("<img src=x>" in case.get("name") and "𝔘" in case.get("name") for case in suite.iter("testcase"))
    text = report_to_markdown(hostile)
    assert "<img" not in text
    assert "a\\|b &lt;img src=x&gt; \\`c\\` \\*d\\* \\[e\\]\\(f\\)" in text
    assert all(character.isprintable() or character == "\n" for character in text)
    assert all(line.isprintable() for line in report_lines(hostile))
