"""Thresholds of the task program: firm grasp, dropped object, complete release."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ControlSettings:
    """Waiting times and thresholds of the task program.

    Attributes:
        firm_grasp_s: Duration for which every finger must exceed its threshold. Closing causes a force spike whose
        height depends on the step length, so one step is not enough.
        grasp_timeout_s: Timeout of a grasp in addition to the fingers' travel.
        force_window_s: Averaging window of the fingers' forces for the comparison with the load, like a force sensor's
        filter.
        holding_share: Share of the design's finger force of the initial grip.
        tighten_below: Grip margin (friction available over friction needed) below which the commanded force is
        increased.
        tightening_share: Share of the design's finger force added by each increase, up to the full force.
        lost_contact_s: Time without two fingers on the object after which it counts as dropped.
        largest_slip_m: Displacement in the gripper beyond which the object counts as dropped.
        largest_tracking_error_m: Tracking error of the tool beyond which a move fails.
        settled_speed_m_s: Mean speed below which a released object counts as settled.
        settled_s: Averaging time of that speed.
        settling_timeout_s: Timeout of settling.
        displaced_m: Displacement before the grasp beyond which the object counts as displaced.
        observation_rate_hz: Rate at which the pose of a held object is observed; contacts, torques and the tool are
        observed at every step.
        acceleration_window_s: Averaging window of the tool's acceleration, like an accelerometer's filter; differences
        of single steps show the solver's noise.
        grasp_rate_hz: Rate at which the grasp of a carried object is analysed; also at the end of every phase, there
        with the strength (Q_SMW and the load factor), which takes ten times as long.
    """

    firm_grasp_s: float = 0.05
    grasp_timeout_s: float = 0.5
    force_window_s: float = 0.02
    holding_share: float = 0.7
    tighten_below: float = 1.5
    tightening_share: float = 0.1
    lost_contact_s: float = 0.05
    largest_slip_m: float = 0.02
    largest_tracking_error_m: float = 0.002
    settled_speed_m_s: float = 0.002
    settled_s: float = 0.1
    settling_timeout_s: float = 2.0
    displaced_m: float = 0.005
    observation_rate_hz: float = 60.0
    acceleration_window_s: float = 0.02
    grasp_rate_hz: float = 2.0
