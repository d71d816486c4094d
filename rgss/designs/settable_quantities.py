"""Registry of the settable quantities of a trial.

A design parameter, or a property of a component's role, names one of them under ``sets``. A quantity that no design
sets has the value of the robot file, the gripper file or the study. A new quantity is one entry here: schemas,
findings, filters and docs/designs.md use this table.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any

from pydantic import PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from rgss.designs.findings import near_hint
from rgss.designs.parameters import ParameterKind
from rgss.designs.settable import (
    MOTION_QUANTITIES,
    PLACEMENT_QUANTITIES,
    PLANNER_PREFIX,
    PLANNER_QUANTITIES,
    Application,
    SettableQuantity,
)
from rgss.findings import shown

CATALOGUE_PREFIX = "catalogue."
"""``sets: catalogue.<role>`` selects the component of a role by its id."""


_TOO_SLOW = "a slower arm or hand would take hours for the task"

_QUANTITIES = (
    SettableQuantity(
        name="robot.tool_speed",
        unit="m/s",
        meaning="Largest speed of the tool centre.",
        field="tool_speed_m_s",
        default="tool_speed in the robot file",
        least="1 mm/s",
        least_reason=_TOO_SLOW,
    ),
    SettableQuantity(
        name="robot.tool_acceleration",
        unit="m/s**2",
        meaning="Largest acceleration of the tool centre.",
        field="scene.robot.tool_acceleration_m_s2",
        default="tool_acceleration in the robot file",
        required=False,
    ),
    *PLACEMENT_QUANTITIES,
    SettableQuantity(
        name="gripper.fingers",
        kind=ParameterKind.COUNT,
        unit="1",
        meaning="Number of fingers; the gripper file of the design's gripper must have as many azimuths.",
        field="gripper.geometry.fingers",
        application=Application.REQUIRE,
        default="azimuths in the gripper file",
        required=False,
    ),
    SettableQuantity(
        name="gripper.mounting",
        kind=ParameterKind.NAME,
        unit="",
        meaning="Mounting of the fingers, one of those in the gripper file.",
        field="gripper.geometry.mounting",
        default="mounting in the gripper file",
        required=False,
    ),
    SettableQuantity(
        name="gripper.base.mass",
        unit="kg",
        meaning="Mass of the gripper without its fingers and their actuators.",
        field="gripper.base_mass_kg",
        default="base.mass in the gripper file",
    ),
    SettableQuantity(
        name="gripper.finger.mass",
        unit="kg",
        meaning="Mass of one finger.",
        field="gripper.finger_mass_kg",
        default="finger.mass in the gripper file",
    ),
    SettableQuantity(
        name="gripper.finger.speed",
        unit="m/s",
        meaning="Largest speed of a finger along its travel.",
        field="gripper.finger_velocity_m_s",
        default="finger.speed in the gripper file",
        least="1 mm/s",
        least_reason=_TOO_SLOW,
    ),
    SettableQuantity(
        name="gripper.finger.force",
        unit="N",
        meaning="Largest force of one finger.",
        field="gripper.finger_force_n",
        default="finger.force in the gripper file",
    ),
    SettableQuantity(
        name="gripper.finger.friction",
        unit="1",
        meaning="Friction coefficient of a finger's pad; that of the grasp is the product with the object's.",
        field="gripper.friction",
        default="finger.friction in the gripper file",
    ),
    SettableQuantity(
        name="gripper.actuator.mass",
        unit="kg",
        meaning="Mass of the actuator of one finger, which the base carries.",
        field="gripper.base_mass_kg",
        application=Application.ADD_FOR_EACH_FINGER,
        default="0 kg",
        required=False,
        positive=False,
        least="0 kg",
        least_reason="0 kg is an actuator that the base's mass contains",
    ),
    SettableQuantity(
        name="planning.planner",
        kind=ParameterKind.NAME,
        unit="",
        meaning="Algorithm that plans the moves.",
        field="planner",
        default="planning.planner in the study",
    ),
    SettableQuantity(
        name="planning.time_limit",
        unit="s",
        meaning="Longest planning time of one move, by the planning clock.",
        field="planning_limit_s",
        default="planning.time_limit in the study",
    ),
    SettableQuantity(
        name="planning.simplification_limit",
        unit="s",
        meaning="Longest time of simplifying a path, by the planning clock.",
        field="settings.planning.simplification_limit_s",
        default="planning.simplification_limit in the study",
        required=False,
        positive=False,
        least="0 s",
        least_reason="0 s leaves paths as found",
    ),
    SettableQuantity(
        name="planning.simplification_checks",
        kind=ParameterKind.COUNT,
        unit="1",
        meaning="Budget of validity checks of the search for shortcuts.",
        field="settings.planning.simplification_checks",
        default="planning.simplification_checks in the study",
        required=False,
        positive=False,
    ),
    *MOTION_QUANTITIES,
)

SETTABLE_QUANTITIES: Mapping[str, SettableQuantity] = MappingProxyType({one.name: one for one in _QUANTITIES})
"""The quantities by name, in the order in which they are applied."""


def settable_quantity(name: str) -> SettableQuantity | None:
    """Settable quantity by name, including parameters of planners; None if unknown."""
    return SETTABLE_QUANTITIES.get(name) or PLANNER_QUANTITIES.get(name)


def _read_settable(value: Any) -> str:
    if isinstance(value, str) and (settable_quantity(value) is not None or value.startswith(CATALOGUE_PREFIX)):
        return value
    if str(value).startswith(PLANNER_PREFIX):
        hint = near_hint(str(value), PLANNER_QUANTITIES, "parameters of planners")
    else:
        known = [*SETTABLE_QUANTITIES, f"{CATALOGUE_PREFIX}<role>", f"{PLANNER_PREFIX}<parameter>"]
        hint = near_hint(str(value), known, "quantities that can be set")
    details = {"message": f"unknown quantity {shown(str(value))}", "hint": hint}
    raise PydanticCustomError("quantity", "{message}", details)


SettableField = Annotated[
    str,
    PlainValidator(_read_settable),
    WithJsonSchema(
        {
            "anyOf": [
                {
                    "enum": [*SETTABLE_QUANTITIES, *PLANNER_QUANTITIES],
                    "enumDescriptions": [
                        one.meaning for one in (*SETTABLE_QUANTITIES.values(), *PLANNER_QUANTITIES.values())
                    ],
                },
                {"type": "string", "pattern": r"^catalogue\..+$"},
            ]
        }
    ),
]
"""The name of a settable quantity, or ``catalogue.<role>``."""
