"""Guarding a study whose trials have other metrics than those of its baseline."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.guard import schema as guard_schema
from rgss.trials import METRICS, Aggregation, MetricDescriptor


@pytest.mark.parametrize("schema", [3, 5])
def test_a_metric_that_trials_newly_have_changes_nothing(compared, monkeypatch, schema):
    new = MetricDescriptor(name="noise_1", unit="1", meaning="noise", trial=Aggregation.GREATEST)

    def with_new(baseline):
        monkeypatch.setattr(guard_schema, "METRICS", {**METRICS, "noise_1": new})
        return baseline if schema == 5 else replace(baseline, schema=3, phase_record={})

    report = compared(baseline_of=with_new, more_metrics={"noise_1": 0.5}, more_of_phases=schema == 5)

    assert (report.verdict, report.failing) == ("same", ())
    assert report.notes == ("trials newly have noise_1, which the baseline does not guard",)
    assert report.behaviour.changed == ()
    assert all(one.identical for one in report.comparisons)


def test_a_metric_of_a_record_that_changes_is_changed_behaviour_whether_guarded_or_not(compared):
    report = compared(more_metrics={"slip_m": 0.5})

    assert (report.verdict, report.failing) == ("changed", ())
    assert {one.phase for one in report.behaviour.changed} == {"trial"}


@pytest.mark.parametrize("value", [3.5, None])
def test_values_that_are_not_those_of_the_same_records_are_an_inconsistent_baseline(compared, value):
    """As after a text merge that took the digests of one baseline and a line of values of another."""

    def merged(baseline):
        run = baseline.runs["planning"]
        rows = run.values["motion_time_s"]["trial"]
        trial = {**rows, "60": (rows["60"][0], value, *rows["60"][2:])}
        values = {**run.values, "motion_time_s": {"trial": trial}}
        return replace(baseline, runs={**baseline.runs, "planning": replace(run, values=values)})

    report = compared(baseline_of=merged)

    assert report.verdict == "failed"
    assert report.behaviour.changed == ()
    (failing,) = report.failing
    assert failing.trouble.value == "inconsistent baseline"
    assert f"run planning: motion_time_s at trial of variant 60 with seed 2 is {value} in the baseline" in failing.text
