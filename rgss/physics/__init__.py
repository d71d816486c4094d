"""Headless rigid-body physics: world, actuation, contacts."""

from rgss.physics.contacts import Contacts, FingerContact
from rgss.physics.hand_view import HandView
from rgss.physics.settings import MOST_ITERATIONS, PhysicsSettings
from rgss.physics.torque_arm import TorqueArm
from rgss.physics.world import World

__all__ = ["MOST_ITERATIONS", "Contacts", "FingerContact", "HandView", "PhysicsSettings", "TorqueArm", "World"]
