"""Kinematics of the arm: forward and inverse kinematics, Jacobians, dynamics and collision checking."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.kinematics.arm import Arm
    from rgss.kinematics.branches import choose_branches
    from rgss.kinematics.cartesian import LineBreak, follow_line, straight_line
    from rgss.kinematics.closing_contact import CLOSING_ROOM_M, ClosingLinks
    from rgss.kinematics.collision import CollisionModel, NearestPair
    from rgss.kinematics.collision_context import CollisionContext
    from rgss.kinematics.differential_inverse import DifferentialInverse
    from rgss.kinematics.dynamics import ArmDynamics, Load, gripper_loads, workpiece_load
    from rgss.kinematics.inverse import InverseKinematics, inverse_kinematics
    from rgss.kinematics.link_contacts import lasting_contacts, touching_links
    from rgss.kinematics.overlap_search import Overlap, Solid, overlaps
    from rgss.kinematics.position_gap import position_gap_m
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
