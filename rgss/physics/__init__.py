"""Headless rigid-body simulation: worlds, actuation, contacts, rendering."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.physics.contact_world import ContactWorld
    from rgss.physics.contacts import Contacts, FingerContact, RobotContact
    from rgss.physics.hand_view import HandView
    from rgss.physics.hands import least_iterations, light_fingers, light_object, passing_mass_kg
    from rgss.physics.opening import OtherEngineSettings, open_world
    from rgss.physics.pictures import VIEWS, Camera, Picture, View
    from rgss.physics.servo_loop import VelocityLoop, mean_commands
    from rgss.physics.settings import LEAST_ITERATIONS_HZ, LEAST_RATE_HZ, MOST_ITERATIONS, PhysicsSettings
    from rgss.physics.shape_surfaces import object_surfaces
    from rgss.physics.stage import Posture, SeenSolid, Stage
    from rgss.physics.suction_seal import seal_margin
    from rgss.physics.torque_arm import TorqueArm
    from rgss.physics.world import World
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
