"""Drivers: one program for a simulated and a real arm, behind limits that are checked before anything is sent."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.drivers.driver import Driver, Estimate, GripperState, SetPoint
    from rgss.drivers.limits import Guard, RobotLimits, limits_of
    from rgss.drivers.recording import recording_csv
    from rgss.drivers.rehearsal import Rehearsal, rehearse
    from rgss.drivers.simulated import SimulatedDriver
    from rgss.drivers.stream_clock import MonotonicClock, StreamClock
    from rgss.drivers.streaming import StreamOutcome, StreamResult, StreamSettings, stream
    from rgss.drivers.task import Segment, TimedTask
    from rgss.drivers.ur import UrDriver, UrSettings
    from rgss.drivers.xarm import XarmDriver
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
