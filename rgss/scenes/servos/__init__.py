"""Servo models of a robot's joints, and calibration files."""

from rgss.scenes.servos.calibration import Calibration
from rgss.scenes.servos.calibration_file import CalibrationDocument, load_calibration
from rgss.scenes.servos.servo import JointServo, ServoControl
