"""Resolution at which the paths of a new project are verified: a large arm moves far in a small step of its joints."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.kinematics import Arm
from rgss.studies import load_project
from rgss.studies.expansion import trial_specs
from rgss.studies.robot_project import write_robot_project
from rgss.studies.robot_project.reach import greatest_travel_m
from tests.fixtures.serial_arms import SEVEN, serial_urdf

pytestmark = pytest.mark.engine


def arm_of(folder, scale):
    links = tuple(replace(link, xyz=tuple(scale * value for value in link.xyz)) for link in SEVEN)
    urdf = folder / "arm.urdf"
    urdf.write_text(serial_urdf(links), encoding="utf-8")
    write_robot_project(urdf, folder / "project")
    project = load_project(folder / "project")
    return project, trial_specs(project, seeds=[1])


@pytest.mark.slow
@pytest.mark.parametrize("scale", [1.0, 3.0])
def test_the_tool_moves_no_more_than_twice_the_clearance_between_two_states(tmp_path, scale):
    project, specs = arm_of(tmp_path, scale)
    planning = project.study.planning.settings
    step_rad = planning.verified_every_rad
    rng = np.random.default_rng(5)
    for spec in {spec.gripper.geometry.id: spec for spec in specs}.values():
        arm = Arm(spec.scene.robot, spec.gripper.geometry.grasp_centre)
        start = rng.uniform(arm.lower_rad, arm.upper_rad, (4000, len(arm.lower_rad)))
        along = rng.normal(size=start.shape)
        end = start + step_rad * along / np.linalg.norm(along, axis=1, keepdims=True)
        moved_m = np.linalg.norm(arm.tool_position(end) - arm.tool_position(start), axis=1)
        assert moved_m.max() <= 2.0 * planning.clearance_m
    # A step that is finer than need be costs planning time.
    assert step_rad == 0.01 or moved_m.max() > 0.6 * planning.clearance_m


def test_the_greatest_travel_is_that_of_differences(tmp_path):
    """Against central differences at other configurations."""
    _, specs = arm_of(tmp_path, 1.0)
    robot = specs[0].scene.robot
    arm = Arm(robot, specs[0].gripper.geometry.grasp_centre)
    rng = np.random.default_rng(9)
    tried = rng.uniform(arm.lower_rad, arm.upper_rad, (300, len(arm.lower_rad)))
    step = 1e-6
    columns = [
        (arm.tool_position(tried + step * unit) - arm.tool_position(tried - step * unit)) / (2 * step)
        for unit in np.eye(len(arm.lower_rad))
    ]
    greatest = np.linalg.norm(np.stack(columns, axis=2), ord=2, axis=(1, 2)).max()
    assert greatest_travel_m(robot, specs[0].gripper.geometry.grasp_centre) == pytest.approx(greatest, rel=0.05)
