"""Thresholds of the task's control: when a grasp is firm, an object dropped, a release complete."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ControlSettings:
    """Waiting times and thresholds of the task program.

    Attributes:
        firm_grasp_s: Time for which every finger must hold above its threshold. Closing gives
            a spike whose height depends on the step length, so one step is not enough.
        grasp_timeout_s: Time beyond the fingers' travel after which a grasp has failed.
        force_window_s: Time over which the fingers' forces are averaged before they are compared with the load, as a
            force sensor's filter does.
        holding_share: Share of the design's finger force with which an object is first held.
        tighten_below: Grip margin (friction available over friction needed) below which the
            fingers are commanded to close further.
        tightening_share: Share of the design's finger force that each such command adds, up to
            the whole.
        lost_contact_s: Time without two fingers on the object after which it counts as dropped.
        largest_slip_m: Displacement in the gripper beyond which the object counts as dropped.
        largest_tracking_error_m: Distance of the tool from its commanded position beyond which
            a move has failed.
        settled_speed_m_s: Mean speed below which a released object counts as standing.
        settled_s: Time over which that is the mean.
        settling_timeout_s: Longest wait for it.
        displaced_m: Displacement before the grasp beyond which the object was knocked.
        observation_rate_hz: Rate at which the pose of a held object is observed; contacts, torques and
            the tool are read at every step.
        acceleration_window_s: Time over which the tool's acceleration is averaged, as an
            accelerometer's filter does; from one step to the next it shows the solver's noise.
        grasp_rate_hz: Rate at which the grasp of a carried object is analysed; also at the end of
            every phase, and there with what the grasp resists (Q_SMW and the load), which takes ten
            times as long.
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
