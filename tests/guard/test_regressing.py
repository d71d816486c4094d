"""Guarding a study against its baseline: with made records, and with regressions planted in real trials."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import pytest

from rgss.errors import DefinitionError, DocumentError, EvidenceError
from rgss.evidence import PieceKind, Provenance
from rgss.guard import baseline_name, compare_with_baseline, make_baseline
from rgss.guard.inputs import constants_of, origin_of_trials
from rgss.guard.runs import guard_of, watched_trials
from rgss.regression.baseline import baseline_to_text
from rgss.regression.comparing import Outcome
from rgss.regression.input_changes import InputKind, origin_changes
from rgss.regression.report import FailureCause
from rgss.studies.project import load_project
from rgss.sweep.running import sweep
from rgss.sweep.trial_keys import trials_of
from rgss.trials.hands.finger_hand import FingerHand
from tests.fixtures.shipped_project import STUDY

from .conftest import REASON, SECTION, without_section


def plans_of(store, project):
    """The plans and timings of the watched trials, for another store."""
    specs = [spec for trials in watched_trials(project, guard_of(project)) for spec in trials.specs(trials.run.cap)]
    digests = {trial.pieces[kind] for trial in trials_of(specs) for kind in (PieceKind.PLAN, PieceKind.TIMING)}
    return [piece for digest in sorted(digests) if (piece := store.piece(digest)) is not None]


def troubles(report):
    return [f"{one.trouble.value}: {one.text}" for one in report.failing]


def named(report, *outcomes):
    return {str(one.subject) for one in report.of(*outcomes)}


def test_nothing_changed(compared):
    looks = []
    report = compared(on_look=lambda *seen: looks.append(seen))
    assert (report.verdict, report.fails, report.failing, report.notes) == ("same", False, (), ())
    assert report.inputs == ()
    assert looks == [(1, 0)]
    assert report.trials == {"planning": 4, "grasp": 4}
    assert (report.behaviour.compared, report.behaviour.changed) == (12, ())
    assert all(one.identical for one in report.comparisons)


def test_a_baseline_is_the_same_text_again(project_of, stores, runner):
    project = project_of()
    texts = []
    for _ in range(2):
        store = stores()
        texts.append(baseline_to_text(make_baseline(project, store, runner(store), before=None, reason=REASON)))
    assert texts[0] == texts[1]


def test_reasons_are_kept(project_of, stores, runner):
    project, store = project_of(), stores()
    first = make_baseline(project, store, runner(store), before=None, reason=" First\n baseline. ")
    second = make_baseline(project, store, runner(store), before=first, reason="Another engine.")
    assert [change.reason for change in second.history] == [REASON, "Another engine."]
    assert first.runs["planning"].seeds == tuple(range(1, 13))
    assert first.runs["grasp"].variants == (57,)


def test_a_slower_planner(compared):
    report = compared(slower_s=1.0)
    assert report.verdict == "worse"
    assert "planning_time_s at move_to_grasp" in named(report, Outcome.WORSE)
    assert len(named(report, Outcome.WORSE)) == 5
    assert named(report, Outcome.WORSE) == {
        f"planning_time_s at {one.subject.phase}" for one in report.of(Outcome.WORSE)
    }
    assert {one.phase for one in report.behaviour.changed} == {"move_to_grasp"}


def test_more_seeds_where_it_is_inconclusive(compared):
    report = compared(fails=lambda spec: spec.fidelity.value == "contact")
    assert report.trials == {"planning": 4, "grasp": 12}
    assert report.looks == 2
    # Phases after the one that fails are not reached, and it is the one that is worse.
    worse = {one for one in named(report, Outcome.WORSE) if one.startswith("success")}
    assert worse == {"success of the trial", "success at move_to_grasp_departure"}
    assert "success at place" in named(report, Outcome.MISSING)
    assert any(text.startswith("unstable: decision: variant 57 was chosen, now") for text in troubles(report))


def test_a_trial_that_could_not_be_run(compared):
    report = compared(lost=lambda spec: spec.seed == 2 and spec.fidelity.value == "contact")
    assert report.fails
    assert [one for one in troubles(report) if one.startswith("not run")] == [
        "not run: run grasp: the trial of variant 57 with seed 2 could not be run",
        "not run: decision: trials that it needs could not be run",
    ]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("cap: 12", "cap: 8", "fewer replicates: run planning takes up to 8 seeds; the baseline has 12"),
        (
            "replicates: 4, batch: 4, cap: 12",
            "replicates: 3, batch: 4, cap: 12",
            "fewer replicates: run planning takes 3 seeds at the first look; the baseline took 4",
        ),
        ('"57,60"', '"57"', "fewer replicates: run planning no longer tries variant 60"),
        (
            "    - {metric: motion_time_s, better: lower, margin: 0.5 s}\n",
            "",
            "missing metric: the baseline guards motion_time_s, the study no longer does",
        ),
        (
            "{metric: motion_time_s, b",
            "{metric: motion_time_s, runs: [planning], b",
            "missing metric: run grasp: the baseline guards motion_time_s at trial, the study no longer does",
        ),
        ("motion_time_s", "task_time_s", "changed schema: the study guards task_time_s, the baseline does not"),
        (
            "planning_time_s, runs: [planning], phases: all",
            "planning_time_s, phases: [grasp, lift]",
            "changed schema: run grasp: the study guards planning_time_s at grasp, the baseline does not",
        ),
        ("id: grasp", "id: hold", "fewer replicates: run grasp of the baseline is not in the study"),
        (
            "decision: grasp\n",
            "decision: planning\n",
            "changed schema: the guarded decision was that of run grasp and is that of run planning",
        ),
        (
            "  decision: grasp\n",
            "",
            "changed schema: the guarded decision was that of run grasp and is that of run none",
        ),
    ],
)
def test_a_study_that_guards_less_or_other_things(compared, old, new, said):
    section = SECTION.replace(old, new, 1)
    if new == "id: hold":
        section = section.replace("decision: grasp", "decision: hold")
    report = compared(section)
    assert report.fails
    assert said in troubles(report)


def test_on_another_machine_the_same_records_are_the_same(compared):
    report = compared(baseline_of=lambda one: replace(one, origin=replace(one.origin, machine="Other")))
    assert (report.verdict, report.behaviour.compared, report.behaviour.machine[:8]) == ("same", 12, "Other → ")
    assert all(one.identical for one in report.comparisons)


def test_another_version_of_an_engine_needs_a_reason(compared):
    def other(baseline):
        engines = {**baseline.origin.engines, "ompl": "0", "numerics.libm": "x"}
        return replace(baseline, origin=replace(baseline.origin, engines=engines))

    report = compared(baseline_of=other)
    installed = report.inputs[-1].now
    assert [str(one) for one in report.inputs] == [
        "engine changed: numerics.libm x → –",
        f"engine changed: ompl 0 → {installed}",
    ]
    assert (report.verdict, report.fails, report.is_unexplained) == ("changed", False, True)
    accepted = compared(baseline_of=other, accepted="Bug fixes in OMPL.")
    assert (accepted.verdict, accepted.is_unexplained) == ("same", False)


@pytest.mark.parametrize(
    ("then", "now", "changed"),
    [
        ("openblas Haswell 0123abcd", "openblas Zen 0123abcd", False),
        ("openblas Haswell 0123abcd", "openblas Haswell 0123abce", True),
        ("a 0123abcd | b 0123abcd", "c 0123abcd", False),
        ("a 0123abcd | b 4567abcd", "c 0123abcd", True),
        ("1.2.3", "1.2.4", True),
        ("12345678", "12345679", True),
    ],
)
def test_of_numerics_the_results_count_and_not_their_names(project_of, then, now, changed):
    origin = origin_of_trials(project_of(), [])
    before, after = (replace(origin, engines={"numerics.blas": text}) for text in (then, now))
    found = [one for one in origin_changes(before, after, with_values=True) if one.kind is InputKind.ENGINE]
    assert bool(found) == changed


def test_what_an_earlier_baseline_did_not_record_cannot_have_changed(project_of):
    origin = origin_of_trials(project_of(), [])
    later = replace(origin, engines={**origin.engines, "numerics.blas": "x 0123abcd"})
    assert list(origin_changes(origin, later, with_values=False)) == []
    assert [str(one) for one in origin_changes(origin, later, with_values=True)] == [
        "engine changed: numerics.blas – → x 0123abcd"
    ]


def test_whatever_a_provenance_names_is_compared(project_of):
    """A field that provenance gets later is guarded without a line here."""

    @dataclass(frozen=True, kw_only=True)
    class Richer(Provenance):
        numerics: Mapping[str, str] = field(default_factory=dict)
        kernel: str = ""

    here = Richer(
        inputs={}, versions={"ompl": "9", "rgss-plan": "d"}, numerics={"blas": "Haswell"}, kernel="k", study="s.yaml"
    )
    there = replace(here, numerics={"blas": "Zen"}, machine="M")
    origin = origin_of_trials(project_of(), [here, there])
    assert (origin.engines["numerics.blas"], origin.engines["kernel"]) == ("Haswell | Zen", "k")
    assert (origin.engines["ompl"], origin.machine) == ("9", "M")
    # The study is that of the baseline by its file, not an engine.
    assert {"rgss-plan", "study"}.isdisjoint(origin.engines)


def test_what_changed_is_named(compared):
    report = compared(
        baseline_of=lambda one: replace(
            one,
            origin=replace(
                one.origin,
                modules={**one.origin.modules, "rgss.trials.gone": "x"},
                inputs={**one.origin.inputs, "a": "b"},
            ),
            inputs={**one.inputs, "settings.control.settled_s": "0.2"},
        )
    )
    assert [str(one) for one in report.inputs] == [
        "input changed: settings.control.settled_s 0.2 → 0.1",
        "code changed: rgss.trials.gone",
        "file changed: a",
    ]
    assert (report.verdict, report.notes) == ("same", ())


def test_a_value_that_not_all_trials_have_is_named_with_those_that_have_it(compared):
    def other(baseline):
        run = baseline.runs["planning"]
        inputs = {**run.inputs, "60": {**run.inputs["60"], "planner": "'RRT'"}}
        return replace(baseline, runs={**baseline.runs, "planning": replace(run, inputs=inputs)})

    report = compared(baseline_of=other)
    assert [str(one) for one in report.inputs] == ["input changed: planner 'RRT' → 'TRRT' (planning 60)"]


def test_of_a_baseline_without_values_files_and_pieces_are_named(compared):
    def earlier(baseline):
        origin = replace(
            baseline.origin,
            code={**baseline.origin.code, "plan": "x"},
            inputs={**baseline.origin.inputs, "a": "b"},
            modules={},
            constants={},
        )
        runs = {name: replace(run, inputs={}) for name, run in baseline.runs.items()}
        return replace(baseline, origin=origin, runs=runs, inputs={}, schema=2)

    report = compared(baseline_of=earlier)
    assert [str(one) for one in report.inputs] == ["code changed: what makes plan", "file changed: a"]
    assert report.verdict == "same"
    (note,) = report.notes
    assert note.startswith("the baseline was written by an earlier rgss and lacks the values of inputs")


def test_constants_of_the_code_by_name(tmp_path, monkeypatch):
    (tmp_path / "gains.py").write_text(
        "A = 1\n_B = -2.5e-3\nC: float = 2 * 3\nD = (1, 2.0)\nE = 'x'\nF = len('x')\nG = ()\nH = A\n"
        "class K:\n    i: float = 0.5\n    j: str = 'y'\n",
        encoding="utf-8",
    )
    monkeypatch.syspath_prepend(tmp_path)
    assert constants_of(["gains", "no_such_module"]) == {
        "gains.A": "1",
        "gains._B": "-0.0025",
        "gains.C": "2 * 3",
        "gains.D": "(1, 2.0)",
        "gains.K.i": "0.5",
    }


def test_a_baseline_of_another_study(compared):
    with pytest.raises(DefinitionError, match=r"baseline b is of study 'other', not of 'pick_place' \(name another"):
        compared(baseline_of=lambda one: replace(one, study="other"))


def test_a_study_without_the_section(project_of, stores, runner):
    project, store = project_of(""), stores()
    with pytest.raises(DefinitionError, match=r"has no section 'regression' \(name the guarded metrics"):
        make_baseline(project, store, runner(store), before=None, reason=REASON)


@pytest.mark.parametrize(
    ("reason", "said"),
    [(" \n ", "--update needs a reason"), ("x" * 501, "the reason has 501 characters (use at most 500)")],
)
def test_a_reason_that_is_none(project_of, stores, runner, reason, said):
    project, store = project_of(), stores()
    with pytest.raises(DefinitionError, match=re.escape(said)):
        make_baseline(project, store, runner(store), before=None, reason=reason)


def test_a_phase_that_observes_nothing(project_of, stores, runner):
    section = SECTION + "    - {metric: slip_m, phases: [place], better: lower, margin: 1 mm}\n"
    project, store = project_of(section), stores()
    with pytest.raises(DefinitionError, match=r"run planning observes no slip_m at place \(guard it in another run"):
        make_baseline(project, store, runner(store), before=None, reason=REASON)


def test_variants_that_are_none(project_of, stores, runner):
    project, store = project_of(SECTION.replace('"57,60"', '"99"')), stores()
    with pytest.raises(DocumentError, match=r"variants of run planning: unknown variant 99 \(ids go from 1 to 72"):
        make_baseline(project, store, runner(store), before=None, reason=REASON)


def test_a_baseline_needs_all_trials(project_of, stores, runner):
    project, store = project_of(), stores()
    with pytest.raises(
        EvidenceError, match=r"1 trials of run planning could not be run, the first of variant 60 with seed 3 \(a base"
    ):
        make_baseline(
            project,
            store,
            runner(store, lost=lambda spec: (spec.variant, spec.seed) == (60, 3)),
            before=None,
            reason=REASON,
        )


def test_the_name_beside_the_study():
    assert baseline_name("studies/pick_place.yaml") == "studies/pick_place.baseline.json"


@pytest.mark.engine
@pytest.mark.slow
def test_planted_regressions_are_named(stores, edit, folder, monkeypatch):
    """Less friction, a slower planner and a grasp detector that sees nothing, in real trials."""
    section = """
regression:
  runs:
    - {id: planning, fidelity: kinematic, variants: "57", replicates: 3, batch: 6, cap: 9}
    - {id: grasp, fidelity: contact, variants: "57", replicates: 3, batch: 6, cap: 9}
  metrics:
    - {metric: success, runs: [grasp], phases: all, better: higher, margin: 25 %}
    - {metric: planning_time_s, runs: [planning], phases: all, better: lower, margin: 0.5 s}
    - {metric: grip_margin_min, runs: [grasp], phases: all, better: higher, margin: 0.3}
"""
    study = folder / STUDY
    study.write_text(without_section(study.read_text(encoding="utf-8")) + section, encoding="utf-8")
    project, store = load_project(folder), stores()

    def run_in(evidence):
        return lambda specs: sweep(specs, evidence, jobs=0, on_finished=lambda _: None)

    baseline = make_baseline(project, store, run_in(store), before=None, reason=REASON)
    same = compare_with_baseline(project, store, run_in(store), baseline, label="b")
    assert (same.verdict, same.behaviour.changed) == ("same", ())

    edit("designs/grasping_system.yaml", "d6: 0.7", "d6: 0.5")
    report = compare_with_baseline(load_project(folder), store, run_in(store), baseline, label="b")
    assert report.verdict == "worse"
    assert {str(one.subject) for one in report.of(Outcome.WORSE)} >= {
        "grip_margin_min at lift",
        "grip_margin_min at move_to_place",
    }
    assert {one.subject.metric for one in report.of(Outcome.WORSE)} == {"grip_margin_min"}
    assert {one.phase for one in report.behaviour.changed} == {"grasp"}
    assert [str(one) for one in report.inputs] == [
        "input changed: gripper.friction 0.7 → 0.5",
        "file changed: designs/grasping_system.yaml",
    ]
    edit("designs/grasping_system.yaml", "d6: 0.5", "d6: 0.7")

    edit(STUDY, "charge_per_check: 0.25 ms", "charge_per_check: 0.5 ms")
    report = compare_with_baseline(load_project(folder), store, run_in(store), baseline, label="b")
    worse = {str(one.subject) for one in report.of(Outcome.WORSE)}
    assert "planning_time_s at move_to_grasp_approach" in worse
    assert {one.split(" at ")[0] for one in worse} == {"planning_time_s"}
    edit(STUDY, "charge_per_check: 0.5 ms", "charge_per_check: 0.25 ms")

    # The detector is code, whose digest would be another; the plans are the same ones.
    monkeypatch.setattr(FingerHand, "is_firm", lambda *_: False)
    broken = stores()
    broken.put_many(pieces=list(plans_of(store, load_project(folder))))
    report = compare_with_baseline(load_project(folder), broken, run_in(broken), baseline, label="b")
    assert [str(one.subject) for one in report.of(Outcome.WORSE)] == ["success at grasp"]
    assert {one.subject.phase for one in report.of(Outcome.MISSING)} >= {"lift", "place"}
    assert {(one.run, one.phase) for one in report.behaviour.changed} == {("grasp", "grasp")}
    assert all(failing.trouble is not FailureCause.CHANGED_SCHEMA for failing in report.failing)
