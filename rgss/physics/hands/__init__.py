"""Hands in contact physics: drive of a linkage, joints of fingers, and the force that the solver passes."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.physics.hands.finger_joints import finger_joint_names, finger_joint_positions
    from rgss.physics.hands.force_passing import light_fingers, light_object, passing_mass_kg
    from rgss.physics.hands.linkage_drive import LinkageDrive, least_iterations
    from rgss.physics.hands.linkage_motor import motor_command
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
