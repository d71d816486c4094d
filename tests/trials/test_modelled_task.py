"""The task that the trials run, and the state machine that the architecture has of it, are one and the same.

What may end a state early is found by having it happen: to the planner, to the timing, and to a
world without physics that shows whatever is asked of it.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from rgss.evidence import Failure, PhaseOutcome, PlanOutcome
from rgss.motion import PlanningClock, TimingOutcome
from rgss.physics import Contacts, HandView, PhysicsSettings
from rgss.requirements import StateKind, load_requirements
from rgss.scenes import Pose
from rgss.tasks import MoveStep, default_task
from rgss.trials import timing
from rgss.trials.execution import Execution
from rgss.trials.phase_result import PhaseResult
from rgss.trials.planning import PlannedMove, TaskPlan
from rgss.trials.plants.control import ControlSettings
from rgss.trials.program import run_program
from rgss.trials.record import assemble_record
from rgss.trials.reference import Reference
from rgss.trials.route import route_of
from rgss.trials.timing import time_task
from tests.fixtures.eight_states import CARRYING, PLANNED_PHASES, Phase, step_of

PHASES = tuple(Phase)
MOVES = tuple(phase for phase in Phase if phase not in (Phase.GRASP, Phase.PLACE))
STEPS = 30
NOWHERE = Pose(position_m=(9.0, 9.0, 9.0))


@pytest.fixture(scope="module")
def machine():
    requirements = load_requirements(Path(__file__).parents[2] / "requirements")
    return requirements.element("STM-task").machine


@pytest.fixture(scope="module")
def modelled_failures(machine):
    """What may end which phase, as the model says."""
    phases = {state.id: Phase(state.phase) for state in machine.states if state.phase}
    return {(phases[way.source], Failure(way.failure)) for way in machine.transitions if way.failure}


def walked(machine, fails_in=None, by=None):
    """The phases that the machine runs through, and the kind of the state that it ends in."""
    states = {state.id: state for state in machine.states}
    here = next(state for state in machine.states if state.kind is StateKind.INITIAL)
    phases = []
    while here.kind not in (StateKind.FINAL, StateKind.FAILED):
        phases += [Phase(here.phase)] if here.phase else []
        failure = by.value if phases and phases[-1] is fails_in else None
        (way,) = (way for way in machine.transitions if (way.source, way.failure) == (here.id, failure))
        here = states[way.target]
    return phases, here.kind


class ScriptedPlant:
    """Does what it is told, and fails where it is told to."""

    def __init__(self, fails_in=None, by=None):
        self._fails_in, self._by = fails_in, by

    def start(self, configuration_rad):
        pass

    def move(self, step, reference):
        failure = self._by if step.name == self._fails_in else None
        return PhaseResult(phase=step.name, failure=failure, detail="", duration_s=1.0, metrics={})

    def grip(self, step):
        return self.move(step, None)

    def release(self, step):
        return self.move(step, None)


def reference(tool_m=(0.0, 0.0, 0.0)):
    return Reference(
        positions_rad=np.zeros((STEPS + 1, 6)),
        velocities_rad_s=np.zeros((STEPS, 6)),
        tool_m=np.tile(np.array(tool_m), (STEPS + 1, 1)),
        load_m_s2=np.full(STEPS, 9.81),
        arc_m=np.zeros((STEPS, 3)),
        peak_tool_speed_m_s=0.0,
        peak_tool_acceleration_m_s2=0.0,
    )


REFERENCES = {phase: reference() for phase in MOVES}


def move(phase, outcome=PlanOutcome.SOLVED):
    path = np.zeros((2, 6)) if outcome is PlanOutcome.SOLVED else None
    return PlannedMove(
        phase=phase,
        outcome=outcome,
        checks=10,
        simplification_checks=0,
        search_time_s=0.01,
        time_s=0.01,
        path_rad=path,
        path_length_m=None if path is None else 0.5,
        detail="",
    )


def plan(lift_rad=(0.0,), **outcomes):
    moves = {phase: move(phase, outcomes.get(phase.value, PlanOutcome.SOLVED)) for phase in PLANNED_PHASES}
    lift = None if lift_rad is None else np.zeros((2, 6))
    return TaskPlan(moves=moves, direct={"lift": lift}, clock=PlanningClock(charge_s=0.001))


@pytest.mark.verifies("SYS-023")
def test_the_states_are_the_phases_in_their_order(machine):
    results = run_program(ScriptedPlant(), REFERENCES, task=default_task())
    assert walked(machine) == ([result.phase for result in results], StateKind.FINAL)
    assert [result.phase for result in results] == list(PHASES)


def test_each_state_does_the_activity_of_its_name(machine):
    done = {state.phase: state.does for state in machine.states if state.phase}
    assert done == {phase.value: f"ACT-{phase.value.replace('_', '-')}" for phase in Phase}


@pytest.mark.verifies("SYS-023")
@pytest.mark.parametrize("phase", Phase)
def test_a_failure_ends_program_and_model_in_the_same_state(machine, modelled_failures, phase):
    failures = [failure for where, failure in modelled_failures if where == phase]
    assert failures
    for failure in failures:
        results = run_program(ScriptedPlant(phase, failure), REFERENCES, task=default_task())
        assert walked(machine, phase, failure) == ([result.phase for result in results], StateKind.FAILED)
        assert [result.failure for result in results] == [None] * (len(results) - 1) + [failure]


@pytest.mark.parametrize("phase", MOVES)
def test_a_move_without_a_motion_is_the_last_state_of_record_and_model(machine, spec_of, phase):
    """The program ends before it, and the record names it as the one that failed."""
    missing = {each: reference() for each in MOVES if each != phase}
    failure = Failure.TRAJECTORY_INFEASIBLE
    results = run_program(ScriptedPlant(), missing, task=default_task())
    record = assemble_record(spec_of(), plan(), {phase: (failure, "")}, results)
    phases, _ = walked(machine, phase, failure)
    assert [entry.phase for entry in record.phases if entry.outcome is not PhaseOutcome.NOT_RUN] == phases
    assert (record.failed_phase, record.failure) == (phase, failure)


def test_what_may_end_a_state_is_what_does(modelled_failures, spec_of, monkeypatch):
    happened = planning_failures(spec_of()) | timing_failures(spec_of(), monkeypatch) | physical_failures(spec_of())
    happened |= late_failures(spec_of())
    assert named(happened - modelled_failures) == []
    assert named(modelled_failures - happened) == []


def test_every_failure_but_that_of_a_run_is_modelled(modelled_failures):
    """A run that crashes is a failure of the computer, not of the task."""
    assert {failure for _, failure in modelled_failures} == set(Failure) - {Failure.RUN_CRASHED, Failure.CHECK_FAILED}


def named(failures):
    return sorted((phase.value, failure.value) for phase, failure in failures)


def planning_failures(spec):
    found = set()
    results = run_program(ScriptedPlant(), REFERENCES, task=default_task())
    for phase in PLANNED_PHASES:
        for outcome in set(PlanOutcome) - {PlanOutcome.SOLVED, PlanOutcome.NOT_RUN}:
            record = assemble_record(spec, plan(**{phase.value: outcome}), {}, results)
            found.add((record.failed_phase, record.failure))
    return found


def late_failures(spec):
    """The states in which the time of a task passes its limit."""
    found, results = set(), run_program(ScriptedPlant(), REFERENCES, task=default_task())
    for states in range(len(PHASES)):
        limited = replace(spec, task=replace(spec.task, time_limit_s=states + 0.5))
        record = assemble_record(limited, plan(), {}, results)
        found.add((record.failed_phase, record.failure))
    return found


def timing_failures(spec, monkeypatch):
    found = set()
    task = default_task()
    route = route_of(spec.scene, spec.gripper.geometry, task)
    cell = SimpleNamespace(
        scene=spec.scene,
        geometry=spec.gripper.geometry,
        running=dict.fromkeys(Phase),
        arm=None,
        task=task,
        route=route,
        without_grasp=lambda _: None,
    )
    for outcome in set(TimingOutcome) - {TimingOutcome.TIMED}:
        untimed = SimpleNamespace(outcome=outcome, trajectory=None)
        monkeypatch.setattr(timing, "time_move", lambda *_, result=untimed, **__: result)
        blocked, unreached = ({"lift": (one, "")} for one in (PlanOutcome.MOVE_BLOCKED, PlanOutcome.MOVE_UNREACHABLE))
        for lift, obstacles in (((0.0,), {}), (None, {}), (None, blocked), (None, unreached)):
            stops = SimpleNamespace(obstacles=obstacles, reasons={})
            monkeypatch.setattr(timing, "stops_of", lambda _, found=stops: found)
            timed = time_task(cell, plan(lift_rad=lift), tool_speed_m_s=1.0, settings=spec.settings.planning)
            found |= {(phase, failure) for phase, (failure, _) in timed.failures.items()}
    return found


def physical_failures(spec):
    """What the highest fidelity says when each thing that can go wrong goes wrong in each state."""
    found = set()
    for phase in Phase:
        for wrong in WRONG:
            world = ScriptedWorld(spec)
            execution = Execution(world, REFERENCES, ControlSettings(), world, task=default_task())
            execution.start((0.0,) * 6)
            if phase in CARRYING:
                assert execution.grip(step_of(Phase.GRASP)).failure is None
            world.enter(phase)
            assert result_of(execution, world, phase).failure is None, phase
            world.enter(phase)
            world.wrong = wrong
            failure = result_of(execution, world, phase).failure
            found |= {(phase, failure)} if failure is not None else set()
    return found


def result_of(execution, world, phase):
    step = step_of(phase)
    if isinstance(step, MoveStep):
        return execution.move(step, reference(world.scene.grasp.position_m))
    return step.run(execution)


class ScriptedWorld:
    """A world in which nothing moves, and in which one thing can be wrong."""

    def __init__(self, spec):
        self.scene, self.gripper = spec.scene, spec.gripper
        self.settings = PhysicsSettings()
        self.wrong = ""
        self.grip_fault = ""
        self.enter(Phase.GRASP)

    def reduce_solver_effort(self, *, free):
        """Nothing is solved."""

    def enter(self, phase):
        """Be as a state finds it."""
        self.wrong = ""
        self._phase = phase
        self._released = phase not in (Phase.GRASP, *CARRYING)
        scene = self.scene
        x, y, z = scene.place.centre_m
        placed = Pose(position_m=(x, y, z + scene.workpiece.shape.half_height_m))
        after = phase in (Phase.PLACE, Phase.MOVE_TO_GRASP_APPROACH)
        self._object = placed if after else scene.workpiece.pose

    def contacts(self, standing=None):
        force_n = 0.0 if self._released else self.gripper.finger_force_n
        force_n = FORCES_N.get(self.wrong, force_n)
        return Contacts(
            finger_forces_n=(force_n,) * self.gripper.geometry.fingers,
            other_force_n=1.0 if self.wrong == "the arm presses the object" else 0.0,
            pressed=(),
            robot_bodies=(("forearm", "column"),) if self.wrong == "the arm touches the scene" else (),
            workpiece_bodies=("column",) if self.wrong == "the object touches the scene" else (),
            pressing_links=("forearm",) if self.wrong == "the arm presses the object" else (),
        )

    def finger_contacts(self):
        return ()

    def workpiece_pose(self):
        x, y, z = self._object.position_m
        if self.wrong == "the object is somewhere else":
            return Pose(position_m=(x + 0.2, y, z))
        if self.wrong == "the object hangs in the air":
            return Pose(position_m=(x, y, z + 0.2))
        if self.wrong in ("the object leans", "the object has toppled"):
            if self.wrong == "the object has toppled":
                x += 0.05
            half = math.radians(40.0) / 2
            toppled = (math.sin(half), 0.0, 0.0, math.cos(half))
            return replace(self._object, position_m=(x, y, z), quaternion_xyzw=toppled)
        return self._object

    def hand_view(self):
        workpiece, tool = self.workpiece_pose(), self.scene.grasp
        return HandView(
            workpiece.position_m,
            workpiece.quaternion_xyzw,
            tool.position_m,
            tool.quaternion_xyzw,
            (0.0, 0.0, 0.0),
            self.finger_travel_m(),
        )

    @property
    def reach_m(self):
        return 1.0

    def tool_motion(self, qs, dqs):
        """Also stands in for the kinematics: only where the joints are astray is the tool somewhere else."""
        here = NOWHERE if qs[0][0] else self.scene.grasp
        return np.tile(here.position_m, (len(qs), 1)), np.zeros((len(qs), 3))

    def support_force_n(self):
        return 1.0e6 if self.wrong == "the object lands hard" else 0.0

    def finger_travel_m(self):
        travel_m = 0.01 if self.wrong == "the fingers are stuck" else 0.0
        return (travel_m,) * self.gripper.geometry.fingers

    def arm_state(self):
        astray_rad = 1.0 if self.wrong == "the tool is off its path" else 0.0
        return (astray_rad,) * 6, (0.0,) * 6, (0.0,) * 6

    def reset_arm(self, configuration_rad):
        pass

    def command_arm(self, position_rad, velocity_rad_s):
        pass

    def drive_fingers(self, velocity_m_s, force_n):
        pass

    def hold_open(self):
        pass

    def bend(self, arc_m):
        pass

    def step(self):
        pass


FORCES_N = {
    "no finger touches the object": 0.0,
    "the fingers hardly touch the object": 1.0e-3,
    "a finger presses too hard": 1.0e6,
}
WRONG = (
    *FORCES_N,
    "the arm presses the object",
    "the arm touches the scene",
    "the object touches the scene",
    "the object is somewhere else",
    "the object hangs in the air",
    "the object leans",
    "the object has toppled",
    "the object lands hard",
    "the tool is off its path",
    "the fingers are stuck",
)
