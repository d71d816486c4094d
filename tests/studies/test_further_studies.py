"""The studies of the YuMi and of the Lite6: sound, with requirements of their own, and trials that succeed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rgss.cli.main import main
from rgss.evidence import Fidelity
from rgss.findings import Severity
from rgss.studies import check_scene
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.tasks import MoveKind
from rgss.trials.pieces.run import run_trial

REPOSITORY = Path(__file__).parents[2]
YUMI, LITE6 = "studies/yumi_widget.yaml", "studies/lite6_cubes.yaml"


def told(capsys, *words):
    status = main([*words, "--project", str(REPOSITORY)])
    return status, capsys.readouterr().out


@pytest.mark.parametrize("study", [YUMI, LITE6])
def test_the_study_is_sound_and_has_requirements_of_its_own(study, capsys):
    project = load_project(REPOSITORY, study)
    criteria = [one.criterion for one in project.requirements.system]

    assert told(capsys, "check", study)[0] == 0
    assert len(criteria) >= 12
    assert all(criterion is not None for criterion in criteria)
    reference = {one.text for one in load_project(REPOSITORY).requirements.system}
    assert reference.isdisjoint({one.text for one in project.requirements.system})


@pytest.mark.parametrize(("study", "variant"), [(YUMI, 1), (YUMI, 24), (LITE6, 25), (LITE6, 72)])
def test_a_trial_without_contact_succeeds(study, variant, capsys):
    status, output = told(capsys, "run", str(variant), "--study", study, "--fidelity", "kinematic")

    assert (status, "Success" in output) == (0, True)


@pytest.mark.engine
def test_the_normal_mounting_cannot_take_the_cube_and_says_so(capsys):
    findings = check_scene(load_project(REPOSITORY, LITE6)).findings
    assert [finding for finding in findings if finding.severity is not Severity.INFO] == []

    _, output = told(capsys, "run", "1", "--study", LITE6, "--fidelity", "kinematic")
    # A straight move has no planning problem whose goal could be invalid.
    too_wide = "red_cube, 30 mm across, is too wide to enter gripper lite6_parallel in its mounting normal"
    assert f"Failed at red_cube.to_grasp: unreachable_waypoint: {too_wide}, which opens to 16 mm" in output


@pytest.fixture(scope="module")
def trial():
    """The record of a variant of a study at a fidelity."""

    def run(study, variant, fidelity):
        project = load_project(REPOSITORY, study)
        (spec,) = trial_specs(project, variants=[project.designs.variant(variant)], seeds=[1])
        return run_trial(replace(spec, fidelity=fidelity))

    return run


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", Fidelity)
@pytest.mark.verifies("yumi/SYS-01")
def test_three_widgets_are_moved_in_three_cycles(trial, fidelity):
    record = trial(YUMI, 9, fidelity)
    names = [phase.phase for phase in record.phases]

    assert record.success
    assert [sum(name.startswith(f"widget_{number}.") for name in names) for number in (1, 2, 3)] == [10, 10, 10]
    times = [sum(one.duration_s for one in record.phases if one.phase.startswith(f"widget_{n}.")) for n in (2, 3)]
    assert times[1] == pytest.approx(times[0], rel=0.25)


@pytest.mark.engine
@pytest.mark.verifies("yumi/SYS-09")
def test_a_stiffer_controller_keeps_the_tool_closer_in_contact_too(trial):
    soft, stiff = (trial(YUMI, variant, Fidelity.CONTACT) for variant in (11, 12))

    errors_m = [max(phase.metrics.get("tracking_error_m", 0.0) for phase in one.phases) for one in (soft, stiff)]
    assert (soft.success, stiff.success) == (True, True)
    assert 3 * errors_m[1] < errors_m[0] < 2e-3


@pytest.mark.verifies("yumi/SYS-02")
def test_speed_and_profile_shorten_the_cycle_without_contact(trial):
    slow, fast, optimal = (trial(YUMI, variant, Fidelity.KINEMATIC) for variant in (9, 11, 15))

    times_s = [sum(phase.duration_s for phase in one.phases) for one in (slow, fast, optimal)]
    assert times_s[0] > 1.1 * times_s[1] > 1.2 * times_s[2]


@pytest.mark.verifies("yumi/SYS-01")
def test_every_saved_configuration_is_a_waypoint_of_each_cycle():
    moves = load_project(REPOSITORY, YUMI).study.task.moves

    for widget in ("widget_1", "widget_2", "widget_3"):
        cycle = [move for move in moves if move.name.startswith(f"{widget}.")]
        saved = [move.target.name for move in cycle if len(move.target.configuration_rad) == 7]
        assert saved == ["above_tray", "above_feeder"]
        assert [move.name for move in cycle if move.mode is MoveKind.JOINT] == [
            f"{widget}.to_grasp_approach",
            f"{widget}.to_place_approach",
        ]


@pytest.mark.engine
@pytest.mark.parametrize("variant", [29, 37, 53, 61], ids=["fingers v", "fingers p", "cup v", "cup p"])
@pytest.mark.verifies("lite6/SYS-01", "lite6/SYS-05")
def test_all_cubes_are_moved_in_both_control_modes_by_what_can_hold_them(trial, variant):
    record = trial(LITE6, variant, Fidelity.CONTACT)
    placed = [phase for phase in record.phases if phase.phase.endswith(".place")]

    assert record.success
    assert len(placed) == 3
    if variant < 49:  # 250 to 300 ms from one end of the travel to the other
        grasps = [phase for phase in record.phases if phase.phase.endswith(".grasp")]
        assert [one.duration_s for one in grasps] == pytest.approx([0.275] * 3, abs=0.01)
        assert [one.metrics["opening_s"] for one in placed] == pytest.approx([0.275] * 3, abs=0.01)
