"""Settable quantity of a trial."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.designs.parameters import ParameterKind


class Application(Enum):
    """Application of a quantity's value to a trial."""

    REPLACE = "replaces the field"
    REQUIRE = "must equal the field"
    ADD_FOR_EACH_FINGER = "is added to the field once for each finger"
    PLANNER_PARAMETER = "is a parameter of the field, which is the planner"
    PLACEMENT = "is a coordinate of the field, which is the pose of the robot's base in the scene"


@dataclass(frozen=True, slots=True, kw_only=True)
class SettableQuantity:
    """Quantity of a trial that a design can set.

    Attributes:
        name: Its name in files, such as ``robot.tool_speed``.
        kind: Kind of its values.
        unit: The SI unit of its values; ``"1"`` for counts and ratios, empty for names.
        meaning: Meaning, in a sentence.
        field: The field of `rgss.trials.pieces.TrialSpec` that it sets, such as ``gripper.finger_mass_kg``.
        application: Application to the field.
        default: File and key of its default value; empty if there is none.
        required: Whether a trial needs a value.
        positive: Whether it must be greater than zero.
        least: The least allowed value, with its unit; empty for none.
        least_reason: Reason why smaller values are rejected.
        greatest: The greatest allowed value, with its unit; empty for none.
        greatest_reason: Reason why greater values are rejected.
        choices: The allowed names; empty if they are checked elsewhere.
    """

    name: str
    kind: ParameterKind = ParameterKind.QUANTITY
    unit: str
    meaning: str
    field: str
    application: Application = Application.REPLACE
    default: str = ""
    required: bool = True
    positive: bool = True
    least: str = ""
    least_reason: str = ""
    greatest: str = ""
    greatest_reason: str = ""
    choices: tuple[str, ...] = ()
