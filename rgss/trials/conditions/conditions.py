"""Conditions of a trial: draws of its seed, true values, and the robot's perception of them.

Planning uses the perceived values, the simulation the true ones, and grip control the nominal properties of the object
that the robot assumes: those of the files, or of the case of the workload.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from types import MappingProxyType

from rgss.errors import DefinitionError
from rgss.scenes import Cylinder, Gripper, Scene, Workpiece, with_raised_stack
from rgss.scenes.uncertainty import Application, Case, UncertainQuantity, draws_of, in_order
from rgss.trials.conditions.inputs import ConditionInputs, condition_inputs
from rgss.trials.conditions.object_conditions import (
    ObjectConditions,
    moved,
    nominal_object,
    perceived_workpiece,
    support_offsets_m,
    true_workpiece,
)
from rgss.trials.trial_spec import TrialSpec

_KEPT = 4096
_NO_DRAWS: Mapping[str, float] = MappingProxyType({})


@dataclass(frozen=True, slots=True, kw_only=True)
class Conditions:
    """Conditions of one trial.

    Uncertain quantities change the fields after `draws`.

    Attributes:
        scene: The scene with the object of the trial's case, with the properties that the robot assumes.
        design_gripper: The gripper of the design.
        case: Id of the case of the workload; empty if there is none.
        draws: The draws by name.
        offset_x_m: True offset of the object from its nominal position along x.
        offset_y_m: The same along y.
        perceived_x_m: Perceived minus true position of the object along x.
        perceived_y_m: The same along y.
        perceived_z_m: The same along z.
        perceived_yaw_rad: Perceived minus true yaw of the object. perceived_roll_rad: Perceived tilt of the object
        about x.
        perceived_pitch_rad: Perceived tilt of the object about y.
        mass_kg: True mass of the object.
        centre_of_mass_m: True height of its centre of mass above the centre of its shape.
        friction: Its true friction coefficient.
        tool_speed_m_s: Largest speed of the tool.
        joint_offsets_rad: True minus reported position of each joint, in m of a sliding one; empty for exact encoders.
        finger_force_n: Force of one finger.
        finger_speed_m_s: Speed of the fingers.
        pad_friction: Friction coefficient of the pads.
        sensor_noise_n: Standard deviation of the noise of a reading of a finger's force.
        sensor_offset_n: Offset of a reading.
        sensor_delay_s: Age of a reading.
        others: Conditions of the further objects with draws.
    """

    scene: Scene
    design_gripper: Gripper
    case: str = ""
    draws: Mapping[str, float] = field(default_factory=lambda: _NO_DRAWS)
    offset_x_m: float = 0.0
    offset_y_m: float = 0.0
    perceived_x_m: float = 0.0
    perceived_y_m: float = 0.0
    perceived_z_m: float = 0.0
    perceived_yaw_rad: float = 0.0
    perceived_roll_rad: float = 0.0
    perceived_pitch_rad: float = 0.0
    mass_kg: float
    centre_of_mass_m: float
    friction: float
    tool_speed_m_s: float
    joint_offsets_rad: tuple[float, ...] = ()
    finger_force_n: float
    finger_speed_m_s: float
    pad_friction: float
    sensor_noise_n: float = 0.0
    sensor_offset_n: float = 0.0
    sensor_delay_s: float = 0.0
    others: tuple[ObjectConditions, ...] = ()

    @property
    def true_scene(self) -> Scene:
        """Scene with true values."""
        return self._with_objects(true_workpiece)

    @property
    def perceived_scene(self) -> Scene:
        """Scene as perceived by the robot: the objects at their perceived poses, all else from the files."""
        return self._with_objects(perceived_workpiece)

    @property
    def true_gripper(self) -> Gripper:
        """Gripper with true values."""
        gripper = replace(
            self.design_gripper,
            finger_force_n=self.finger_force_n,
            finger_velocity_m_s=self.finger_speed_m_s,
            friction=self.pad_friction,
        )
        return self.design_gripper if gripper == self.design_gripper else gripper

    def is_grip_known(self, name: str) -> bool:
        """True if the sensed finger forces and the assumed mass and friction of an object equal the true values."""
        assumed = self.assumed(name)
        true: Conditions | ObjectConditions = next((one for one in self.others if one.id == name), self)
        if name != self.scene.workpiece.id and true is self:
            true = nominal_object(assumed)
        is_sensor_ideal = self.sensor_noise_n == self.sensor_offset_n == self.sensor_delay_s == 0.0
        return is_sensor_ideal and (true.mass_kg, true.friction, self.pad_friction) == (
            assumed.mass_kg,
            assumed.friction,
            self.design_gripper.friction,
        )

    def assumed(self, name: str) -> Workpiece:
        """Object with the properties that the robot assumes."""
        return next(one.workpiece for one in self.scene.objects if one.workpiece.id == name)

    def _with_objects(self, changed: Callable[[Workpiece, Conditions | ObjectConditions], Workpiece]) -> Scene:
        drawn: dict[str, Conditions | ObjectConditions] = {one.id: one for one in self.others}
        drawn[self.scene.workpiece.id] = self
        own_m = {name: (one.offset_x_m, one.offset_y_m) for name, one in drawn.items()}
        beneath_m = support_offsets_m(self.scene, own_m)

        def changed_object(known: Workpiece) -> Workpiece:
            if known.id in beneath_m:
                known = replace(known, pose=moved(known.pose, (*beneath_m[known.id], 0.0)))
            return changed(known, drawn[known.id]) if known.id in drawn else known

        scene = _with_workpiece(self.scene, changed_object(self.scene.workpiece))
        others = tuple(replace(one, workpiece=changed_object(one.workpiece)) for one in scene.others)
        return scene if others == scene.others else replace(scene, others=others)


def conditions_of(spec: TrialSpec) -> Conditions:
    """Conditions of a trial from its seed."""
    return conditions_from(condition_inputs(spec))


def nominal_conditions(spec: TrialSpec) -> Conditions:
    """Nominal conditions of a trial, from the files and its case, without draws."""
    return _nominal(condition_inputs(spec))


@lru_cache(maxsize=_KEPT)
def conditions_from(inputs: ConditionInputs) -> Conditions:
    """Conditions from what they depend on."""
    nominal = _nominal(inputs)
    draws = _draws(inputs) if inputs.uncertainty.values else _NO_DRAWS
    quantities = in_order(inputs.uncertainty.names)
    own = _changes([one for one in quantities if not one.object], draws, nominal)
    drawn = {one.object for one in quantities if one.object}
    others = []
    for known in (one.workpiece for one in inputs.scene.others if one.workpiece.id in drawn):
        before = nominal_object(known)
        changes = _changes([one for one in quantities if one.object == known.id], draws, before)
        others.append(replace(before, **changes))  # type: ignore[arg-type]
    return replace(nominal, draws=draws, others=tuple(others), **own)  # type: ignore[arg-type]


def _draws(inputs: ConditionInputs) -> Mapping[str, float]:
    """Draws of the trial, of the quantities of each joint those of joints of its kind: angles or lengths."""
    joints = inputs.scene.robot.joints
    draws = draws_of(inputs.uncertainty, inputs.seed, joints=len(joints))
    others = {
        name
        for one in in_order(inputs.uncertainty.names)
        if one.joint_kind is not None
        for name, joint in zip(one.draw_names, joints, strict=False)
        if joint.kind is not one.joint_kind
    }
    return MappingProxyType({name: value for name, value in draws.items() if name not in others}) if others else draws


def _nominal(inputs: ConditionInputs) -> Conditions:
    case = inputs.workload.case_of(inputs.seed)
    scene, gripper = _scene_of(inputs.scene, case), inputs.gripper
    return Conditions(
        scene=scene,
        design_gripper=gripper,
        case="" if case is None else case.id,
        mass_kg=scene.workpiece.mass_kg,
        centre_of_mass_m=scene.workpiece.centre_of_mass_m,
        friction=scene.workpiece.friction,
        tool_speed_m_s=inputs.tool_speed_m_s,
        finger_force_n=gripper.finger_force_n,
        finger_speed_m_s=gripper.finger_velocity_m_s,
        pad_friction=gripper.friction,
    )


def _changes(
    quantities: Sequence[UncertainQuantity], draws: Mapping[str, float], nominal: Conditions | ObjectConditions
) -> dict[str, float | tuple[float, ...]]:
    """Values of the fields changed by draws."""
    changes: dict[str, float | tuple[float, ...]] = {}
    for quantity in quantities:
        if quantity.joint_kind is not None:
            joints = 0 if isinstance(nominal, ObjectConditions) else len(nominal.scene.robot.joints)
            drawn = tuple(draws.get(name, 0.0) for name in quantity.draw_names_for(joints))
            before = changes.get(quantity.field)
            # Two quantities of one field have draws of different joints.
            if isinstance(before, tuple):
                drawn = tuple(one or other for one, other in zip(before, drawn, strict=True))
            changes[quantity.field] = drawn
            continue
        present = changes.get(quantity.field, getattr(nominal, quantity.field))
        changes[quantity.field] = _applied(quantity, present, draws[quantity.name])
    return changes


def _applied(quantity: UncertainQuantity, present: float, drawn: float) -> float:
    if quantity.application is Application.REPLACE:
        return drawn
    return present + drawn if quantity.application is Application.ADD else present * drawn


def _scene_of(scene: Scene, case: Case | None) -> Scene:
    if case is None:
        return scene
    own = scene.workpiece
    shape = own.shape
    if isinstance(shape, Cylinder):
        shape = Cylinder(
            radius_m=shape.radius_m if case.radius_m is None else case.radius_m,
            height_m=shape.height_m if case.height_m is None else case.height_m,
        )
    elif case.radius_m is not None or case.height_m is not None:
        raise DefinitionError(
            f"case {case.id!r} of the workload has a radius or a height, but the object is not an upright cylinder",
            hint="vary only mass and friction in the cases of this object",
        )
    # It has the position of the scene's object, with its bottom on the support.
    rise_m = shape.half_height_m - own.shape.half_height_m
    workpiece = replace(
        own,
        shape=shape,
        mass_kg=own.mass_kg if case.mass_kg is None else case.mass_kg,
        friction=own.friction if case.friction is None else case.friction,
        pose=moved(own.pose, (0.0, 0.0, rise_m)),
    )
    return with_raised_stack(_with_workpiece(scene, workpiece), own.id, 2.0 * rise_m)


def _with_workpiece(scene: Scene, workpiece: Workpiece) -> Scene:
    return scene if workpiece == scene.workpiece else replace(scene, workpiece=workpiece)
