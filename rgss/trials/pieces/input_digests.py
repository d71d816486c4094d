"""Digests of exactly the inputs of each piece of a trial.

A trial is divided into pieces by their inputs. The *plan* needs the scene, the gripper's shape, the planner with its
parameters and the seed; the *timing* needs the plan, the tool speed and the joints' speed and acceleration limits; the
*execution* needs the timing, the inertias and torques of the arm, the gripper's masses, forces and friction, and the
durations and conditions of the steps; the *bench* needs only the gripper and the object; only the *record* needs the
planning limits. Variants with the same digest of a piece share the piece.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from rgss.documents import digest
from rgss.evidence import Fidelity
from rgss.motion import Objective
from rgss.scenes import Robot
from rgss.tasks import Named, Step, TaskProgram
from rgss.trials.code import ENTRIES, versions_of
from rgss.trials.conditions import ConditionInputs, condition_inputs, conditions_from
from rgss.trials.payload_bench import BenchSpec, bench_of
from rgss.trials.pieces.plain_values import to_plain, without
from rgss.trials.pieces.scene_digests import (
    ARM_RATES,
    choice_digest,
    geometry_digest,
    gripper_geometry_digest,
    physics_digest,
    true_values_digest,
)
from rgss.trials.plants import JointController
from rgss.trials.timing_settings import TimingSettings
from rgss.trials.trial_spec import TrialSpec

# Trials of a study share most of their inputs; each digest is computed once.
_KEPT = 512
_JOINED_KEPT = 8192
# Keys of the same trials are asked for by the sweep, the assessment and each what-if.
_SPECS_KEPT = 8192
# Settings of a step that affect its execution.
_EXECUTED = ("reached_rad", "control", "firm_above_n", "firm_s", "opened_m", "near")
# Fields of a wait and of a check that only the execution reads.
_OBSERVED = ("duration_s", "at", "is_upright", "is_at_rest", "held")
# Settings of a move that later pieces read, with their defaults: the timing, and the record.
_LATER: Mapping[str, Any] = MappingProxyType({"speed_share": 1.0, "limit_s": None})


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialDigests:
    """Digests of the inputs of a trial's pieces, each covering those before it.

    Attributes:
        plan: Geometry of the scene, gripper's shape, planner, seed, planning settings.
        timing: The plan, the tool speed and the profile.
        execution: The timing, the gripper, masses and frictions of the scene, physics and control settings, fidelity,
            and the controller of the joints if the fidelity simulates it.
        bench: The gripper, the object, the acceleration and the physics settings; empty if the trial's fidelity has no
        bench.
        trial: The execution, the bench, the planning limit and the draws; the variant's number is not an input.
    """

    plan: str
    timing: str
    execution: str
    bench: str
    trial: str

    def as_mapping(self) -> dict[str, str]:
        """Digests by the name of the piece, without pieces that the trial does not have."""
        named = {"plan": self.plan, "timing": self.timing, "execution": self.execution, "bench": self.bench}
        return {**{name: value for name, value in named.items() if value}, "trial": self.trial}


def digests_of(spec: TrialSpec, versions: Mapping[str, str]) -> TrialDigests:
    """Digests of a trial's pieces.

    Args:
        spec: The trial.
        versions: Versions of the code and the engines, which are inputs too; each piece uses those on which it depends.
    """
    return _digests_of(spec, tuple(sorted(versions.items())))


@lru_cache(maxsize=_SPECS_KEPT)
def _digests_of(spec: TrialSpec, versions: tuple[tuple[str, str], ...]) -> TrialDigests:
    used = _version_digests(versions)
    drawn = _digests_of_conditions(condition_inputs(spec), _frames_of(spec.task), has_inertias=_is_by_work(spec))
    plan = _joined(
        *drawn.planned,
        gripper_geometry_digest(spec.gripper.geometry),
        _digest_of(spec.planned_by),
        _potential_digest(spec),
        spec.seed,
        _task_digest(spec.task),
        _digest_of(spec.settings.planning),
        used["plan"],
    )
    timing = _joined(
        plan,
        drawn.tool_speed_m_s,
        _rates_digest(spec.scene.robot),
        *_stated(spec.settings.timing),
        *_later(spec.task, "speed_share"),
        used["timing"],
    )
    execution = _joined(
        timing,
        *drawn.executed,
        _digest_of(spec.settings.physics),
        _digest_of(spec.settings.control),
        *_controller_digest(spec),
        *_execution_of_steps(spec),
        *_observed(spec.task),
        spec.fidelity.value,
        used["execution"],
    )
    bench = bench_of(spec)
    lifted = "" if bench is None else _bench_digest(bench, used["bench"])
    limits_s = [spec.planning_limit_s, spec.task.time_limit_s, *_later(spec.task, "limit_s")]
    trial = digest([execution, lifted, limits_s, used["record"], [drawn.case, dict(drawn.draws)]])
    return TrialDigests(plan=plan, timing=timing, execution=execution, bench=lifted, trial=trial)


@dataclass(frozen=True, slots=True, kw_only=True)
class _ConditionDigests:
    """Digests of the conditions of a trial, by the pieces that use them.

    Attributes:
        planned: Those of the plan.
        tool_speed_m_s: Greatest tool speed of the timing.
        executed: Those of the execution.
        case: The case of the workload.
        draws: The draws.
    """

    planned: tuple[str, ...]
    tool_speed_m_s: float
    executed: tuple[str, ...]
    case: str
    draws: Mapping[str, float]


# Suppositions about planning and limits leave the conditions of every trial as they are.
@lru_cache(maxsize=_SPECS_KEPT)
def _digests_of_conditions(inputs: ConditionInputs, frames: frozenset[str], *, has_inertias: bool) -> _ConditionDigests:
    conditions = conditions_from(inputs)
    geometry = geometry_digest(conditions.perceived_scene, frames=frames, has_inertias=has_inertias)
    return _ConditionDigests(
        planned=(geometry, *choice_digest(conditions)),
        tool_speed_m_s=conditions.tool_speed_m_s,
        executed=(
            _digest_of(conditions.true_gripper),
            physics_digest(conditions.true_scene),
            true_values_digest(conditions),
        ),
        case=conditions.case,
        draws=conditions.draws,
    )


def bench_digest(spec: BenchSpec, versions: Mapping[str, str]) -> str:
    """Digest of the inputs of a bench, which designs with the same gripper share.

    Args:
        spec: The bench; the name of the gripper's shape is not an input.
        versions: Versions of the code and the engines; only those of a bench are used.
    """
    return _bench_digest(spec, _version_digests(tuple(sorted(versions.items())))["bench"])


def _potential_digest(spec: TrialSpec) -> float:
    """Digest of gravity for a planner that minimises mechanical work; planning does not depend on it otherwise."""
    return spec.scene.gravity_m_s2 if _is_by_work(spec) else 0.0


def _is_by_work(spec: TrialSpec) -> bool:
    """True if the planner minimises mechanical work, for which it reads gravity and the inertias of the links."""
    return spec.planned_by.objective is Objective.MECHANICAL_WORK


def _controller_digest(spec: TrialSpec) -> tuple[str, ...]:
    """Digest of the joint control if the trial simulates it."""
    controller = spec.settings.controller
    simulates_it = spec.fidelity is Fidelity.DYNAMIC or (spec.fidelity is Fidelity.CONTACT and controller.in_contact)
    return _stated(controller) if simulates_it else ()


def _stated(settings: TimingSettings | JointController) -> tuple[str, ...]:
    """Digest of settings that differ from the default; the default is not an input, for the digests of older pieces."""
    return () if settings == type(settings)() else (_digest_of(settings),)


@lru_cache(maxsize=_KEPT)
def _task_digest(task: TaskProgram) -> str:
    """Digest of what planning reads of the steps of a task; its name is not an input."""
    steps = [[type(step).__name__, _planned(step)] for step in task.steps]
    return digest([to_plain(task.start), steps])


def _planned(step: Step) -> dict[str, Any]:
    plain = without(to_plain(step), (*_EXECUTED, *_OBSERVED))
    return {name: _LATER.get(name, value) for name, value in plain.items()}


@lru_cache(maxsize=_KEPT)
def _frames_of(task: TaskProgram) -> frozenset[str]:
    """Named frames to which a task moves."""
    start = () if task.start is None else task.start.mentions
    mentions = (*start, *(mention for step in task.steps for mention in step.mentions))
    return frozenset(one.name for one in mentions if one.kind is Named.FRAME and one.name)


@lru_cache(maxsize=_KEPT)
def _later(task: TaskProgram, setting: str) -> tuple[str, ...]:
    """Digest of a setting of the moves that is no input of their plans; empty if no move states it."""
    stated = [[move.name, value] for move in task.moves if (value := getattr(move, setting)) != _LATER[setting]]
    return (digest(stated),) if stated else ()


@lru_cache(maxsize=_KEPT)
def _observed(task: TaskProgram) -> tuple[str, ...]:
    """Digest of durations of waits and of conditions of checks; empty for a task without either."""
    plain = ((step.name, to_plain(step)) for step in task.steps)
    stated = [[name, {key: one[key] for key in _OBSERVED if key in one}] for name, one in plain]
    return (digest(stated),) if any(values for _, values in stated) else ()


def _execution_of_steps(spec: TrialSpec) -> tuple[str, ...]:
    """Digest of the thresholds and the control of the steps; empty if no step states any."""
    stated = _stated_in_steps(spec.task)
    if not stated:
        return ()
    # In contact the settling limit is an input only if a step states a tolerance of the end of a move.
    return (digest([stated, spec.settings.controller.settling_limit_s]),)


@lru_cache(maxsize=_KEPT)
def _stated_in_steps(task: TaskProgram) -> tuple[tuple[str, str], ...]:
    """Names of the steps with thresholds or control, and their digests."""
    plain = {step.name: to_plain(step) for step in task.steps}
    stated = {name: {key: one[key] for key in _EXECUTED if one.get(key) is not None} for name, one in plain.items()}
    return tuple((name, digest(values)) for name, values in stated.items() if values)


@lru_cache(maxsize=_KEPT)
def _digest_of(value: Any) -> str:
    return digest(to_plain(value))


@lru_cache(maxsize=16)
def _version_digests(versions: tuple[tuple[str, str], ...]) -> Mapping[str, str]:
    """Digest of the versions of each piece."""
    return {piece: digest(versions_of(piece, dict(versions))) for piece in ENTRIES}


@lru_cache(maxsize=_JOINED_KEPT, typed=True)
def _joined(*inputs: str | float) -> str:
    return digest(inputs)


@lru_cache(maxsize=_KEPT)
def _bench_digest(spec: BenchSpec, versions: str) -> str:
    inputs = to_plain(spec)
    del inputs["gripper"]["geometry"]["id"]
    return digest({"bench": inputs, "versions": versions})


@lru_cache(maxsize=_KEPT)
def _rates_digest(robot: Robot) -> str:
    """Digest of the arm's speed and acceleration limits, the further inputs of timing."""
    joints = [[getattr(joint, name) for name in ARM_RATES] for joint in robot.joints]
    return digest([joints, robot.tool_acceleration_m_s2])
