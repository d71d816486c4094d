"""Task files: what they say, how loops are written out, and what is wrong with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.errors import DocumentError
from rgss.tasks import MoveKind, default_task, load_task, stages_of
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
        ("  - move: {}\n", "task.yaml:3:11: error: a move needs one of to, configuration and pose, got none"),
        (REACH + "  - release: {}\n", "task.yaml:4:14: error: 'release' releases, and nothing is held"),
        (
            REACH + "  - grip: {}\n" + REACH.replace("to:", "name: n, to:") + "  - grip: {name: more}\n",
            "'more' grips while",
        ),
        (REACH + "  - wait: {duration: 1 s}\n  - grip: {}\n", "'grip' has no move before it"),
        (REACH + REACH, "task.yaml:4:11: error: there are two steps 'move_to_grasp'"),
        (REACH + "  - repeat: {times: 0, steps: []}\n", "task.yaml:4:13: error: the loop does nothing"),
        (REACH + "  - for_each: {objects: [], steps: []}\n", "task.yaml:4:15: error: the loop does nothing"),
        (REACH + "  - check: {}\n", "task.yaml:4:12: error: the check states no condition"),
        (REACH + "  - wait: {duration: 0 s}\n", "task.yaml:4:22: error: duration must be greater than zero"),
        (REACH + "  - {}\n", "a step has exactly one kind, got none"),
        ("  - wait: {duration: 1 s}\n", "the first step must be a move"),
        ("  - move: {to: grasp, speed: 2}\n", "speed must be a share in (0, 1], got 2"),
        ("  - move: {to: grasp, time_limit: 0 s}\n", "time_limit must be greater than zero"),
        ("  - move: {to: grasp, mode: joint, time_limit: 1 s}\n", "only a planned move has a planning limit"),
    ],
)
def test_what_is_wrong_is_found_at_its_place(tmp_path, steps, problem):
    (finding, *_) = findings_of(tmp_path, HEAD + steps)

    assert problem in finding


def test_a_straight_line_does_not_end_at_a_configuration(tmp_path):
    text = "task: t\nconfigurations: {c: [0 deg]}\nsteps:\n  - move: {configuration: c, mode: straight}\n"

    assert "not at a configuration" in findings_of(tmp_path, text)[0]
