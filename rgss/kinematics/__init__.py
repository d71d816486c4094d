"""Kinematics of the arm: forward and inverse, Jacobians, dynamics, and freedom from collision."""

from rgss.kinematics.arm import Arm
from rgss.kinematics.branches import choose_branches
from rgss.kinematics.cartesian import straight_line
from rgss.kinematics.collision import CollisionModel
from rgss.kinematics.inverse import InverseKinematics
from rgss.kinematics.situation import Situation

__all__ = ["Arm", "CollisionModel", "InverseKinematics", "Situation", "choose_branches", "straight_line"]
