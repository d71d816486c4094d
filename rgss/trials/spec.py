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
from functools import lru_cache
from typing import Any

from rgss.documents.digests import digest
from rgss.evidence import Fidelity
from rgss.scenes import Gripper, Scene, Shape
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
        plan: Geometry of the scene, gripper's shape, planner, seed, planning settings.
        timing: The plan and the tool speed.
        execution: The timing, the gripper, masses and frictions of the scene, physics and control
            settings, fidelity.
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
    plan = digest(
        {
            "scene": _geometry_digest(spec.scene),
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
            "scene": _matter_of(spec.scene),
            "physics": plain(spec.settings.physics),
            "control": plain(spec.settings.control),
            "fidelity": spec.fidelity,
        }
    )
    trial = digest({"execution": execution, "planning_limit_s": spec.planning_limit_s})
    return TrialDigests(plan=plan, timing=timing, execution=execution, trial=trial)


@lru_cache(maxsize=64)
def _geometry_digest(scene: Scene) -> str:
    """Digest of what planning and timing need of a scene: where everything is, and how the arm may move."""
    geometry = {
        "robot": plain(scene.robot),
        "bodies": [{"id": body.id, "shape": _shape(body.shape), "pose": plain(body.pose)} for body in scene.bodies],
        "workpiece": {
            "id": scene.workpiece.id,
            "shape": _shape(scene.workpiece.shape),
            "pose": plain(scene.workpiece.pose),
        },
        "supports": [scene.support, scene.place_support],
        "place": plain(scene.place.centre_m),
        "task": plain(scene.task),
    }
    return digest(geometry)


def _matter_of(scene: Scene) -> dict[str, Any]:
    """What only the physics needs of a scene; colours are nobody's input."""
    workpiece = scene.workpiece
    return {
        "id": scene.id,
        "gravity_m_s2": scene.gravity_m_s2,
        "frictions": [body.friction for body in scene.bodies],
        "workpiece": [workpiece.mass_kg, workpiece.friction, workpiece.force_limit_n],
        "place": [scene.place.radius_m, scene.place.largest_tilt_rad],
    }


def _shape(shape: Shape) -> dict[str, Any]:
    return {"kind": type(shape).__name__, **plain(shape)}


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
