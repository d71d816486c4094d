"""The shipped scene with each gripper, and arm configurations that reach the cup without collision."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rgss.kinematics import Arm, CollisionContext, CollisionModel, InverseKinematics, inverse_kinematics
from rgss.physics import PhysicsSettings, World
from rgss.scenes import Gripper, Pose, Scene, load_gripper, load_scene

Array = NDArray[np.float64]

SCENES = Path(__file__).parents[2] / "scenes"
STILL = (0.0,) * 6


def smooth(fraction: Array) -> Array:
    """From 0 to 1 with neither speed nor acceleration at the ends."""
    return fraction**3 * (10 + fraction * (6 * fraction - 15))


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A scene, a gripper, and the kinematics of both.

    Attributes:
        scene: The shipped scene.
        gripper: A gripper as the reference designs have it.
        arm: Kinematics with the tool at the grasp centre.
        inverse: Its inverse.
        grasp_rad: A configuration at the grasp that touches nothing.
    """

    scene: Scene
    gripper: Gripper
    arm: Arm
    inverse: InverseKinematics
    grasp_rad: Array

    def world(self, *, rate_hz: float = 240.0, gripper: Gripper | None = None, **scene: Any) -> World:
        """A world of this cell with some of the scene changed."""
        return World(replace(self.scene, **scene), gripper or self.gripper, PhysicsSettings(rate_hz=rate_hz))

    def with_workpiece(self, **changes: Any) -> dict[str, Any]:
        """The change of a scene that changes its workpiece."""
        return {"workpiece": replace(self.scene.workpiece, **changes)}

    def near(self, pose: Pose) -> Array:
        """The configuration at a pose that is next to the one at the grasp."""
        found = self.inverse.nearest(pose, self.grasp_rad)
        assert found is not None
        return found

    def hold(self, world: World, steps: int, configuration_rad: Array | None = None) -> None:
        """Step with the arm commanded to stay."""
        target = (self.grasp_rad if configuration_rad is None else configuration_rad).tolist()
        for _ in range(steps):
            world.command_arm(target, STILL)
            world.step()

    def close(self, world: World) -> None:
        """Put the arm at the grasp, close the fingers, and wait until all is still."""
        world.reset_arm(self.grasp_rad.tolist())
        world.drive_fingers(self.gripper.finger_velocity_m_s, self.gripper.finger_force_n)
        self.hold(world, round(1.25 * world.settings.rate_hz))

    def path(self, start_rad: Array, goal_rad: Array, duration_s: float, rate_hz: float = 240.0) -> Array:
        """Positions of a smooth move, one more than its steps, shape (n + 1, 6)."""
        steps = round(duration_s * rate_hz)
        return start_rad + (goal_rad - start_rad) * smooth(np.linspace(0.0, 1.0, steps + 1))[:, None]

    def follow(self, world: World, path: Array) -> list[Pose]:
        """Command a path step by step; return the pose of the tool after every step."""
        velocities = np.diff(path, axis=0) / world.settings.step_s
        poses = []
        for position, velocity in zip(path[:-1].tolist(), velocities.tolist(), strict=True):
            world.command_arm(position, velocity)
            world.step()
            poses.append(world.tool_pose())
        return poses

    def lift(self, world: World, height_m: float = 0.06, duration_s: float = 1.0) -> Array:
        """Grasp the workpiece, lift it, wait until all is still; return the configuration."""
        self.close(world)
        up = self.near(self.scene.grasp.raised(height_m))
        self.follow(world, self.path(self.grasp_rad, up, duration_s, world.settings.rate_hz))
        self.hold(world, round(0.25 * world.settings.rate_hz), up)
        return up


def cell_with(fingers: int) -> Cell:
    scene = load_scene(SCENES / "restaurant.yaml")
    geometry = load_gripper(SCENES / f"grippers/kg-{fingers}.yaml")
    gripper = Gripper(
        geometry=geometry,
        base_mass_kg=0.55,
        finger_mass_kg=0.3,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )
    arm = Arm(scene.robot, geometry.grasp_centre)
    inverse = inverse_kinematics(arm)
    situation = CollisionContext(opening_m=geometry.largest_opening_m, standing=scene.workpiece.pose)
    collision = CollisionModel(scene, geometry, situation)
    free = [q for q in inverse.solve(scene.grasp) if collision.is_valid(q)]
    home = np.array(scene.robot.home_rad)
    nearest = min(free, key=lambda q: float(np.linalg.norm(q - home)))
    return Cell(scene=scene, gripper=gripper, arm=arm, inverse=inverse, grasp_rad=nearest)


@pytest.fixture(scope="session")
def two_fingers() -> Cell:
    return cell_with(2)


@pytest.fixture(scope="session")
def three_fingers() -> Cell:
    return cell_with(3)


@pytest.fixture(scope="session", params=[2, 3], ids=["two fingers", "three fingers"])
def cell(request) -> Cell:
    return request.getfixturevalue("two_fingers" if request.param == 2 else "three_fingers")
