"""Servo models of a robot's joints, and calibration files."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.servos.calibration import Calibration
    from rgss.scenes.servos.calibration_file import CalibrationDocument, load_calibration
    from rgss.scenes.servos.servo import JointServo, ServoControl
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
