"""The bench's rail against the whole arm: the same hand fails at the same mass."""

import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from rgss.kinematics import Arm, inverse_kinematics, straight_line
from rgss.physics import PhysicsSettings, World
from rgss.scenes import Gripper, load_gripper, load_scene
from rgss.trials.payload_bench.bench import run_bench
from rgss.trials.payload_bench.spec import bench_spec

pytestmark = pytest.mark.engine

SCENES = Path(__file__).parents[3] / "scenes"
ACCELERATION = 1.2
LIFT_S = 0.4


@pytest.mark.parametrize("fingers", [2, 3])
def test_the_arm_lifts_what_the_rail_lifts_and_no_more(fingers):
    scene = load_scene(SCENES / "restaurant.yaml")
    gripper = Gripper(
        geometry=load_gripper(SCENES / f"grippers/kg-{fingers}.yaml"),
        base_mass_kg=0.4,
        finger_mass_kg=0.3,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )
    payload_kg = run_bench(bench_spec(scene, gripper, acceleration_m_s2=ACCELERATION, rated_kg=10.0)).payload_kg
    inverse = inverse_kinematics(Arm(scene.robot, gripper.geometry.grasp_centre))
    step_s = PhysicsSettings().step_s
    times = np.arange(round(LIFT_S / step_s) + 1) * step_s
    path = [inverse.nearest(scene.grasp, scene.robot.home_rad)]
    assert straight_line(inverse, path[0], scene.grasp.raised(ACCELERATION * LIFT_S**2 / 2)) is not None
    for height in (ACCELERATION * times[1:] ** 2 / 2).tolist():
        path.append(inverse.nearest(scene.grasp.raised(height), path[-1]))
    slips = []
    for share in (0.98, 1.02):
        heavy = replace(scene, workpiece=replace(scene.workpiece, mass_kg=share * payload_kg))
        with World(heavy, gripper, PhysicsSettings()) as world:
            world.reset_arm(path[0].tolist())
            world.drive_fingers(gripper.finger_velocity_m_s, gripper.finger_force_n)
            for _ in range(300):
                world.command_arm(path[0].tolist(), (0.0,) * 6)
                world.step()
            held = world.tool_pose().inverse() @ world.workpiece_pose()
            for start, end in pairwise(path):
                world.command_arm(start.tolist(), ((end - start) / step_s).tolist())
                world.step()
            now = world.tool_pose().inverse() @ world.workpiece_pose()
            slips.append(math.dist(held.position_m, now.position_m))
            risen = world.tool_pose().position_m[2] - scene.grasp.position_m[2]
        assert risen == pytest.approx(ACCELERATION * LIFT_S**2 / 2, abs=1e-4)
    kept, lost = slips
    assert kept < 1e-3
    assert lost > 1e-2
