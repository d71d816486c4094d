"""Headless rigid-body physics: world, actuation, contacts."""

from rgss.physics.contacts import Contacts
from rgss.physics.settings import PhysicsSettings
from rgss.physics.world import World

__all__ = ["Contacts", "PhysicsSettings", "World"]
