"""The section ``regression`` of a study: each finding at its place."""

from __future__ import annotations

import re

import pytest

from rgss.errors import DocumentError
from rgss.evidence import Fidelity
from rgss.guard.designs import guard_findings
from rgss.guard.runs import watched_trials
from rgss.regression.comparing import Guard
from rgss.studies.project import load_project
from rgss.studies.study import read_study

STUDY = "studies/pick_place.yaml"
SECTION = """\
regression:
  error_rate: 4 %
  runs:
    - {id: planning, fidelity: kinematic, variants: "57,60", replicates: 8, batch: 3, cap: 16}
    - {id: contact, fidelity: contact, variants: d8=RRT, replicates: 4}
  decision: contact
  metrics:
    - {metric: success, better: higher, margin: 2 percent}
    - {metric: planning_time_s, runs: [planning], phases: all, better: lower, margin: 0.2 s}
    - {metric: slip_m, runs: [contact], phases: [lift, place], better: lower, margin: 120 mm}
"""

FINDINGS = [
    (
        "error_rate: 4 %",
        "error_rate: 50 %",
        "2:15: error: error rate must be between 0 and 0.5, got 0.5 (give a share between 0 and 0.5",
    ),
    ("error_rate: 4 %", "error_rate: 0", "2:15: error: error rate must be between 0 and 0.5, got 0"),
    ("id: contact,", "id: planning,", "5:12: error: there are two runs 'planning' (give each its own name)"),
    ("cap: 16", "cap: 7", "4:92: error: the cap of 7 seeds is below the 8 of the first look (raise it, or omit it"),
    ("replicates: 4", "replicates: 1", "5:70: error: replicates: input should be greater than or equal to 2"),
    ("decision: contact", "decision: other", "6:13: error: unknown run 'other' (runs: planning, contact)"),
    ("runs: [planning]", "runs: [other]", "9:40: error: unknown run 'other' (runs: planning, contact)"),
    ("[lift, place]", "[lift, fly]", "10:56: error: unknown phase 'fly' (phases: move_to_grasp, grasp, lift,"),
    ("metric: slip_m", "metric: slip", "10:16: error: no phase observes a metric 'slip' (did you mean 'slip_m'?)"),
    ("metric: success", "metric: sucess", "8:16: error: no trial observes a metric 'sucess' (did you mean 'success'?)"),
    ("metric: success", "metric: zzz", "8:16: error: no trial observes a metric 'zzz' (such as success, duration_s"),
    (
        "metric: success",
        "metric: path_length_m",
        "8:16: error: path_length_m is a row of numbers, one per planned move (write 'phases: all')",
    ),
    (
        "metric: success",
        "metric: joint_saturated_s",
        "8:16: error: joint_saturated_s is a row of numbers, one per joint of the arm (guard one",
    ),
    ("margin: 0.2 s", "margin: 0.2 m", "9:87: error: unit 'm' does not measure what 's' measures (give it in s"),
    ("margin: 0.2 s", "margin: 0.2", "9:87: error: '0.2' has no unit"),
    (
        "margin: 0.2 s",
        "margin: 0 s",
        "9:87: error: a margin of '0 s' can never be kept for certain (say how much worse",
    ),
    ("margin: 2 percent", "margin: 1", "8:49: error: a margin of '1' lets every trial fail (give a share below 1"),
    (
        "metric: slip_m, runs: [contact]",
        "metric: planning_time_s, runs: [planning]",
        "10:16: error: planning_time_s is g",
    ),
    ("[lift, place]", "[lift, place, lift]", "10:63: error: lift is named twice (keep one)"),
    ("[lift, place]", "[]", "10:49: error: phases: at least 1 entry is expected"),
    ("runs: [planning]", "runs: []", "9:39: error: runs: at least 1 entry is expected"),
    ("better: higher", "better: lower", "8:33: error: of success, lower is not better (write 'better: higher')"),
    ("margin: 0.2 s", "margin: 20 %", "9:87: error: a margin of '20 %' needs 'at_least' (add the least margin in its"),
    (
        "margin: 0.2 s",
        "margin: 0.2 s, at_least: 0.1 s",
        "9:104: error: at_least belongs to a margin in per cent (omit it, or give the margin",
    ),
    (
        "margin: 0.2 s",
        "margin: 20 %, at_least: 0 s",
        "9:103: error: a margin of '0 s' can never be kept for certain",
    ),
    ("margin: 0.2 s", "margin: 0 %, at_least: 1 s", "9:87: error: a margin of '0 %' can never be kept for certain"),
    ("margin: 0.2 s", "margin: 20 %, at_least: 1 m", "9:103: error: unit 'm' does not measure what 's' measures"),
    ("better: higher", "better: more", "8:33: error: better: 'more' is not one of 'higher', 'lower' or 'neither'"),
]


@pytest.fixture(scope="module")
def read(shipped, tmp_path_factory):
    text = (shipped.folder / STUDY).read_text(encoding="utf-8")
    rest = re.sub(r"(?ms)^regression:\n.*?(?=^\S|\Z)", "", text)
    path = tmp_path_factory.mktemp("study") / "study.yaml"

    def make(section):
        path.write_text(section + rest, encoding="utf-8")
        return read_study(path, shipped.measures, project=shipped.folder, label="s", requirements=shipped.requirements)

    return make


def test_what_it_says(read):
    guard = read(SECTION).regression
    assert guard.error_rate == 0.04
    planning, contact = guard.runs
    assert (planning.fidelity, planning.variants, planning.looks) == (Fidelity.KINEMATIC, "57,60", 4)
    assert [planning.seeds_at(look) for look in range(1, 6)] == [8, 11, 14, 16, 16]
    assert (contact.batch, contact.cap, contact.looks) == (4, 4, 1)
    assert guard.decision == "contact"
    success, planning_time, slip = guard.metrics
    assert success.guard == Guard(unit="1", higher_is_better=True, margin=0.02, is_success=True)
    assert (success.runs, success.phases, success.wherever) == (("planning", "contact"), ("trial",), False)
    assert planning_time.guard.margin == 0.2
    assert (len(planning_time.phases), planning_time.wherever) == (8, True)
    assert slip.guard == Guard(unit="m", higher_is_better=False, margin=0.12, is_success=False)
    assert (slip.phases, slip.wherever) == (("lift", "place"), False)


def test_a_margin_in_per_cent_and_a_metric_without_a_better_direction(read):
    old = "better: lower, margin: 0.2 s"
    guard = read(SECTION.replace(old, "better: neither, margin: 15 percent, at_least: 30 ms")).regression
    assert guard.metrics[1].guard == Guard(
        unit="s", higher_is_better=False, margin=0.03, is_success=False, both_ways=True, relative=0.15
    )


def test_it_may_be_left_out(read):
    assert read("").regression is None


@pytest.mark.parametrize(("old", "new", "said"), FINDINGS)
def test_a_finding_at_its_place(read, old, new, said):
    assert old in SECTION
    with pytest.raises(DocumentError) as caught:
        read(SECTION.replace(old, new, 1))
    assert any(str(finding).startswith(f"s:{said}") for finding in caught.value.findings), [
        str(finding) for finding in caught.value.findings
    ]


def test_the_shipped_study_guards_itself(shipped):
    guard = shipped.study.regression
    assert {run.fidelity for run in guard.runs} == {Fidelity.KINEMATIC, Fidelity.CONTACT}
    assert any(metric.metric == "success" and metric.wherever for metric in guard.metrics)
    guarded = {metric.metric: metric.guard.direction for metric in guard.metrics}
    assert guarded["peak_tool_speed_m_s"] == "neither"
    assert guarded.keys() >= {"tracking_error_m", "motion_time_s", "planning_time_s", "peak_joint_torque_ratio"}


@pytest.mark.parametrize(
    ("variants", "said"),
    [
        ('"999"', "variants of run planning: unknown variant 999 (ids go from 1 to 72)"),
        ('"fingers=four"', "variants of run planning: "),
        ('"57,,60"', "variants of run planning: "),
        ('"d1 > 3 kg"', "variants of run planning: "),
        ('"nonsense"', "variants of run planning: "),
    ],
)
def test_variants_that_are_none_are_told_where_they_stand(folder, variants, said):
    path = folder / STUDY
    text = re.sub(r"(?ms)^regression:\n.*?(?=^\S|\Z)", "", path.read_text(encoding="utf-8"))
    path.write_text(text + SECTION.replace('"57,60"', variants), encoding="utf-8")
    line = (
        path.read_text(encoding="utf-8")
        .splitlines()
        .index(f"    - {{id: planning, fidelity: kinematic, variants: {variants}, replicates: 8, batch: 3, cap: 16}}")
    )
    project = load_project(folder)
    (finding,) = guard_findings(project)
    assert str(finding).startswith(f"{STUDY}:{line + 1}:53: error: {said}"), str(finding)
    assert finding.hint
    with pytest.raises(DocumentError) as caught:
        watched_trials(project, project.study.regression)
    assert caught.value.findings == (finding,)


def test_the_shipped_study_guards_designs_that_are_there(shipped):
    assert guard_findings(shipped) == ()
