"""A script: grasp and lift the cup, and print a digest of every state on the way, bit for bit."""

import hashlib
import struct
from pathlib import Path

import numpy as np

from rgss.kinematics import Arm, inverse_kinematics
from rgss.physics import PhysicsSettings, World
from rgss.scenes import Gripper, load_gripper, load_scene

STEPS = 500
SCENES = Path(__file__).parents[2] / "scenes"


def digest(fingers: int) -> str:
    scene = load_scene(SCENES / "restaurant.yaml")
    geometry = load_gripper(SCENES / f"grippers/kg-{fingers}.yaml")
    gripper = Gripper(
        geometry=geometry,
        base_mass_kg=0.4,
        finger_mass_kg=0.3,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )
    inverse = inverse_kinematics(Arm(scene.robot, geometry.grasp_centre))
    down = inverse.nearest(scene.grasp, scene.robot.home_rad)
    up = inverse.nearest(scene.grasp.raised(0.1), down)
    content = hashlib.sha256()
    with World(scene, gripper, PhysicsSettings()) as world:
        world.reset_arm(down.tolist())
        world.drive_fingers(0.04, 10.0)
        for step in range(STEPS):
            share = np.clip((step - 230) / 200, 0.0, 1.0)
            target = down + (up - down) * share**2 * (3 - 2 * share)
            world.command_arm(target.tolist(), [0.0] * 6)
            world.step()
            pose, contacts = world.workpiece_pose(), world.contacts()
            state = (
                *(value for values in world.arm_state() for value in values),
                *world.finger_travel_m(),
                *pose.position_m,
                *pose.quaternion_xyzw,
                *contacts.finger_forces_n,
                *contacts.friction_n,
            )
            content.update(struct.pack(f"{len(state)}d", *state))
            content.update(repr((contacts.robot_bodies, contacts.workpiece_bodies)).encode())
        if not world.contacts().fingers_touching or world.contacts().workpiece_bodies:
            raise SystemExit("the cup should be held in the air")
    return content.hexdigest()


if __name__ == "__main__":
    print(digest(2), digest(3))  # noqa: T201
