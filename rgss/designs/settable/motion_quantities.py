"""Settable quantities of timing and joint control."""

from __future__ import annotations

from rgss.designs.parameters import ParameterKind
from rgss.designs.settable.quantity import SettableQuantity

_SHARE = "a share of the joint's limit"

MOTION_QUANTITIES = (
    SettableQuantity(
        name="timing.profile",
        kind=ParameterKind.NAME,
        unit="",
        meaning="Velocity profile of the moves: time_optimal, trapezoid or joint_waypoints.",
        field="settings.timing.profile",
        default="timing.profile in the study",
        required=False,
        choices=("time_optimal", "trapezoid", "joint_waypoints"),
    ),
    SettableQuantity(
        name="timing.peak_speed",
        unit="1",
        meaning="Share of each joint's speed limit that moves use.",
        field="settings.timing.peak_speed",
        default="timing.peak_speed in the study",
        required=False,
        greatest="1",
        greatest_reason=_SHARE,
    ),
    SettableQuantity(
        name="timing.peak_acceleration",
        unit="1",
        meaning="Share of each joint's acceleration limit that moves use.",
        field="settings.timing.peak_acceleration",
        default="timing.peak_acceleration in the study",
        required=False,
        greatest="1",
        greatest_reason=_SHARE,
    ),
    SettableQuantity(
        name="control.mode",
        kind=ParameterKind.NAME,
        unit="",
        meaning="Control of the joints at dynamic fidelity, one of the modes of docs/motion.md.",
        field="settings.controller.mode",
        default="control.mode in the study",
        required=False,
        choices=("position", "velocity", "computed_torque", "calibrated", "tool_tracking"),
    ),
    SettableQuantity(
        name="control.natural_frequency",
        unit="rad/s",
        meaning="Natural frequency of the joints' error in the modes position and computed_torque.",
        field="settings.controller.natural_frequency_rad_s",
        default="control.natural_frequency in the study",
        required=False,
    ),
    SettableQuantity(
        name="control.damping_ratio",
        unit="1",
        meaning="Damping ratio of the joints' error in the modes position and computed_torque.",
        field="settings.controller.damping_ratio",
        default="control.damping_ratio in the study",
        required=False,
    ),
    SettableQuantity(
        name="control.position_gain",
        unit="rad/s",
        meaning="Position gain of the mode velocity: added velocity per joint position error.",
        field="settings.controller.position_gain_1_s",
        default="control.position_gain in the study",
        required=False,
        positive=False,
        least="0 rad/s",
        least_reason="0 rad/s is velocity control without position feedback",
    ),
    SettableQuantity(
        name="control.velocity_gain",
        unit="rad/s",
        meaning="Velocity gain of the mode velocity: commanded acceleration per joint velocity error.",
        field="settings.controller.velocity_gain_1_s",
        default="control.velocity_gain in the study",
        required=False,
    ),
)
"""The quantities, in the order in which they are applied."""
