"""Registry of the uncertain quantities.

A new quantity is one entry here: reader, schemas, draws, data frames and docs/uncertainty.md use this table. An entry
names the field of `rgss.trials.conditions.Conditions` that it changes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

from rgss.scenes.joints import JointKind
from rgss.scenes.robot import MOST_JOINTS


class Application(Enum):
    """Effect of a draw on the field of a trial's conditions."""

    REPLACE = "replaces it"
    ADD = "is added to it"
    SCALE = "multiplies it"


class EntersAt(str, Enum):
    """First piece of a trial that depends on a draw; later pieces depend on it through that piece."""

    PLAN = "plan"
    TIMING = "timing"
    EXECUTION = "execution"


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertainQuantity:
    """Quantity that may be uncertain.

    Attributes:
        name: Its name in files, such as ``perception.x``.
        unit: The SI unit of its draws; ``"1"`` for factors and coefficients.
        meaning: Its definition, in a sentence.
        field: The field of the conditions that it changes.
        application: Effect of a draw on the field.
        enters: The first piece of a trial that depends on it.
        least: The least value that a draw may have.
        is_least_allowed: Whether the least value itself may be drawn.
        joint_kind: Kind of the joints of which each has an independent draw; None for one draw.
        object: Id of its further object; empty for the first object and the machine.
    """

    name: str
    unit: str
    meaning: str
    field: str
    application: Application
    enters: EntersAt
    least: float = -math.inf
    is_least_allowed: bool = True
    joint_kind: JointKind | None = None
    object: str = ""

    @property
    def draw_names(self) -> tuple[str, ...]:
        """Names of its draws: its name, or its name with the number of each joint, from 1."""
        if self.joint_kind is None:
            return (self.name,)
        return tuple(f"{self.name}.{index}" for index in range(1, MOST_JOINTS + 1))

    def draw_names_for(self, joints: int) -> tuple[str, ...]:
        """Names of its draws for an arm."""
        return self.draw_names if self.joint_kind is None else self.draw_names[:joints]

    def is_possible(self, value: float) -> bool:
        """True if a value is in the admissible range."""
        return value > self.least or (self.is_least_allowed and value == self.least)


def _deviation(name: str, unit: str, field: str, meaning: str) -> UncertainQuantity:
    return UncertainQuantity(
        name=name, unit=unit, field=field, meaning=meaning, application=Application.ADD, enters=EntersAt.PLAN
    )


def _of_execution(
    name: str, unit: str, field: str, meaning: str, application: Application, *, least: float = 0.0, zero: bool = True
) -> UncertainQuantity:
    return UncertainQuantity(
        name=name,
        unit=unit,
        field=field,
        meaning=meaning,
        application=application,
        enters=EntersAt.EXECUTION,
        least=least,
        is_least_allowed=zero,
    )


_REPLACE, _SCALE = Application.REPLACE, Application.SCALE

_ALL = (
    _deviation("workpiece.x", "m", "offset_x_m", "Offset of the object from its place along the world's x."),
    _deviation("workpiece.y", "m", "offset_y_m", "Offset of the object from its place along the world's y."),
    _of_execution("workpiece.mass", "kg", "mass_kg", "Mass of the object.", _REPLACE, zero=False),
    _of_execution(
        "workpiece.mass_factor", "1", "mass_kg", "Mass of the object divided by its stated mass.", _SCALE, zero=False
    ),
    _of_execution(
        "workpiece.centre_of_mass",
        "m",
        "centre_of_mass_m",
        "Height of the object's centre of mass above the centre of its shape.",
        _REPLACE,
        least=-math.inf,
    ),
    _of_execution(
        "workpiece.friction",
        "1",
        "friction",
        "Friction coefficient of the object; that of a contact is the product with the other body's.",
        _REPLACE,
        zero=False,
    ),
    _deviation(
        "perception.x", "m", "perceived_x_m", "Perceived minus true position of the object along the world's x."
    ),
    _deviation(
        "perception.y", "m", "perceived_y_m", "Perceived minus true position of the object along the world's y."
    ),
    _deviation("perception.z", "m", "perceived_z_m", "Perceived minus true height of the object."),
    _deviation("perception.yaw", "rad", "perceived_yaw_rad", "Perceived minus true yaw of the object."),
    _deviation(
        "perception.roll", "rad", "perceived_roll_rad", "Perceived tilt of the upright object about the world's x."
    ),
    _deviation(
        "perception.pitch", "rad", "perceived_pitch_rad", "Perceived tilt of the upright object about the world's y."
    ),
    UncertainQuantity(
        name="robot.tool_speed",
        unit="1",
        meaning="Speed limit of the tool centre divided by that of the design.",
        field="tool_speed_m_s",
        application=_SCALE,
        enters=EntersAt.TIMING,
        least=0.0,
        is_least_allowed=False,
    ),
    UncertainQuantity(
        name="robot.joint_offset",
        unit="rad",
        meaning="True minus reported angle of a joint: the zero error of its encoder, drawn for each turning joint.",
        field="joint_offsets_rad",
        application=Application.ADD,
        enters=EntersAt.EXECUTION,
        joint_kind=JointKind.REVOLUTE,
    ),
    UncertainQuantity(
        name="robot.slide_offset",
        unit="m",
        meaning="True minus reported position of a sliding joint: the zero error of its scale, drawn for each of them.",
        field="joint_offsets_rad",
        application=Application.ADD,
        enters=EntersAt.EXECUTION,
        joint_kind=JointKind.PRISMATIC,
    ),
    _of_execution(
        "gripper.finger.force",
        "1",
        "finger_force_n",
        "Force of the fingers divided by that of the design.",
        _SCALE,
        zero=False,
    ),
    _of_execution(
        "gripper.finger.speed",
        "1",
        "finger_speed_m_s",
        "Speed of the fingers divided by that of the design.",
        _SCALE,
        zero=False,
    ),
    _of_execution(
        "gripper.finger.friction",
        "1",
        "pad_friction",
        "Friction coefficient of the pads divided by that of the design.",
        _SCALE,
        zero=False,
    ),
    _of_execution(
        "gripper.force_sensor.noise",
        "N",
        "sensor_noise_n",
        "Standard deviation of the white noise in each reading of a finger's normal force.",
        _REPLACE,
    ),
    _of_execution(
        "gripper.force_sensor.offset",
        "N",
        "sensor_offset_n",
        "Offset of every reading of a finger's normal force.",
        _REPLACE,
        least=-math.inf,
    ),
    _of_execution(
        "gripper.force_sensor.delay", "s", "sensor_delay_s", "Age of a reading of a finger's normal force.", _REPLACE
    ),
)

QUANTITIES: Mapping[str, UncertainQuantity] = MappingProxyType({one.name: one for one in _ALL})
"""The quantities by name, in the order in which they are applied."""
