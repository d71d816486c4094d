"""What a trial is made of, and the digests of exactly the inputs of each of its pieces.

A trial is cut where its inputs are. The *plan* needs the scene, the gripper's shape, the
planner and the seed; the *timing* needs the plan and the tool speed; the *execution* needs the
timing and the gripper's masses, forces and friction; only the *record* needs the planning
limit. Variants that share a piece's digest share the piece.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any

from rgss.documents.digests import digest
from rgss.evidence import Fidelity
from rgss.scenes import Gripper, Scene
from rgss.trials.settings import TrialSettings


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialSpec:
    """One variant to be tried once.

    Attributes:
        variant: Id of the design variant.
        seed: The trial's seed.
        fidelity: How much physics it has.
        scene: Where it happens.
        gripper: The gripper of the design.
        planner: Name of the planner of the design.
        planning_limit_s: Longest planning time for one move (d9).
        tool_speed_m_s: Greatest tool speed (d7).
        settings: How it is planned and simulated.
    """

    variant: int
    seed: int
    fidelity: Fidelity
    scene: Scene
    gripper: Gripper
    planner: str
    planning_limit_s: float
    tool_speed_m_s: float
    settings: TrialSettings


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialDigests:
    """Digests of the inputs of a trial's pieces, each covering those before it.

    Attributes:
        plan: Scene, gripper's shape, planner, seed, planning settings.
        timing: The plan and the tool speed.
        execution: The timing, the gripper, physics and control settings, fidelity.
        trial: The execution and the planning limit; the variant's number is no input.
    """

    plan: str
    timing: str
    execution: str
    trial: str

    def as_mapping(self) -> dict[str, str]:
        """The digests by the name of the piece."""
        return {"plan": self.plan, "timing": self.timing, "execution": self.execution, "trial": self.trial}


def digests_of(spec: TrialSpec, versions: Mapping[str, str]) -> TrialDigests:
    """The digests of a trial's pieces.

    Args:
        spec: The trial.
        versions: Versions of the code and the engines, which are inputs like any other.
    """
    scene = plain(spec.scene)
    for colourful in (*scene["bodies"], scene["workpiece"]):
        del colourful["colour"]
    plan = digest(
        {
            "scene": scene,
            "geometry": plain(spec.gripper.geometry),
            "planner": spec.planner,
            "seed": spec.seed,
            "settings": plain(spec.settings.planning),
            "versions": dict(versions),
        }
    )
    timing = digest({"plan": plan, "tool_speed_m_s": spec.tool_speed_m_s})
    execution = digest(
        {
            "timing": timing,
            "gripper": plain(spec.gripper),
            "physics": plain(spec.settings.physics),
            "control": plain(spec.settings.control),
            "fidelity": spec.fidelity,
        }
    )
    trial = digest({"execution": execution, "planning_limit_s": spec.planning_limit_s})
    return TrialDigests(plan=plan, timing=timing, execution=execution, trial=trial)


def plain(value: Any) -> Any:
    """A value of frozen dataclasses as plain mappings, lists, texts and numbers."""
    if dataclasses.is_dataclass(value):
        return {f.name: plain(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, (tuple, list)):
        return [plain(item) for item in value]
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    return value
