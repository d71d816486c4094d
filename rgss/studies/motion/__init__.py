"""The sections ``timing`` and ``control`` of a study, and steps of its task that set the gripper's drive."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.motion.calibrated import calibrated_at, motion_findings
    from rgss.studies.motion.neutral_steps import neutral_findings
    from rgss.studies.motion.physics import PadCompliance, PhysicsEntry, pads_of, physics_findings
    from rgss.studies.motion.section import (
        ControlEntry,
        MotionChoice,
        TimingEntry,
        read_motion,
    )
    from rgss.studies.motion.step_control import step_control_findings
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
