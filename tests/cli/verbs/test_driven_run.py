"""``rgss run --driver``: rehearsal, simulated robot, and what does not belong together."""

from __future__ import annotations

import csv
import math
import os
import signal
from dataclasses import replace

import pytest

from rgss.cli.driven import timed_task
from rgss.cli.driven.running import _interrupt_flag, _require_drivable, _result_as_json, _show_rehearsal, _show_result
from rgss.drivers import (
    Estimate,
    GripperState,
    Rehearsal,
    RobotLimits,
    SetPoint,
    SimulatedDriver,
    StreamOutcome,
    StreamResult,
    XarmDriver,
)
from rgss.drivers.streaming import Sample
from rgss.errors import DefinitionError, MotionError
from rgss.scenes import JointKind
from rgss.studies import load_project, trial_specs
from rgss.tasks import HandAction
from rgss.trials import plan_of, timing_of
from rgss.trials.hands import hand_of
from rgss.trials.plants import GripSequence
from tests.fixtures.shipped_project import REPOSITORY

PHASES = 8


@pytest.mark.engine
def test_the_simulated_robot_follows_the_planned_task(rgss, untouched, tmp_path):
    file = tmp_path / "recording.csv"
    arguments = ("run", 65, "--nominal", "--driver", "simulated", "--speed", "100 %", "--json")
    told = rgss(*arguments, "--recording", file, "--project", untouched)
    assert (told.status, told.errors) == (0, "")
    document = told.document
    assert (document["outcome"], document["speed"], len(document["segments"])) == ("completed", 1.0, PHASES)
    assert max(segment["peak_speed"] for segment in document["segments"]) <= 1.01
    assert max(segment["peak_acceleration"] for segment in document["segments"]) <= 1.01
    # The plant lags behind its set points, a little.
    assert 0.0 < document["largest_error_rad"] < math.radians(0.5)
    first = file.read_bytes()
    rows = list(csv.reader(first.decode().splitlines()[3:]))
    assert len(rows) == document["sent"] + 2
    rgss(*arguments, "--recording", file, "--project", untouched)
    assert file.read_bytes() == first


@pytest.mark.engine
@pytest.mark.parametrize("driver", ["ur", "xarm"])
def test_a_real_robot_is_only_rehearsed(rgss, untouched, driver):
    told = rgss("run", 65, "--nominal", "--driver", driver, "--project", untouched)
    assert (told.status, told.errors) == (0, "")
    assert f"Driver {driver} at 10 % of the planned speed" in told.output
    assert "start [deg]: shoulder_pan_joint" in told.output
    assert "A rehearsal: nothing was sent." in told.output
    whole = ("--speed", "100 %")  # a tenth of the points
    as_json = rgss("run", 65, "--nominal", "--driver", driver, *whole, "--json", "--project", untouched).document
    assert as_json["outcome"] is None
    assert len(as_json["start_rad"]) == 6


@pytest.mark.engine
@pytest.mark.parametrize(("variant", "is_vacuum"), [(70, True), (30, False)])
def test_the_driver_knows_the_kind_of_gripper(rgss, monkeypatch, variant, is_vacuum):
    made = []

    def note(address, **options):
        made.append(options)
        return XarmDriver(address, **options)

    monkeypatch.setattr("rgss.drivers.XarmDriver", note)
    design = (variant, "--study", "studies/lite6_cubes.yaml", "--nominal")
    told = rgss("run", *design, "--driver", "xarm", "--speed", "100 %", "--project", REPOSITORY)
    assert (told.status, told.errors) == (0, "")
    assert made == [{"joints": 6, "is_vacuum": is_vacuum}]


@pytest.mark.parametrize(
    ("driver", "joints", "sliding", "told"),
    [
        ("ur", 6, 0, None),
        ("xarm", 5, 0, None),
        ("simulated", 3, 2, None),
        ("ur", 5, 0, "driver ur moves arms of 6 joints that turn; ur10 has 5"),
        ("ur", 6, 1, "driver ur moves arms of 6 joints that turn; ur10 has 6, 1 of which slides"),
        ("xarm", 4, 2, "driver xarm moves arms of 5 to 7 joints that turn; ur10 has 4, 2 of which slide"),
    ],
)
def test_a_driver_is_refused_for_a_robot_that_is_none_of_its_arms(shipped, driver, joints, sliding, told):
    robot = shipped.scene.robot
    kinds = [JointKind.PRISMATIC] * sliding + [JointKind.REVOLUTE] * (joints - sliding)
    pairs = zip(robot.joints, kinds, strict=False)
    robot = replace(robot, joints=tuple(replace(joint, kind=kind) for joint, kind in pairs))
    if told is None:
        _require_drivable(driver, robot)
        return
    with pytest.raises(DefinitionError) as error:
        _require_drivable(driver, robot)
    assert (error.value.message, error.value.hint) == (told, "use --driver simulated")


@pytest.mark.engine
def test_a_robot_that_does_not_answer_is_one_line(rgss, untouched):
    words = ("--driver", "ur", "--speed", "100 %", "--go", "--address", "127.0.0.1")
    told = rgss("run", 65, "--nominal", *words, "--project", untouched)
    assert told.status == 3
    assert told.errors.splitlines()[-1].startswith("rgss: no RTDE receive interface at 127.0.0.1: ")


@pytest.mark.engine
def test_a_move_without_a_path_cannot_be_sent(untouched):
    project = load_project(untouched).nominal()
    (spec,) = trial_specs(project, variants=[project.designs.variant(65)], seeds=[1])
    plan = plan_of(spec)
    timing = timing_of(spec, plan)
    first = next(iter(timing.trajectories))
    timing = type(timing)(trajectories={}, failures={}, qualities={})
    with pytest.raises(MotionError, match=f"the move {first} cannot be sent to a robot: its planning ended with"):
        timed_task(spec, plan, timing)


@pytest.mark.engine
def test_a_path_that_the_design_does_not_find_in_time_is_not_sent(untouched):
    project = load_project(untouched).nominal()
    (spec,) = trial_specs(project, variants=[project.designs.variant(65)], seeds=[1])
    plan = plan_of(spec)
    timing = timing_of(spec, plan)
    assert timed_task(spec, plan, timing).segments
    with pytest.raises(MotionError, match=r"cannot be sent to a robot: no path was found within the planning limit of"):
        timed_task(replace(spec, planning_limit_s=0.001), plan, timing)


@pytest.mark.engine
def test_the_folder_of_a_recording_is_asked_for_before_the_robot(rgss, untouched):
    told = rgss("run", 65, "--driver", "simulated", "--recording", "nowhere/x.csv", "--project", untouched)
    assert (told.status, told.output) == (2, "")
    assert "nowhere/x.csv cannot be written: there is no such folder (create it)" in told.errors


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (("--go",), "--go needs --driver (one of simulated, xarm, ur)"),
        (("--speed", "10 %"), "--speed needs --driver"),
        (("--gripper-output", "1"), "--gripper-output needs --driver"),
        (("--driver", "ur", "--gif", "a.gif"), "a run on a driver draws no pictures"),
        (("--driver", "simulated", "--go"), "--go is for a real robot"),
        (("--driver", "simulated", "--address", "x"), "--address is for a real robot"),
        (("--driver", "xarm", "--go"), "--driver xarm --go needs --address"),
        (
            ("--driver", "ur", "--address", "192.168.10", "--go"),
            "--address must be a name or four numbers from 0 to 255, got '192.168.10' (such as 192.168.0.10",
        ),
        (("--driver", "xarm", "--address", " 10.0.0.7"), "--address must be a name or four numbers from 0 to 255"),
        (
            ("--driver", "xarm", "--address", "fe80::1"),
            "--address must be a name or an IPv4 address, got an IPv6 address: 'fe80::1' (give the address alone",
        ),
        (
            ("--driver", "ur", "--address", "192.168.0.10:30004"),
            "--address must be a name or an IPv4 address, got a port or a URL: '192.168.0.10:30004'",
        ),
        (
            ("--driver", "ur", "--address", "robot.invalid", "--go"),
            "--address: no IPv4 address of 'robot.invalid' is found (check its spelling and the network)",
        ),
        (("--driver", "ur", "--recording", "a.csv"), "a rehearsal measures nothing to record"),
        (("--driver", "xarm", "--gripper-output", "1"), "--gripper-output must be from 0 to 7 and is for --driver ur"),
        (("--driver", "ur", "--gripper-output", "8"), "--gripper-output must be from 0 to 7"),
        (("--driver", "ur", "--speed", "fast"), "--speed: 'fast' is not a quantity"),
        (("--driver", "ur", "--speed", "0 %"), "--speed must be above 0 % and at most 100 %, got 0 %"),
        (("--driver", "ur", "--speed", "101 %"), "--speed must be above 0 % and at most 100 %, got 101 %"),
    ],
)
def test_options_that_do_not_belong_together(rgss, untouched, words, error):
    told = rgss("run", 65, *words, "--project", untouched)
    assert (told.status, told.output) == (2, "")
    assert told.errors.startswith(f"rgss: {error}")


def test_a_joint_that_slides_is_shown_in_millimetres(capsys):
    joints = {"lower_rad": (-1.0, -1.0), "upper_rad": (1.0, 1.0), "speed_rad_s": (1.0, 1.0)}
    limits = RobotLimits(
        names=("rail", "turn"),
        **joints,
        acceleration_rad_s2=(1.0, 1.0),
        tool_speed_m_s=1.0,
        slides=frozenset({"rail"}),
    )
    _show_rehearsal(Rehearsal(start_rad=(-0.295, 0.5), segments=(), refusal=""), limits, "simulated", 1.0)
    assert "start: rail -295.00 mm, turn 28.65 deg" in capsys.readouterr().out
    point = {"velocities_rad_s": (0.0, 0.0), "gripper": GripperState.OPEN}
    sample = Sample(
        time_s=0.0,
        phase="go",
        measured=Estimate(positions_rad=(0.002, 0.0), stamp=0.0, **point),
        commanded=SetPoint(positions_rad=(0.0, 0.01), **point),
    )
    result = StreamResult(outcome=StreamOutcome.COMPLETED, detail="", sent=1, samples=(sample,))
    _show_result(result, limits)
    assert "largest following error 0.573 deg and 2 mm" in capsys.readouterr().out
    shown = _result_as_json(result, limits)
    assert (shown["largest_error_m"], shown["largest_error_rad"]) == (0.002, 0.01)


def test_ctrl_c_is_a_flag_while_a_robot_moves():
    before = signal.getsignal(signal.SIGINT)
    with _interrupt_flag() as is_interrupted:
        assert not is_interrupted()
        os.kill(os.getpid(), signal.SIGINT)
        assert is_interrupted()
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.parametrize(("handler", "is_noted"), [(signal.SIG_DFL, True), (signal.SIG_IGN, False)])
def test_the_loss_of_the_terminal_is_a_flag_but_under_nohup(handler, is_noted):
    before = signal.signal(signal.SIGHUP, handler)
    try:
        with _interrupt_flag() as is_interrupted:
            if is_noted:
                os.kill(os.getpid(), signal.SIGHUP)
            else:
                assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
            assert is_interrupted() is is_noted
        assert signal.getsignal(signal.SIGHUP) is handler
    finally:
        signal.signal(signal.SIGHUP, before)


def test_the_second_signal_interrupts_and_no_further_one_does():
    with _interrupt_flag() as is_interrupted:
        os.kill(os.getpid(), signal.SIGINT)
        assert is_interrupted()
        with pytest.raises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGTERM)
        # While the robot is being stopped.
        os.kill(os.getpid(), signal.SIGINT)
        assert is_interrupted()


def test_no_signal_interrupts_the_writing_of_a_recording():
    with _interrupt_flag() as is_interrupted:
        is_interrupted.ends_waiting = False
        for _ in range(3):
            os.kill(os.getpid(), signal.SIGINT)
        assert is_interrupted()


@pytest.mark.engine
def test_the_simulated_robot_carries_what_each_grip_takes(untouched):
    """The second object is too heavy for the arm, which sags under it and not under the first."""
    project = load_project(untouched).nominal()
    (spec,) = trial_specs(project, variants=[project.designs.variant(65)], seeds=[1])
    scene = spec.scene
    heavy = replace(scene, workpiece=replace(scene.workpiece, mass_kg=80.0))
    home = tuple(scene.robot.home_rad)
    driver = SimulatedDriver(scene, spec.gripper, spec.settings.physics, start_rad=home, grips=[scene, heavy])
    driver.connect()
    still, sagged_rad = (0.0,) * len(home), []
    try:
        for state in (GripperState.CLOSED, GripperState.OPEN, GripperState.CLOSED):
            driver.send(SetPoint(positions_rad=home, velocities_rad_s=still, gripper=state))
            driver.wait_until(driver.now_s() + 0.3)
            sagged_rad.append(max(abs(a - b) for a, b in zip(driver.read().positions_rad, home, strict=True)))
    finally:
        driver.disconnect()
    assert max(sagged_rad[:2]) < 1e-3
    assert sagged_rad[2] > 0.05


@pytest.mark.engine
def test_the_robot_waits_for_the_vacuum():
    project = load_project(REPOSITORY, "studies/lite6_cubes.yaml").nominal()
    (spec,) = trial_specs(project, variants=[project.designs.variant(70)], seeds=[1])
    suction = spec.gripper.geometry.cup
    assert suction is not None
    plan = plan_of(spec)
    waits = {
        one.name: one.wait_s for one in timed_task(spec, plan, timing_of(spec, plan)).segments if one.motion is None
    }
    hand = hand_of(spec.gripper)
    view = GripSequence(spec.task, spec.scene, spec.gripper.geometry)
    for step in spec.task.steps:
        if step.hand is HandAction.CLOSES:
            assert waits[step.name] >= hand.closing_s(view.view_of(step), spec.settings.control.firm_grasp_s) > 0.2
        elif step.hand is HandAction.OPENS:
            assert waits[step.name] >= hand.opening_s(view.view_of(step)) > 0.15
