"""Convex shapes of meshes: hulls, boxes, parts."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy.spatial import ConvexHull

from rgss.errors import DefinitionError
from rgss.scenes.document import CollisionShapes
from rgss.scenes.mesh_shapes import MOST_VERTICES, mesh_mass, mesh_summary, shapes_of_mesh, shapes_volume_m3

ONE = (1.0, 1.0, 1.0)
LFS_POINTER = b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 132456\n"


def bracket():
    """Two bars that meet at a right angle, 0.2 m long and 0.04 m thick."""
    first = trimesh.creation.box((0.2, 0.04, 0.04))
    second = trimesh.creation.box((0.04, 0.2, 0.04))
    second.apply_translation((-0.08, 0.08, 0.0))
    return trimesh.util.concatenate([first, second])


@pytest.fixture
def saved(tmp_path):
    def save(mesh, name="part.stl"):
        path = tmp_path / name
        mesh.export(path)
        return path

    return save


def shapes(path, how=CollisionShapes.HULL, scale=ONE):
    return shapes_of_mesh(path, sha256=str(path), scale=scale, how=how)


def test_a_box_keeps_its_corners(saved):
    for name in ("box.stl", "box.obj", "box.ply"):
        (corners,) = shapes(saved(trimesh.creation.box((0.2, 0.1, 0.06)), name))
        assert len(corners) == 8
        assert np.allclose(np.max(corners, axis=0), (0.1, 0.05, 0.03))


@pytest.mark.parametrize(("unit", "size_m"), [("", 200.0), ('<unit name="mm" meter="0.001"/>', 0.2)])
def test_the_unit_that_a_collada_file_states_is_that_of_its_lengths(saved, unit, size_m):
    path = saved(trimesh.creation.box((200, 100, 60)), "box.dae")
    text = path.read_text(encoding="utf-8")
    assert text.count("<asset>") == 1
    assert "<unit" not in text
    path.write_text(text.replace("<asset>", f"<asset>{unit}"), encoding="utf-8")

    (corners,) = shapes(path)

    assert np.ptp(corners, axis=0)[0] == pytest.approx(size_m)
    assert mesh_summary(path, scale=ONE).extent_m[0] == pytest.approx(size_m)


def test_a_scale_is_kept_and_may_mirror(saved):
    mesh = trimesh.creation.box((200, 100, 60))
    mesh.apply_translation((100, 0, 0))
    (corners,) = shapes(saved(mesh), scale=(-0.001, 0.001, 0.001))
    assert np.allclose(np.min(corners, axis=0), (-0.2, -0.05, -0.03))


def test_a_round_mesh_has_few_corners_and_is_held_by_its_shape(saved):
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=0.08)
    (corners,) = shapes(saved(mesh))
    assert len(corners) <= MOST_VERTICES < len(mesh.vertices)
    planes = ConvexHull(np.array(corners)).equations
    # The shape holds the mesh and is larger by no more than two chords' sagittae of 160 corners.
    beyond = planes[:, :3] @ mesh.vertices.T + planes[:, 3:]
    assert float(np.max(beyond)) <= 2e-7
    assert np.max(np.linalg.norm(corners, axis=1)) < 0.0835


def test_each_body_of_a_mesh_has_a_box(saved):
    boxes = shapes(saved(bracket()), CollisionShapes.BOXES)
    assert [len(corners) for corners in boxes] == [8, 8]
    farthest = sorted(np.round(np.max(corners, axis=0), 6).tolist() for corners in boxes)
    assert farthest == [[-0.06, 0.18, 0.02], [0.1, 0.02, 0.02]]
    assert shapes_volume_m3(boxes) == pytest.approx(2 * 0.2 * 0.04 * 0.04)


def test_a_box_inside_another_and_faces_without_a_volume_add_none(saved):
    outer, inner = trimesh.creation.box((0.2, 0.1, 0.06)), trimesh.creation.icosphere(radius=0.02)
    (corners,) = shapes(saved(trimesh.util.concatenate([inner, outer])), CollisionShapes.BOXES)
    assert np.allclose(np.max(corners, axis=0), (0.1, 0.05, 0.03))
    plate = trimesh.Trimesh([(0.3, 0, 0), (0.4, 0, 0), (0.4, 0.1, 0), (0.3, 0.1, 0)], [(0, 1, 2), (0, 2, 3)])
    (corners,) = shapes(saved(trimesh.util.concatenate([outer, plate]), "flat.stl"), CollisionShapes.BOXES)
    assert np.allclose(np.max(corners, axis=0), (0.4, 0.1, 0.03))


def test_bodies_of_a_mesh_are_shapes_of_their_own(saved):
    parts = shapes(saved(bracket()), CollisionShapes.DECOMPOSE)
    assert sorted(len(part) for part in parts) == [8, 8]


def test_a_concave_body_is_decomposed_the_same_way_again(saved):
    ring = trimesh.creation.annulus(r_min=0.06, r_max=0.1, height=0.05, sections=24)
    path = saved(ring)
    parts = shapes(path, CollisionShapes.DECOMPOSE)
    assert len(parts) > 2
    volume = sum(trimesh.convex.convex_hull(np.array(part)).volume for part in parts)
    assert volume == pytest.approx(ring.volume, rel=0.15)
    assert shapes_of_mesh(path, sha256="again", scale=ONE, how=CollisionShapes.DECOMPOSE) == parts


def test_faces_without_a_volume_beside_a_body_are_within_its_shapes(saved):
    box = trimesh.creation.box((0.2, 0.1, 0.06))
    plate = trimesh.Trimesh([(0.3, 0, 0), (0.4, 0, 0), (0.4, 0.1, 0), (0.3, 0.1, 0)], [(0, 1, 2), (0, 2, 3)])
    mesh = trimesh.util.concatenate([box, plate])
    (whole,) = shapes(saved(mesh), CollisionShapes.DECOMPOSE)
    assert np.allclose(np.max(whole, axis=0), (0.4, 0.1, 0.03))
    plates = [plate, plate.copy()]
    plates[1].apply_translation((0, 0, 0.05))
    parts = shapes(saved(trimesh.util.concatenate([box, *plates]), "more.stl"), CollisionShapes.DECOMPOSE)
    assert [np.round(np.max(part, axis=0), 6).tolist() for part in parts] == [[0.1, 0.05, 0.03], [0.4, 0.1, 0.05]]


def test_a_loose_face_on_a_body_does_not_replace_its_pieces_by_one_hull(saved):
    """A flat patch, as modellers leave one on a wall, adds nothing beyond the bodies."""
    left, right = trimesh.creation.box((0.1, 0.1, 0.1)), trimesh.creation.box((0.1, 0.1, 0.1))
    right.apply_translation((0.5, 0.0, 0.0))
    patch = trimesh.Trimesh([(0.05, -0.02, -0.02), (0.05, 0.02, -0.02), (0.05, 0.0, 0.02)], [(0, 1, 2)], process=False)
    parts = shapes(saved(trimesh.util.concatenate([left, right, patch])), CollisionShapes.DECOMPOSE)
    assert [len(each) for each in parts] == [8, 8]
    assert sum(ConvexHull(each).volume for each in parts) == pytest.approx(2e-3, rel=1e-3)


def test_what_a_mesh_is(saved):
    found = mesh_summary(saved(trimesh.creation.box((0.2, 0.1, 0.06))))
    assert (found.is_closed, found.bodies) == (True, 1)
    assert found.hull_ratio == pytest.approx(1.0)
    ring = mesh_summary(saved(trimesh.creation.annulus(r_min=0.06, r_max=0.1, height=0.05)))
    assert ring.hull_ratio > 1.4
    open_box = trimesh.creation.box((0.2, 0.1, 0.06))
    open_box.update_faces(np.arange(len(open_box.faces)) > 1)
    assert not mesh_summary(saved(open_box)).is_closed


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("part.step", b"ISO-10303-21;", "part.step is not a mesh format that can be read"),
        ("part.dae", b"<COLLADA><asset>", "part.dae cannot be read as a mesh: "),
        ("part.dae", LFS_POINTER, "part.dae is a pointer of Git LFS, and not the mesh"),
        ("part.stl", LFS_POINTER, "part.stl is a pointer of Git LFS, and not the mesh"),
        ("part.obj", LFS_POINTER, "part.obj is a pointer of Git LFS, and not the mesh"),
        ("part.stl", b"", "part.stl is an empty file"),
        ("part.stl", b"this is not a mesh", "part.stl is not a file of the format STL"),
        ("part.obj", b"this is not a mesh", "part.obj is not a file of the format OBJ"),
        ("part.stl", b"solid", "part.stl"),
        ("part.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n", "part.obj is flat and has no volume"),
    ],
)
def test_what_is_no_solid_mesh_is_refused(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(DefinitionError) as caught:
        shapes(tmp_path / name)
    assert message in caught.value.message


def test_bodies_that_touch_along_an_edge_are_closed(saved):
    """Joined, four faces would meet at the edge."""
    one = trimesh.creation.box(extents=(0.02, 0.02, 0.02))
    other = trimesh.creation.box(extents=(0.02, 0.02, 0.02))
    other.apply_translation((0.02, 0.02, 0.0))
    both = trimesh.util.concatenate([one, other])
    path = saved(both).with_suffix(".obj")
    both.export(path)
    assert mesh_summary(path).is_closed
    assert mesh_mass(path).volume_m3 == pytest.approx(2 * 0.02**3)
