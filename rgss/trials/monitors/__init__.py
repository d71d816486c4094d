"""Monitors of a trial: arm, grasp, contact forces, release and phases."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.monitors.arm_monitor import ToolKinematics
    from rgss.trials.monitors.check_conditions import violated_condition
    from rgss.trials.monitors.drag_monitor import DragMonitor
    from rgss.trials.monitors.force_sensor import ForceSensor
    from rgss.trials.monitors.grasp_record import grasp_metrics
    from rgss.trials.monitors.grip_estimate import ForceSensorErrors, GripEstimate
    from rgss.trials.monitors.in_hand_motion import InHandMotionTracker
    from rgss.trials.monitors.observer import StepObserver
    from rgss.trials.monitors.phase_monitor import PhaseMonitor
    from rgss.trials.monitors.release_monitor import LandingMonitor, PlacedObjectMonitor
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
