"""Multiples of the objects' weights that the hand of a trial bears, with the turning that pads or a lip resist."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from rgss.grasping import load_factor
from rgss.grasping.candidates import contact_points, weight_share
from rgss.scenes import (
    Gripper,
    PadPatch,
    Scene,
    Suction,
    centre_of_mass,
    initial_placements,
    pad_layouts,
    pad_patches,
    scene_about,
    suction_point_of,
    unsealed,
)
from rgss.tasks import HandAction, stages_of
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import cell_of, with_grasp_of


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldLoad:
    """Load that the fingers, or the seal of a cup, bear on an object.

    Attributes:
        object: Its id.
        factor: Greatest multiple of its weight that they bear with their whole force, as it rests.
        needed: Multiple with which a lift at the tool's full acceleration loads them.
        has_cup: True for a suction cup.
    """

    object: str
    factor: float
    needed: float
    has_cup: bool = False

    @property
    def is_borne(self) -> bool:
        """True if the lift leaves the object in place in the hand."""
        return self.factor >= self.needed


def held_loads(spec: TrialSpec) -> Iterator[HeldLoad]:
    """Loads on the hand by the gripped objects of a trial, as its scene states them.

    Objects without a grasp, beside which a finger closes without contact, or on which the cup does not seal, are left
    out.

    Args:
        spec: The trial.
    """
    cell = cell_of(spec)
    scene = with_grasp_of(spec.scene, cell)
    placements = initial_placements(scene)
    needed = 1.0 + scene.robot.tool_acceleration_m_s2 / scene.gravity_m_s2
    stages = stages_of(spec.task, scene.workpiece.id)
    for name in dict.fromkeys(stage.object for stage in stages if stage.step.hand is HandAction.CLOSES):
        factor = None
        if name not in cell.ungrasped:
            factor = _factor(spec, scene_about(scene, name, place="", placements=placements))
        if factor is not None:
            yield HeldLoad(object=name, factor=factor, needed=needed, has_cup=spec.gripper.suction is not None)


def _factor(spec: TrialSpec, view: Scene) -> float | None:
    geometry, workpiece = spec.gripper.geometry, view.workpiece
    if spec.gripper.suction is not None:
        return _of_seal(spec.gripper, spec.gripper.suction, view)
    tool_in_object = workpiece.pose.inverse() @ view.grasp
    patches = pad_patches(workpiece.shape, tool_in_object, geometry)
    if patches is None:
        return None
    layouts = pad_layouts(geometry, workpiece.shape, view.grasp_in_object)
    touching = [_inset(patch, layout.radius_m) for patch, layout in zip(patches, layouts, strict=True)]
    friction = spec.gripper.grip_coefficient(workpiece.friction)
    weight_n = workpiece.mass_kg * view.gravity_m_s2
    x, y, z = workpiece.pose.inverse_rotate((0.0, 0.0, -weight_n))
    return load_factor(
        contact_points(touching, tool_in_object, geometry, friction),
        centre_of_mass(workpiece),
        (x, y, z),
        finger_force_limit_n=spec.gripper.finger_force_n,
    )


def _of_seal(gripper: Gripper, suction: Suction, view: Scene) -> float | None:
    """Multiple that the seal of a cup bears by its axial and tangential forces and at the edge of its lip."""
    workpiece, cup = view.workpiece, gripper.geometry.cup
    if cup is None or unsealed(gripper.geometry, view):
        return None
    ratio_1 = suction.tangential_force_n / gripper.finger_force_n
    share = weight_share(suction_point_of(view), centre_of_mass(workpiece), cup.radius_m, ratio_1)
    held_n = (1.0 - suction.leak) * gripper.finger_force_n
    return share * held_n / (workpiece.mass_kg * view.gravity_m_s2)


def _inset(patch: PadPatch, radius_m: float) -> PadPatch:
    """Patch between the middles of the round elements at its ends, at which the pad touches."""
    return replace(patch, across_m=_within(patch.across_m, radius_m), along_m=_within(patch.along_m, radius_m))


def _within(ends: tuple[float, float], radius_m: float) -> tuple[float, float]:
    low, high = ends
    middle = (low + high) / 2
    return (low + radius_m, high - radius_m) if high - low > 2 * radius_m else (middle, middle)
