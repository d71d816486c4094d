"""Changes of the robot that a guard must not let pass, planted in real trials, and one refactoring that it must."""

from __future__ import annotations

import shutil
from dataclasses import replace

import pytest

from rgss.evidence import EvidenceStore
from rgss.guard import compare_with_baseline, make_baseline
from rgss.physics import world
from rgss.regression.comparing import Outcome
from rgss.regression.input_changes import InputKind
from rgss.studies import FOLDERS, expansion
from rgss.studies.project import load_project
from rgss.sweep.running import sweep
from rgss.trials.code import piece_versions as versions_module
from rgss.trials.plants.control import ControlSettings
from tests.fixtures.shipped_project import STUDY, copy_project

from .conftest import REASON, without_section

pytestmark = pytest.mark.engine

SECTION = """
regression:
  runs:
    - {id: planning, fidelity: kinematic, variants: "57", replicates: 6}
    - {id: grasp, fidelity: contact, variants: "57", replicates: 2}
  metrics:
    - {metric: success, better: higher, margin: 25 %}
    - {metric: planning_time_s, phases: all, better: lower, margin: 1 s}
    - {metric: tracking_error_m, phases: all, better: lower, margin: 50 %, at_least: 0.1 mm}
    - {metric: peak_tool_speed_m_s, runs: [planning, grasp], better: neither, margin: 5 %, at_least: 1 mm/s}
"""


@pytest.fixture(scope="module")
def guarded(tmp_path_factory):
    """The shipped project with a small section, its baseline and the store that it was made from."""
    folder = copy_project(tmp_path_factory.mktemp("guarded") / "project")
    path = folder / STUDY
    path.write_text(without_section(path.read_text(encoding="utf-8")) + SECTION, encoding="utf-8")
    with EvidenceStore.open(folder / "evidence.sqlite") as store:
        baseline = make_baseline(load_project(folder), store, _runner(store), before=None, reason=REASON)
        yield folder, store, baseline


@pytest.fixture
def compared(guarded, tmp_path):
    """Compares with the baseline after a text of a file was replaced, in the same store or a new one."""
    folder, store, baseline = guarded
    copy = tmp_path / "changed"

    def compare(file=None, old="", new="", *, afresh=False, then=lambda origin: origin, accepted=""):
        for name in FOLDERS:
            shutil.copytree(folder / name, copy / name)
        if file is not None:
            text = (copy / file).read_text(encoding="utf-8")
            assert old in text
            (copy / file).write_text(text.replace(old, new, 1), encoding="utf-8")
        before = replace(baseline, origin=then(baseline.origin))
        with EvidenceStore.open(tmp_path / "fresh.sqlite") as fresh:
            used = fresh if afresh else store
            return compare_with_baseline(load_project(copy), used, _runner(used), before, label="b", accepted=accepted)

    return compare


def _runner(store):
    return lambda specs: sweep(specs, store, jobs=0, on_finished=lambda _: None)


def _said(report, kind):
    return [str(one) for one in report.inputs if one.kind is kind]


def _assert_changed(report, *, trials):
    assert report.verdict == "changed"
    assert report.is_unexplained
    assert len(report.behaviour.changed) == trials


def test_a_quarter_of_the_position_gain(compared, monkeypatch):
    """The gain is a number in the code: its module's digest says that it changed, its name what it was."""
    name = "rgss.physics.world._ARM_POSITION_GAIN"
    gain = world._ARM_POSITION_GAIN
    monkeypatch.setattr(world, "_ARM_POSITION_GAIN", gain / 4.0)

    def four_times_now(origin):
        modules = {**origin.modules, "rgss.physics.world": "0" * 12}
        return replace(origin, modules=modules, constants={**origin.constants, name: repr(4.0 * gain)})

    report = compared(afresh=True, then=four_times_now)
    _assert_changed(report, trials=2)
    assert {one.run for one in report.behaviour.changed} == {"grasp"}
    assert _said(report, InputKind.CONSTANT) == [f"constant changed: {name} {4.0 * gain!r} → {gain!r}"]
    assert _said(report, InputKind.CODE) == ["code changed: rgss.physics.world"]


def test_a_tool_slower_by_a_fifth(compared):
    report = compared("designs/grasping_system.yaml", "0.5 m/s", "0.4 m/s")
    _assert_changed(report, trials=8)
    assert _said(report, InputKind.VALUE) == ["input changed: tool_speed_m_s 0.5 → 0.4"]
    moved = {str(one.subject) for one in report.of(Outcome.MOVED)}
    assert moved == {"peak_tool_speed_m_s of the trial"}


def test_a_sixtieth_of_the_planning_time(compared):
    report = compared(STUDY, "charge_per_check: 0.25 ms", "charge_per_check: 0.004 ms")
    _assert_changed(report, trials=8)
    (said,) = _said(report, InputKind.VALUE)
    assert said == "input changed: settings.planning.clock.charge_s 0.00025 → 4e-06"


def test_eight_times_the_time_of_a_firm_grasp(compared, monkeypatch):
    settings_of = expansion.trial_settings

    def longer(project):
        return replace(settings_of(project), control=ControlSettings(firm_grasp_s=0.4))

    monkeypatch.setattr(expansion, "trial_settings", longer)
    report = compared()
    _assert_changed(report, trials=8)
    assert _said(report, InputKind.VALUE) == ["input changed: settings.control.firm_grasp_s 0.05 → 0.4"]


def test_two_per_cent_less_friction(compared):
    report = compared("designs/grasping_system.yaml", "d6: 0.7", "d6: 0.686")
    _assert_changed(report, trials=2)
    assert _said(report, InputKind.VALUE) == ["input changed: gripper.friction 0.7 → 0.686"]


def test_a_reason_lets_a_change_pass_once(compared):
    report = compared("designs/grasping_system.yaml", "d6: 0.7", "d6: 0.686", accepted=" A worn\n pad. ")
    assert (report.verdict, report.is_unexplained, report.fails) == ("inconclusive", False, False)
    assert (report.accepted, len(report.behaviour.changed)) == ("A worn pad.", 2)


def test_another_version_of_an_engine(compared, monkeypatch):
    """Its trials are run again and are the same bit by bit; all others are unknown under it."""
    found = dict(versions_module._installed())
    monkeypatch.setattr(versions_module, "_installed", lambda: {**found, "toppra": "99.0"})
    report = compared()
    assert report.verdict == "changed"
    assert report.behaviour.changed == ()
    assert _said(report, InputKind.ENGINE) == [f"engine changed: toppra {found['toppra']} → 99.0"]
    assert not replace(report, accepted="Bug fixes.").is_unexplained


def test_a_refactoring_stays_green(compared):
    """Other code, a comment in a file, another processor: every record is the same, and no reason is needed."""

    def other(origin):
        return replace(
            origin,
            machine="Another processor",
            modules={**origin.modules, "rgss.trials.execution": "0" * 12, "rgss.trials.gone": "1" * 12},
        )

    report = compared(STUDY, "seed: 1\n", "seed: 1 # the first\n", then=other)
    assert (report.verdict, report.is_unexplained, report.fails) == ("same", False, False)
    assert (report.behaviour.compared, report.behaviour.changed) == (8, ())
    assert _said(report, InputKind.CODE) == ["code changed: rgss.trials.execution", "code changed: rgss.trials.gone"]
    assert _said(report, InputKind.FILE) == [f"file changed: {STUDY}"]
    assert _said(report, InputKind.VALUE) == []


def test_records_that_differ_on_another_machine_alone_are_not_comparable(compared, monkeypatch):
    """The statistics judge them; if anything else changed, it needs a reason."""
    monkeypatch.setattr(world, "_ARM_POSITION_GAIN", world._ARM_POSITION_GAIN * 1.001)
    report = compared(afresh=True, then=lambda origin: replace(origin, machine="Another processor"))
    assert len(report.behaviour.changed) == 2
    assert report.behaviour.machine.startswith("Another processor → ")
    assert (report.verdict, report.is_unexplained) in {("same", False), ("inconclusive", False)}
