"""Robots that have visual meshes are drawn with them, and nothing that is simulated knows of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.physics import Posture, Stage
from rgss.studies import load_project, trial_specs
from rgss.studies.robot_project import write_robot_project
from rgss.trials.code import versions
from rgss.trials.pieces import digests_of
from tests.robots.conftest import urdf_of

pytestmark = pytest.mark.engine


@pytest.fixture(scope="module")
def spec(tmp_path_factory):
    """The first trial of an arm with its own hand, both with visual meshes."""
    folder, urdf = tmp_path_factory.mktemp("looks") / "project", urdf_of("seven with a hand")
    write_robot_project(urdf, folder, gripper=urdf)
    project = load_project(folder)
    return next(iter(trial_specs(project, variants=[project.designs.variant(1)], seeds=[1])))


def solids_of(spec):
    stage = Stage(spec.scene, spec.gripper)
    try:
        joints = spec.scene.robot.home_rad
        stage.take(Posture(joints_rad=joints, finger_travel_m=(0.0, 0.0), workpiece=spec.scene.workpiece.pose))
        return {solid.link: solid for solid in stage.solids() if solid.link}, stage.link_poses()
    finally:
        stage.close()


def without_looks(spec):
    robot, geometry = spec.scene.robot, spec.gripper.geometry
    bare = replace(geometry, linkage=replace(geometry.linkage, looks=()))
    return replace(
        spec,
        scene=replace(spec.scene, robot=replace(robot, looks=())),
        gripper=replace(spec.gripper, geometry=bare),
    )


def test_links_are_drawn_with_their_visual_meshes(spec):
    seen, poses = solids_of(spec)
    hulls, same = solids_of(without_looks(spec))

    assert seen.keys() == hulls.keys()
    assert poses == same
    assert all(
        len(seen[f"panda_link{number}"].surface.indices) > 2 * len(hulls[f"panda_link{number}"].surface.indices)
        for number in range(1, 7)
    )
    # A mesh fills the shape that stands for it, up to what the hull adds in its hollows.
    for name, solid in seen.items():
        drawn = np.array([solid.pose.rotate(vertex) for vertex in solid.surface.vertices_m]) + solid.pose.position_m
        shape = np.array([hulls[name].pose.rotate(one) for one in hulls[name].surface.vertices_m])
        shape += hulls[name].pose.position_m
        assert drawn.min(axis=0) == pytest.approx(shape.min(axis=0), abs=0.03), name
        assert drawn.max(axis=0) == pytest.approx(shape.max(axis=0), abs=0.03), name


def test_what_is_drawn_is_no_input_of_a_trial(spec):
    assert spec.scene.robot.looks
    assert spec.gripper.geometry.linkage.looks
    assert without_looks(spec) == spec
    assert digests_of(without_looks(spec), versions()) == digests_of(spec, versions())


def test_a_mesh_that_is_gone_leaves_the_shapes_that_are_simulated(spec, tmp_path):
    robot = spec.scene.robot
    gone = tuple(replace(look, mesh=tmp_path / "gone.obj") for look in robot.looks)
    bare, _ = solids_of(without_looks(spec))
    seen, _ = solids_of(replace(spec, scene=replace(spec.scene, robot=replace(robot, looks=gone))))

    assert seen["panda_link3"] == bare["panda_link3"]
