"""Fitting of a cell to an arm: a layout that it reaches, a home, and what it carries."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from rgss.errors import DefinitionError
from rgss.kinematics import Arm, ArmDynamics, Load, inverse_kinematics
from rgss.scenes import GripperGeometry, Pose, Robot, Scene, Waypoint, load_scene, waypoint_poses
from rgss.studies.robot_project.layout import Layout, layouts, scene_text
from rgss.trials import Workcell, reach_problems

_SAMPLES = 2048
_CLEARANCE_M = 0.008
_LEAST_PAYLOAD_KG, _MOST_PAYLOAD_KG = 0.1, 100.0


def horizontal_reach_m(robot: Robot) -> float:
    """Greatest distance of the flange from the first axis over sampled configurations.

    Args:
        robot: The arm.
    """
    arm = Arm(robot, Pose())
    positions = arm.tool_position(_sampled(robot)) - np.array(arm.first_axis_m)
    return float(np.max(np.linalg.norm(positions, axis=1)))


def payload_at_reach_kg(robot: Robot) -> float:
    """Mass at the flange that the efforts of the joints hold with the arm farthest out; rounded down to 0.1 kg.

    Args:
        robot: The arm.
    """
    arm = Arm(robot, Pose())
    samples = _sampled(robot)
    offsets = (arm.tool_position(samples) - np.array(arm.first_axis_m))[:, :2]
    q = samples[int(np.argmax(np.linalg.norm(offsets, axis=1)))]
    still = np.zeros(len(robot.joints))
    kilogram = Load(mass_kg=1.0, moments_kg_m2=(0.0, 0.0, 0.0), pose=Pose())
    own = ArmDynamics(robot, (), gravity_m_s2=9.81).torques(q, still, still)
    more = ArmDynamics(robot, (kilogram,), gravity_m_s2=9.81).torques(q, still, still) - own
    margins = [
        (joint.torque_n_m - abs(float(mine))) / abs(float(each))
        for joint, mine, each in zip(robot.joints, own, more, strict=True)
        if abs(float(each)) > 1e-9
    ]
    held = math.floor(10 * min(margins, default=_MOST_PAYLOAD_KG)) / 10
    return min(max(held, _LEAST_PAYLOAD_KG), _MOST_PAYLOAD_KG)


def fitted(
    folder: Path, robot: Robot, robot_file: str, geometries: Sequence[GripperGeometry]
) -> tuple[Layout, tuple[float, ...]]:
    """The first layout in which the arm reaches every waypoint with every gripper, and a home for it.

    Args:
        folder: The project, with all files but the scene.
        robot: The arm.
        robot_file: Name of its file.
        geometries: The grippers.

    Raises:
        DefinitionError: There is none.
    """
    path = folder / "scenes" / "kitchen.yaml"
    for layout in layouts(horizontal_reach_m(robot)):
        path.write_text(scene_text(layout, robot=robot_file), encoding="utf-8")
        scene = load_scene(path, project=folder)
        if not all(_reaches_ends(scene, geometry) for geometry in geometries):
            continue
        if any(
            problem.waypoint for one in geometries for problem in reach_problems(scene, one, clearance_m=_CLEARANCE_M)
        ):
            continue
        home = _home(scene, geometries)
        if home is not None:
            return layout, home
    raise DefinitionError(
        f"no layout was found in which {robot.id} grasps a cup on a table with its tool pointing down",
        hint="is --flange the link whose z axis points out of the arm? Does the arm turn its tool down at all?",
    )


def _reaches_ends(scene: Scene, geometry: GripperGeometry) -> bool:
    inverse, poses = inverse_kinematics(Arm(scene.robot, geometry.grasp_centre)), waypoint_poses(scene)
    ends = (Waypoint.GRASP, Waypoint.GRASP_DEPARTURE, Waypoint.PLACE)
    return all(inverse.nearest(poses[waypoint], scene.robot.home_rad) is not None for waypoint in ends)


def _home(scene: Scene, geometries: Sequence[GripperGeometry]) -> tuple[float, ...] | None:
    """The valid configuration above the object that is nearest to the middle of the ranges."""
    middle = np.array(scene.robot.home_rad)
    cells = [Workcell(scene, geometry, clearance_m=_CLEARANCE_M) for geometry in geometries]
    models = [next(iter(cell.planning.values())) for cell in cells]
    pose = waypoint_poses(scene)[Waypoint.GRASP_DEPARTURE]
    found = [q for q in inverse_kinematics(cells[0].arm).solve(pose) if all(model.is_valid(q) for model in models)]
    nearest = min(found, key=lambda q: float(np.linalg.norm(q - middle)), default=None)
    return None if nearest is None else tuple(nearest.tolist())


def _sampled(robot: Robot) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    lower, upper = (np.array([getattr(joint, end) for joint in robot.joints]) for end in ("lower_rad", "upper_rad"))
    shares = np.random.default_rng(0).random((_SAMPLES, len(robot.joints)))
    samples: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = lower + shares * (upper - lower)
    return samples
