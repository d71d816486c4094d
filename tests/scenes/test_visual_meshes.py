"""Visual meshes of links: what is read of a URDF, and the triangles that are drawn."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import trimesh

from rgss.scenes import LinkLook, Pose, drawn_mesh
from rgss.scenes.looks.visual_meshes import MOST_TRIANGLES, looks_of

URDF = """\
<robot name="r">
  <material name="steel"><color rgba="0.5 0.6 0.7 1"/></material>
  <link name="arm">
    <visual><origin xyz="1 2 3"/><geometry><mesh filename="arm.stl" scale="0.001 0.001 0.002"/></geometry>
      <material name="steel"/></visual>
    <visual><geometry><mesh filename="cover.obj"/></geometry>
      <material name="own"><color rgba="2 0 -1 0.5"/></material></visual>
  </link>
  <link name="bare"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <link name="plain"><visual><geometry><mesh filename="plain.stl"/></geometry><material name="gone"/></visual></link>
  <link name="odd"><visual><geometry><mesh filename="odd.stl"/></geometry>
    <material name="x"><color rgba="a b"/></material></visual></link>
  <link name="lost"><visual><geometry><mesh filename="lost.stl"/></geometry></visual></link>
</robot>
"""


@pytest.fixture
def look(tmp_path):
    """Makes the look of a mesh."""

    def make(mesh, name="mesh.stl"):
        mesh.export(tmp_path / name)
        return LinkLook(link="arm", mesh=tmp_path / name, pose=Pose(), scale=(1.0, 1.0, 1.0), colour=None)

    return make


def test_looks_have_pose_scale_and_colour(tmp_path):
    paths = {name: tmp_path / name for name in ("arm.stl", "cover.obj", "plain.stl", "odd.stl")}
    arm, cover, plain, odd = looks_of(ET.fromstring(URDF), paths)  # noqa: S314 - our own text

    assert (arm.link, arm.mesh, arm.scale) == ("arm", tmp_path / "arm.stl", (0.001, 0.001, 0.002))
    assert arm.pose.position_m == (1.0, 2.0, 3.0)
    assert arm.colour == (0.5, 0.6, 0.7, 1.0)
    assert cover.colour == (1.0, 0.0, 0.0, 0.5)
    assert (plain.link, plain.colour, odd.colour) == ("plain", None, None)


def test_a_small_mesh_is_drawn_as_it_is(look):
    box = trimesh.creation.box((0.1, 0.2, 0.3))
    drawn = drawn_mesh(look(box))

    assert len(drawn.triangles) == 12
    # Three normals at each corner: its edges are sharp.
    assert len(drawn.vertices_m) == 24
    corners = drawn.vertices_m[drawn.triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    across /= np.linalg.norm(across, axis=1)[:, np.newaxis]
    assert np.einsum("ij,ij->i", across, drawn.normals[drawn.triangles[:, 0]]) == pytest.approx(1.0)


def test_a_mesh_of_many_triangles_is_drawn_with_few_and_stays_where_it_is(look):
    ball = trimesh.creation.icosphere(subdivisions=6, radius=0.1)
    drawn = drawn_mesh(look(ball))
    distances_m = np.linalg.norm(drawn.vertices_m, axis=1)

    assert len(ball.faces) == 81_920
    assert 500 < len(drawn.triangles) <= MOST_TRIANGLES
    assert distances_m == pytest.approx(0.1, abs=0.003)
    # Smooth all round: the normal of a ball is its radius.
    assert np.einsum("ij,ij->i", drawn.normals, drawn.vertices_m / distances_m[:, np.newaxis]).min() > 0.9


def test_a_hollow_part_has_no_holes(look):
    """Each edge of a closed surface has a triangle on either side: both shells of a thin wall stay closed."""
    outer, inner = (trimesh.creation.icosphere(subdivisions=5, radius=radius) for radius in (0.1, 0.097))
    inner.invert()
    drawn = drawn_mesh(look(trimesh.util.concatenate([outer, inner])))
    assert len(drawn.triangles) <= MOST_TRIANGLES
    corners = np.unique(np.round(drawn.vertices_m, 7), axis=0, return_inverse=True)[1].reshape(-1)[drawn.triangles]
    edges = np.sort(np.vstack([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    assert set(np.unique(edges, axis=0, return_counts=True)[1].tolist()) == {2}
    distances_m = np.linalg.norm(drawn.vertices_m, axis=1)
    assert distances_m.min() > 0.094
    assert distances_m.max() < 0.103


def test_parts_that_do_not_quite_meet_are_drawn_with_few_triangles_too(look):
    """Strips of a tube that are 1 µm apart: every second edge is one of a border, which an edge collapse keeps."""
    turns, lifts = np.linspace(0.0, 2.0 * np.pi, 1501), (0.0, 0.3)
    strips = []
    for number, (one, two) in enumerate(pairwise(turns)):
        shift = 1e-6 * (number % 2)
        ring = [(0.1 * np.cos(turn) + shift, 0.1 * np.sin(turn), z) for z in lifts for turn in (one, two)]
        strips.append(trimesh.Trimesh(vertices=ring, faces=[(0, 1, 3), (0, 3, 2)], process=False))
    tube = trimesh.util.concatenate(strips)
    drawn = drawn_mesh(look(tube))
    assert 100 < len(drawn.triangles) <= MOST_TRIANGLES
    assert np.ptp(drawn.vertices_m, axis=0) == pytest.approx([0.2, 0.2, 0.3], rel=0.02)


def test_a_stray_corner_far_away_does_not_hide_the_part(look):
    """One sliver of a triangle makes the part smaller than a cell of the finest weld."""
    ball = trimesh.creation.icosphere(subdivisions=5, radius=0.1)
    vertices = np.vstack([ball.vertices, [(0.1, 0.0, 0.0), (500.0, 0.0, 0.0), (500.0, 1e-3, 0.0)]])
    sliver = [len(ball.vertices), len(ball.vertices) + 1, len(ball.vertices) + 2]
    drawn = drawn_mesh(look(trimesh.Trimesh(vertices, np.vstack([ball.faces, sliver]), process=False)))
    assert drawn is not None
    near = np.linalg.norm(drawn.vertices_m, axis=1) < 0.2
    assert np.count_nonzero(near) > 200


def test_the_scale_applies(look):
    one = look(trimesh.creation.box((100.0, 200.0, 300.0)))
    drawn = drawn_mesh(replace(one, scale=(0.001, 0.001, 0.001)))

    assert np.ptp(drawn.vertices_m, axis=0) == pytest.approx([0.1, 0.2, 0.3])


def test_a_file_that_changes_is_read_again(look, tmp_path):
    import os

    one = look(trimesh.creation.box((0.1, 0.1, 0.1)))
    before = drawn_mesh(one)
    trimesh.creation.box((0.2, 0.2, 0.2)).export(one.mesh)
    os.utime(one.mesh, ns=(1, 1))

    assert np.ptp(drawn_mesh(one).vertices_m) == pytest.approx(2 * np.ptp(before.vertices_m))


def test_what_cannot_be_read_is_not_drawn(look, tmp_path):
    one = look(trimesh.creation.box((0.1, 0.1, 0.1)))
    broken = tmp_path / "broken.stl"
    broken.write_bytes(b"solid")

    assert drawn_mesh(replace(one, mesh=tmp_path / "gone.stl")) is None
    assert drawn_mesh(replace(one, mesh=broken)) is None
    assert drawn_mesh(replace(one, mesh=tmp_path / "mesh.step")) is None
