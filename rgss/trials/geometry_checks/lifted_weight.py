"""Multiples of the objects' weights that the hand of a trial bears, with the turning that pads or a lip resist."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from rgss.grasping import load_factor
from rgss.grasping.candidates import contact_points, weight_share
from rgss.physics import seal_margin
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
from rgss.trials.hands import hand_of
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import cell_of, with_grasp_of

_LINES = 8
# A load factor below this share of that of friction alone is due to the torque of the weight.
_TURNED = 0.95


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldLoad:
    """Load that the fingers, or the seal of a cup, bear on an object.

    Attributes:
        object: Its id.
        factor: Greatest multiple of its weight that they bear with their whole force, as it rests.
        needed: Multiple with which a lift at the tool's full acceleration loads them.
        has_cup: True for a suction cup.
        first_1: Share of the whole force with which the hand lifts an object that turns in it, before it tightens; 1 if
            the weight does not turn the object, or the hand does not tighten.
        aside_1: Factor by which the load of a move aside at the tool's full acceleration could grow before it breaks
            the seal of a cup; infinite for fingers.
    """

    object: str
    factor: float
    needed: float
    has_cup: bool = False
    first_1: float = 1.0
    aside_1: float = math.inf

    @property
    def is_borne(self) -> bool:
        """True if the lift leaves the object in place in the hand."""
        return self.factor >= self.needed

    @property
    def is_borne_at_first(self) -> bool:
        """True if the force with which the lift begins leaves the object in place too."""
        return self.first_load >= self.needed

    @property
    def first_load(self) -> float:
        """Greatest multiple of the object's weight that the hand bears as the lift begins."""
        return self.first_1 * self.factor

    @property
    def is_carried(self) -> bool:
        """True if a move aside leaves the object on the cup."""
        return self.aside_1 >= 1.0


def held_loads(spec: TrialSpec) -> Iterator[HeldLoad]:
    """Loads on the hand by the gripped objects of a trial, as its scene states them.

    Objects without a grasp, beside which a finger closes without contact, or on which the cup does not seal, are left
    out.
    """
    cell = cell_of(spec)
    scene = with_grasp_of(spec.scene, cell)
    placements = initial_placements(scene)
    needed = 1.0 + scene.robot.tool_acceleration_m_s2 / scene.gravity_m_s2
    stages = stages_of(spec.task, scene.workpiece.id)
    for name in dict.fromkeys(stage.object for stage in stages if stage.step.hand is HandAction.CLOSES):
        if name in cell.ungrasped:
            continue
        view = scene_about(scene, name, place="", placements=placements)
        load = HeldLoad(object=name, factor=math.inf, needed=needed)
        if spec.gripper.suction is not None:
            if not unsealed(spec.gripper.geometry, view):
                yield _on_cup(load, spec.gripper, spec.gripper.suction, view)
        elif (factor := _factor(spec, view)) is not None:
            yield replace(load, factor=factor, first_1=_first_share(spec, view, factor))


def _factor(spec: TrialSpec, view: Scene) -> float | None:
    geometry, workpiece = spec.gripper.geometry, view.workpiece
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


def _first_share(spec: TrialSpec, view: Scene, factor: float) -> float:
    """Share of the whole force after the grip, which tightens until friction bears the weight without its torque."""
    gripper, control = spec.gripper, spec.settings.control
    friction_n = gripper.grip_coefficient(view.workpiece.friction) * gripper.finger_force_n * gripper.geometry.fingers
    by_friction = friction_n / (view.workpiece.mass_kg * view.gravity_m_s2)
    if not hand_of(gripper).has_force_feedback or factor > _TURNED * by_friction:
        return 1.0
    share = control.holding_share
    while share * by_friction < 1.0 and share < 1.0:
        share = min(1.0, share + control.tightening_share)
    return share


def _on_cup(load: HeldLoad, gripper: Gripper, suction: Suction, view: Scene) -> HeldLoad:
    """Load that the seal of a cup bears by its axial and tangential forces and at the edge of its lip."""
    workpiece, cup = view.workpiece, gripper.geometry.cup
    radius_m = 0.0 if cup is None else cup.radius_m
    ratio_1 = suction.tangential_force_n / gripper.finger_force_n
    share = weight_share(suction_point_of(view), centre_of_mass(workpiece), radius_m, ratio_1)
    held_n = (1.0 - suction.leak) * gripper.finger_force_n
    return replace(
        load,
        factor=share * held_n / (workpiece.mass_kg * view.gravity_m_s2),
        has_cup=True,
        aside_1=_aside(view, radius_m, held_n, ratio_1 * held_n),
    )


def _aside(view: Scene, radius_m: float, held_n: float, across_n: float) -> float:
    """Margin of a seal while the tool accelerates and brakes along a horizontal line, on the best of some lines."""
    workpiece, point = view.workpiece, suction_point_of(view)
    gravity, most = view.gravity_m_s2, view.robot.tool_acceleration_m_s2
    normal = np.array(point.normal)
    arm_m = np.array(centre_of_mass(workpiece)) - np.array(point.position_m)

    def margin(x: float, y: float) -> float:
        force_n = workpiece.mass_kg * np.array(workpiece.pose.inverse_rotate((-most * x, -most * y, -gravity)))
        moment = np.cross(arm_m, force_n)
        tension_n = -float(force_n @ normal)
        bending_n_m = float(np.linalg.norm(moment - (moment @ normal) * normal))
        found = seal_margin(
            held_n,
            across_n,
            lifting_n=tension_n + bending_n_m / radius_m,
            tangential_n=float(np.linalg.norm(force_n + tension_n * normal)),
        )
        return math.inf if found is None else found

    turns = (math.pi * turn / _LINES for turn in range(_LINES))
    lines = ((math.cos(turn), math.sin(turn)) for turn in turns)
    return max(min(margin(x, y), margin(-x, -y)) for x, y in lines)


def _inset(patch: PadPatch, radius_m: float) -> PadPatch:
    """Patch between the middles of the round elements at its ends, at which the pad touches."""
    return replace(patch, across_m=_within(patch.across_m, radius_m), along_m=_within(patch.along_m, radius_m))


def _within(ends: tuple[float, float], radius_m: float) -> tuple[float, float]:
    low, high = ends
    middle = (low + high) / 2
    return (low + radius_m, high - radius_m) if high - low > 2 * radius_m else (middle, middle)
