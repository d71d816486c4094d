"""Servos of a robot's joints, and the calibration file that has them."""

from rgss.scenes.servos.calibration import Calibration
from rgss.scenes.servos.calibration_file import CalibrationDocument, load_calibration
from rgss.scenes.servos.servo import JointServo, ServoControl
