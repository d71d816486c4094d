"""The saved configurations of docs/robots.md reach the waypoints of the bench, clear of it."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import yaml

from rgss.scenes import Waypoint, initial_placements, scene_about, waypoint_poses
from rgss.studies.project import load_project
from rgss.tasks import default_task
from rgss.trials import Workcell

REPOSITORY = Path(__file__).parents[2]
CLEARANCE_M = 0.0065  # half a millimetre is left for the rounding


def test_they_reach_the_waypoints_with_clearance():
    page = (REPOSITORY / "docs" / "robots.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```yaml\n(configurations:\n.*?)^```", page, re.MULTILINE | re.DOTALL)
    configurations = {
        name: np.radians([float(each.removesuffix(" deg")) for each in joints])
        for name, joints in yaml.safe_load(block)["configurations"].items()
    }
    project = load_project(REPOSITORY, "studies/yumi_widget.yaml")
    (gripper,) = project.grippers.values()
    scene = scene_about(project.scene, "widget_2", place="", placements=initial_placements(project.scene))
    cell = Workcell(scene, gripper.geometry, clearance_m=CLEARANCE_M, task=default_task())
    poses = waypoint_poses(scene)

    assert set(configurations) == {waypoint.value for waypoint in Waypoint}
    for waypoint, pose in poses.items():
        tool = cell.arm.tool_matrix(configurations[waypoint.value])
        assert np.linalg.norm(tool[:3, 3] - pose.position_m) < 1e-4
        assert tool[:3, 2] @ (0.0, 0.0, -1.0) > np.cos(np.radians(0.05))
    approach = configurations["grasp_approach"]
    assert all(model.is_valid(approach) for model in list(cell.planning.values())[:1])
