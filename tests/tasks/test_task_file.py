"""Task files: what they say, how loops are written out, and what is wrong with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.errors import DocumentError
from rgss.tasks import MoveKind, Nearness, StepControl, default_task, load_task, stages_of
from tests.fixtures.eight_states import CARRYING, PLANNED_PHASES, Phase

ROOT = Path(__file__).parents[2]
HEAD = "task: t\nsteps:\n"
REACH = "  - move: {to: grasp}\n"
CARRY = REACH + "  - grip: {}\n  - move: {to: place}\n"


def findings_of(tmp_path, text):
    path = tmp_path / "task.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DocumentError) as caught:
        load_task(path, label="task.yaml")
    return [str(finding) for finding in caught.value.findings]


def program_of(tmp_path, text):
    path = tmp_path / "task.yaml"
    path.write_text(text, encoding="utf-8")
    return load_task(path).program


def test_the_default_is_the_eight_states_and_the_shipped_file_is_its_text():
    task = default_task()

    assert task.phases == tuple(phase.value for phase in Phase)
    assert task.planned == tuple(phase.value for phase in PLANNED_PHASES)
    assert task.carried == tuple(phase.value for phase in CARRYING)
    assert task.direct == (Phase.LIFT.value,)
    assert load_task(ROOT / "scenes/tasks/pick_and_place.yaml").program == task


def test_loops_give_each_step_a_name_of_its_own(tmp_path):
    inner = (
        "    - repeat:\n        times: 2\n        steps:\n"
        "          - for_each:\n              objects: [a, b]\n              steps:\n"
        "                - move: {to: grasp, mode: joint}\n                - grip: {}\n"
        "                - release: {}\n"
    )

    task = program_of(tmp_path, "task: t\nsteps:\n" + inner)

    assert task.phases[:4] == (
        "cycle_1.a.move_to_grasp",
        "cycle_1.a.grip",
        "cycle_1.a.release",
        "cycle_1.b.move_to_grasp",
    )
    assert len(set(task.phases)) == 12
    assert [stage.object for stage in stages_of(task, "w")] == ["a"] * 4 + ["b"] * 3 + ["a"] * 3 + ["b"] * 2
    assert [stage.turn for stage in stages_of(task, "w")] == [1] * 7 + [2] * 5
    assert task.moves[0].mode is MoveKind.JOINT


@pytest.mark.parametrize(
    ("steps", "problem"),
    [
        ("  - move: {to: moon}\n", "task.yaml:3:16: error: there is no waypoint 'moon'"),
        ("  - move: {configuration: rest}\n", "task.yaml:3:27: error: there is no configuration 'rest'"),
        ("  - move: {}\n", "task.yaml:3:11: error: a move needs one of to, configuration, frame and pose, got none"),
        (REACH + "  - release: {}\n", "task.yaml:4:14: error: 'release' releases, and nothing is held"),
        (
            REACH + "  - grip: {}\n" + REACH.replace("to:", "name: n, to:") + "  - grip: {name: more}\n",
            "'more' grips while",
        ),
        (REACH + "  - wait: {duration: 1 s}\n  - grip: {}\n", "'grip' needs a move before it"),
        (REACH + REACH, "task.yaml:4:11: error: there are two steps 'move_to_grasp'"),
        (REACH + "  - repeat: {times: 1, steps: []}\n", "task.yaml:4:13: error: the loop has no steps to repeat"),
        (
            REACH + "  - repeat: {times: 0, steps: [wait: {duration: 1 s}]}\n",
            "error: the loop is repeated 0 times (write",
        ),
        (REACH + "  - for_each: {objects: [], steps: []}\n", "task.yaml:4:15: error: the loop has no steps to repeat"),
        (REACH + "  - check: {}\n", "task.yaml:4:12: error: the check states no condition"),
        (REACH + "  - wait: {duration: 0 s}\n", "task.yaml:4:22: error: duration must be greater than zero"),
        (REACH + "  - {}\n", "a step has exactly one kind, got none"),
        ("  - wait: {duration: 1 s}\n", "error: a task must have a move (add a move) [task.no-move]"),
        ("  - wait: {duration: 1 s}\n  - grip: {}\n" + REACH, "'grip' needs a move before it"),
        ("  - move: {to: grasp, speed: 2}\n", "speed must be a share in (0, 1], got 2"),
        ("  - move: {to: grasp, time_limit: 0 s}\n", "time_limit must be greater than zero"),
        ("  - move: {to: grasp, mode: joint, time_limit: 1 s}\n", "only a planned move has a planning limit"),
        ("  - move: {to: grasp, reached_within: 0 deg}\n", "3:39: error: reached_within must be greater than zero"),
        (REACH + "  - grip: {firm_above: 0 N}\n", "4:24: error: firm_above must be greater than zero"),
        (REACH + "  - grip: {firm_for: -1 s}\n", "4:22: error: firm_for must be greater than zero"),
        (CARRY + "  - release: {reached_within: 0 mm}\n", "6:31: error: reached_within must be greater than zero"),
        (
            "  - move: {to: grasp, control: {velocity_gain: 0 rad/s}}\n",
            "3:48: error: velocity_gain must be greater than zero",
        ),
        (
            "  - move: {to: grasp, control: {position_gain: -1 rad/s}}\n",
            "3:48: error: position_gain must not be negative [task.negative]",
        ),
        (
            REACH + "  - check: {near: {within: 1 mm}}\n",
            "4:19: error: near needs one of place, object and point, got none (name one) [task.near]",
        ),
        (
            REACH + "  - check: {near: {place: a, object: b, within: 1 mm}}\n",
            "near needs one of place, object and point, got place and object",
        ),
        (REACH + "  - check: {near: {place: a, within: 0 mm}}\n", "within must be greater than zero"),
    ],
)
def test_what_is_wrong_is_found_at_its_place(tmp_path, steps, problem):
    (finding, *_) = findings_of(tmp_path, HEAD + steps)

    assert problem in finding


def test_a_name_that_recurs_in_a_loop_is_found_once_for_its_step(tmp_path):
    inner = "      steps:\n        - move: {to: grasp}\n        - move: {to: grasp}\n"

    (finding,) = findings_of(tmp_path, HEAD + "  - repeat:\n      times: 3\n" + inner)

    assert finding.startswith("task.yaml:7:17: error: there are two steps 'cycle_1.move_to_grasp' (")


def test_thresholds_of_the_task_are_those_of_steps_that_state_none(tmp_path):
    text = (
        "task: t\nreached_within: {joints: 2 mrad, gripper: 1 mm}\nsteps:\n"
        "  - move: {to: grasp}\n"
        "  - grip: {firm_above: 3 N, firm_for: 80 ms, control: {mode: velocity}}\n"
        "  - move: {to: place, reached_within: 5 mrad, control: {natural_frequency: 60 rad/s}}\n"
        "  - release: {}\n"
        "  - wait: {duration: 1 s, control: {damping_ratio: 0.9}}\n"
        "  - check: {near: {point: [1 m, 2 m, 30 cm], within: 4 mm}}\n"
    )

    move, grip, carry, release, wait, check = program_of(tmp_path, text).steps

    assert (move.reached_rad, carry.reached_rad) == (0.002, 0.005)
    assert (move.control, carry.control) == (None, StepControl(natural_frequency_rad_s=60.0))
    assert (grip.firm_above_n, grip.firm_s, grip.control) == (3.0, 0.08, StepControl(mode="velocity"))
    assert release.opened_m == 1e-3
    assert wait.control == StepControl(damping_ratio=0.9)
    assert check.near == Nearness(within_m=0.004, point_m=(1.0, 2.0, 0.3))
    (finding,) = findings_of(tmp_path, text.replace("joints: 2 mrad", "joints: 0 rad"))
    assert finding.startswith("task.yaml:2:26: error: joints must be greater than zero")


def test_a_straight_line_does_not_end_at_a_configuration(tmp_path):
    text = "task: t\nconfigurations: {c: [0 deg]}\nsteps:\n  - move: {configuration: c, mode: straight}\n"

    assert "not at a configuration" in findings_of(tmp_path, text)[0]


def test_a_task_may_begin_with_a_check_or_a_wait(tmp_path):
    text = "task: t\nsteps:\n  - check: {at_rest: true}\n  - wait: {duration: 1 s}\n" + CARRY + "  - release: {}\n"

    task = program_of(tmp_path, text)

    assert task.phases[:3] == ("check", "wait", "move_to_grasp")
    assert [stage.turn for stage in stages_of(task, "w")] == [1] * 6
