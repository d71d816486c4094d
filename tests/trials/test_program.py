"""The task program on a plant that does what it is told: order, first failure, missing motions."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

import numpy as np
import pytest

from rgss.evidence import Failure
from rgss.tasks import (
    CheckStep,
    GripStep,
    MoveStep,
    NeutralStep,
    ReleaseStep,
    Step,
    Target,
    TaskProgram,
    WaitStep,
    default_task,
)
from rgss.trials.phase_result import PhaseResult
from rgss.trials.program import run_program
from rgss.trials.reference import Reference
from tests.fixtures.eight_states import Phase, step_of

CHECK = CheckStep(name="check", is_at_rest=True)
STEPS = {
    MoveStep: (MoveStep(name=Phase.LIFT, target=Target(name="pose")), "move"),
    GripStep: (GripStep(name=Phase.GRASP), "grip"),
    ReleaseStep: (ReleaseStep(name=Phase.PLACE), "release"),
    WaitStep: (WaitStep(name="wait", duration_s=0.5), "wait"),
    NeutralStep: (NeutralStep(name="neutral"), "neutral"),
    CheckStep: (CHECK, "check"),
}
"""A step of each kind, and the method of the plant that it calls."""

MOVES = tuple(phase for phase in Phase if phase not in (Phase.GRASP, Phase.PLACE))
START_RAD = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)


class ScriptedPlant:
    """Notes what it is asked for, and fails where it is told to."""

    def __init__(self, fails_at=None):
        self.calls = []
        self.fails_at = fails_at

    def start(self, configuration_rad):
        self.calls.append(("start", configuration_rad))

    def move(self, step, reference):
        self.calls.append(("move", step.name, reference))
        return self._result(step.name)

    def grip(self, step):
        return self._rest("grip", step)

    def release(self, step):
        return self._rest("release", step)

    def neutral(self, step):
        return self._rest("neutral", step)

    def wait(self, step):
        return self._rest("wait", step)

    def check(self, step):
        return self._rest("check", step)

    def _rest(self, method, step):
        self.calls.append((method, step))
        return self._result(step.name)

    def _result(self, phase):
        failure = Failure.OBJECT_DROPPED if phase == self.fails_at else None
        detail = "" if failure is None else "it fell"
        return PhaseResult(phase=phase, failure=failure, detail=detail, duration_s=1.0, metrics={})


def reference(first_rad=0.0):
    positions = np.full((2, 6), first_rad)
    return Reference(
        positions_rad=positions,
        velocities_rad_s=np.zeros((1, 6)),
        tool_m=np.zeros((2, 3)),
        load_m_s2=np.zeros(1),
        arc_m=np.zeros((1, 3)),
        peak_tool_speed_m_s=0.0,
        peak_tool_acceleration_m_s2=0.0,
    )


@pytest.fixture
def references():
    found = {phase: reference(float(index)) for index, phase in enumerate(MOVES)}
    found[Phase.MOVE_TO_GRASP].positions_rad[0] = START_RAD
    return found


def test_the_eight_states_run_in_their_order(references):
    plant = ScriptedPlant()
    results = run_program(plant, references, task=default_task())
    assert [result.phase for result in results] == list(Phase)
    assert plant.calls == [
        ("start", START_RAD),
        ("move", Phase.MOVE_TO_GRASP, references[Phase.MOVE_TO_GRASP]),
        ("grip", step_of(Phase.GRASP)),
        ("move", Phase.LIFT, references[Phase.LIFT]),
        ("move", Phase.MOVE_TO_GRASP_DEPARTURE, references[Phase.MOVE_TO_GRASP_DEPARTURE]),
        ("move", Phase.MOVE_TO_PLACE_APPROACH, references[Phase.MOVE_TO_PLACE_APPROACH]),
        ("move", Phase.MOVE_TO_PLACE, references[Phase.MOVE_TO_PLACE]),
        ("release", step_of(Phase.PLACE)),
        ("move", Phase.MOVE_TO_GRASP_APPROACH, references[Phase.MOVE_TO_GRASP_APPROACH]),
    ]


def test_it_starts_once_where_the_first_motion_begins_in_plain_numbers(references):
    plant = ScriptedPlant()
    run_program(plant, references, task=default_task())
    starts = [call for call in plant.calls if call[0] == "start"]
    assert starts == [("start", START_RAD)]
    assert all(type(angle) is float for angle in starts[0][1])


def test_steps_before_the_first_motion_run_where_it_begins(references):
    plant, task = ScriptedPlant(), default_task()
    wait = WaitStep(name="wait", duration_s=0.5)
    results = run_program(plant, references, task=replace(task, steps=(CHECK, wait, *task.steps)))
    assert [result.phase for result in results] == ["check", "wait", *Phase]
    assert plant.calls[:3] == [("start", START_RAD), ("check", CHECK), ("wait", wait)]


@pytest.mark.parametrize("phase", Phase)
def test_it_ends_with_the_first_failure(references, phase):
    plant = ScriptedPlant(fails_at=phase)
    results = run_program(plant, references, task=default_task())
    ran = list(Phase)[: list(Phase).index(phase) + 1]
    assert [result.phase for result in results] == ran
    assert [result.failure for result in results] == [None] * (len(ran) - 1) + [Failure.OBJECT_DROPPED]
    assert len(plant.calls) == len(ran) + 1


@pytest.mark.parametrize("phase", MOVES[1:])
def test_it_ends_before_a_move_that_has_no_motion(references, phase):
    del references[phase]
    results = run_program(ScriptedPlant(), references, task=default_task())
    assert [result.phase for result in results] == list(Phase)[: list(Phase).index(phase)]


def test_without_the_first_motion_nothing_is_started(references):
    del references[Phase.MOVE_TO_GRASP]
    plant = ScriptedPlant()
    assert run_program(plant, references, task=default_task()) == ()
    assert plant.calls == []


def test_a_checkpoint_is_passed_before_each_phase_and_may_end_the_program(references):
    plant, passed = ScriptedPlant(), []

    def checkpoint():
        passed.append(len(plant.calls))
        if len(passed) == 4:
            raise RuntimeError("stop")

    with pytest.raises(RuntimeError, match="stop"):
        run_program(plant, references, checkpoint=checkpoint, task=default_task())
    assert passed == [1, 2, 3, 4]
    assert [call[0] for call in plant.calls] == ["start", "move", "grip", "move"]


@pytest.mark.parametrize("kind", get_args(Step))
def test_each_kind_of_step_calls_its_method_of_the_plant(references, kind):
    plant, (step, method) = ScriptedPlant(), STEPS[kind]
    first = MoveStep(name=Phase.MOVE_TO_GRASP, target=Target(name="pose"))
    results = run_program(plant, references, task=TaskProgram(id="one", start=None, steps=(first, step)))
    assert [call[0] for call in plant.calls] == ["start", "move", method]
    assert [result.phase for result in results] == [first.name, step.name]
