"""System identification: excitation, recording, response measures, and the fit of joint servos to a recording."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.identification.calibration import MISFIT, calibration_text
    from rgss.identification.excitation import load_excitation
    from rgss.identification.excitation_document import ExcitationDocument
    from rgss.identification.fitting import FitStatus, ServoFit, fit_joint
    from rgss.identification.motion_of_servos import servo_motion
    from rgss.identification.recording import CommandedPositions, JointSeries, Recording, Segment
    from rgss.identification.recording_file import read_recording, write_recording
    from rgss.identification.response_measures import responses
    from rgss.identification.servo_parameters import parameter_key
    from rgss.identification.simulated_arm import simulated_recording
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
