"""Kinematics of the arm: forward and inverse, Jacobians, dynamics, and freedom from collision."""

from rgss.kinematics.arm import Arm
from rgss.kinematics.branches import choose_branches
from rgss.kinematics.cartesian import straight_line
from rgss.kinematics.collision import CollisionModel, NearestPair
from rgss.kinematics.dynamics import ArmDynamics, Load, gripper_loads, workpiece_load
from rgss.kinematics.inverse import InverseKinematics
from rgss.kinematics.overlaps import Overlap, Solid, overlaps
from rgss.kinematics.situation import Situation

__all__ = [
    "Arm",
    "ArmDynamics",
    "CollisionModel",
    "InverseKinematics",
    "Load",
    "NearestPair",
    "Overlap",
    "Situation",
    "Solid",
    "choose_branches",
    "gripper_loads",
    "overlaps",
    "straight_line",
    "workpiece_load",
]
