"""Suction points and their order, against geometry and statics that are computed apart from them."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import linprog

from rgss.grasping.candidates import given_suction_point, ranked_suction, suction_points, weight_share
from rgss.grasping.candidates.ranking import FrameRejection
from rgss.scenes import (
    Approach,
    Box,
    Cylinder,
    GivenGrasp,
    GraspCandidates,
    GripperGeometry,
    LyingCylinder,
    MeshShape,
    Pose,
    SuctionPoint,
    Workpiece,
    at_top,
    corners_of,
)

RADIUS_M = 0.02
CENTRE = (0.0, 0.0, 0.0)
BOX = Box(size_m=(0.06, 0.05, 0.08))
UPRIGHT = Cylinder(radius_m=0.03, height_m=0.1)
LYING = LyingCylinder(radius_m=0.03, length_m=0.09)
EVERY = GraspCandidates(approaches=tuple(Approach), yaws=4)
CUP = GripperGeometry(
    id="cup",
    azimuths_rad=(),
    base=Cylinder(radius_m=0.03, height_m=0.06),
    finger=Box(size_m=(0.0, 0.0, 0.0)),
    largest_opening_m=0.0,
    stroke_m=0.0,
    grasp_depth_m=0.0865,
    cup=Cylinder(radius_m=RADIUS_M, height_m=0.025),
)


def piece(shape, **changes):
    return Workpiece(
        id="object",
        shape=shape,
        mass_kg=0.3,
        friction=1.0,
        force_limit_n=40.0,
        pose=Pose(),
        colour=(0.0, 0.0, 0.0, 1.0),
        **changes,
    )


def ranked(shape, options=EVERY, tangential_1=0.5, **changes):
    return ranked_suction(piece(shape, **changes), at_top(CUP, shape), options, tangential_1=tangential_1)


def block(low, high):
    return tuple(itertools.product(*zip(low, high, strict=True)))


def test_suction_points_are_on_the_faces_that_bear_the_cup():
    points = suction_points(BOX, RADIUS_M, CENTRE)
    assert len(points) == 6
    assert points[0].normal == pytest.approx((0.0, 0.0, 1.0))
    for point in points:
        assert point.room_m >= RADIUS_M - 1e-7
    assert len(suction_points(Box(size_m=(0.2, 0.03, 0.2)), RADIUS_M, CENTRE)) == 2


def test_a_suction_point_is_as_near_to_the_centre_of_mass_as_the_edge_allows():
    best = suction_points(Box(size_m=(0.1, 0.1, 0.05)), RADIUS_M, (0.04, 0.0, 0.0))
    on_top = next(point for point in best if point.normal[2] > 0.99)
    # The lip keeps 2 mm from the edge.
    assert on_top.position_m == pytest.approx((0.028, 0.0, 0.025), abs=1e-6)
    assert on_top.room_m == pytest.approx(RADIUS_M + 2e-3, abs=1e-6)


def test_on_a_narrow_face_the_lip_keeps_the_reserve_that_there_is():
    """An oracle of its own: on a strip the cup is in the middle, or away from the edge that it is nearer to."""
    for width_m in (0.0403, 0.0408, 0.0417, 0.0435, 0.06):
        most_m = width_m / 2 - RADIUS_M
        reserve_m = max(one for one in (2e-3, 1e-3, 5e-4, 1e-4) if one <= most_m)
        points = suction_points(Box(size_m=(0.1, width_m, 0.05)), RADIUS_M, (0.0, 0.45 * width_m, 0.0))
        on_top = next(point for point in points if point.normal[2] > 0.99)
        assert on_top.position_m == pytest.approx((0.0, most_m - reserve_m, 0.025), abs=1e-6), width_m


def test_a_face_as_wide_as_the_lip_leaves_it_no_room():
    for width_m in (0.04, 0.0401):
        points = suction_points(Box(size_m=(0.1, width_m, 0.05)), RADIUS_M, CENTRE)
        assert [point for point in points if point.normal[2] > 0.99] == []


def test_the_wall_of_a_cylinder_bears_no_cup():
    assert [point.normal[2] for point in suction_points(UPRIGHT, RADIUS_M, CENTRE)] == [1.0, -1.0]
    assert sorted(point.normal[0] for point in suction_points(LYING, RADIUS_M, CENTRE)) == [-1.0, 1.0]


def test_a_mesh_that_is_round_bears_no_cup():
    turns = np.arange(24) * math.tau / 24
    ball = [
        (0.05 * math.cos(a) * math.cos(b), 0.05 * math.sin(a) * math.cos(b), 0.05 * math.sin(b))
        for a in turns
        for b in np.linspace(-1.5, 1.5, 13)
    ]
    sphere = MeshShape(parts_m=(tuple(ball),), sha256="ball")

    assert suction_points(sphere, RADIUS_M, CENTRE) == ()
    assert ranked(sphere, gyration_m2=(1e-3, 1e-3, 1e-3, 0.0, 0.0, 0.0)).rejected_frames == {FrameRejection.SEAL: 1}


def test_a_face_that_another_part_covers_bears_no_cup():
    # An L: the tower stands on one half of the foot, whose own top it covers.
    foot = block((-0.1, -0.03, -0.05), (0.0, 0.03, -0.01))
    tower = block((-0.06, -0.03, -0.012), (0.0, 0.03, 0.05))
    points = suction_points(MeshShape(parts_m=(foot, tower), sha256="l"), RADIUS_M, CENTRE)

    for point in points:
        above = np.array(point.position_m) + 1e-3 * np.array(point.normal)
        for part in (foot, tower):
            low, high = np.min(part, axis=0), np.max(part, axis=0)
            # The nearest point of the part to the cup's middle is beyond the lip, or below the face.
            off = above - np.clip(above, low, high)
            assert np.linalg.norm(off) > 0.9e-3
    tops = sorted(point.position_m[2] for point in points if point.normal[2] > 0.99)
    assert tops == pytest.approx([0.05])


def test_a_face_that_is_covered_in_its_middle_bears_the_cup_beside_the_other_part():
    plate = block((-0.1, -0.06, -0.02), (0.1, 0.06, 0.0))
    post = block((-0.01, -0.06, -0.001), (0.01, 0.06, 0.02))
    points = suction_points(MeshShape(parts_m=(plate, post), sha256="post"), RADIUS_M, CENTRE)

    (top,) = [point for point in points if point.normal[2] > 0.99]
    # Beside the post, as near to it as the margin and the grid of a quarter of the radius allow.
    assert 0.032 <= abs(top.position_m[0]) <= 0.037
    assert top.position_m[1:] == pytest.approx((0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("shape", [BOX, UPRIGHT, LYING], ids=["box", "upright", "lying"])
def test_the_lip_of_every_candidate_lies_on_the_surface_and_the_tool_points_at_it(shape):
    found = ranked(shape).grasps

    assert found
    for grasp in found:
        # The cup's lip in the object's frame, from the tool alone.
        lip = grasp.tool_in_object @ at_top(CUP, shape).grasp_centre.inverse() @ CUP.lip
        gap_m = CUP.grasp_depth_m - CUP.lip.position_m[2]
        for turn in np.arange(8) * math.tau / 8:
            rim = Pose(position_m=(RADIUS_M * math.cos(turn), RADIUS_M * math.sin(turn), gap_m))
            x, y, z = (lip @ rim).position_m
            if isinstance(shape, Box):
                inside = [abs(v) - size / 2 for v, size in zip((x, y, z), shape.size_m, strict=True)]
            else:
                solid, (a, b, c) = (shape, (x, y, z)) if shape is UPRIGHT else (shape.upright, (y, z, x))
                inside = [math.hypot(a, b) - solid.radius_m, abs(c) - solid.half_height_m]
            assert max(inside) == pytest.approx(0.0, abs=1e-7)
        assert lip.rotate((0.0, 0.0, 1.0)) == pytest.approx(tuple(-v for v in grasp.suction.normal))


def bears(point, centre, weight, tangential_1):
    """True if pulls of a vacuum of 1 N and pressures on the rim of the lip balance a weight: a program of our own."""
    normal = np.array(point.normal)
    first = np.cross(normal, [0.3, 0.5, 0.81])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    # The vacuum pulls the object along the normal, the rim pushes it back, and may not pull.
    moment = np.cross(np.array(centre) - np.array(point.position_m), [0.0, 0.0, -weight])
    turns = np.arange(360) * math.tau / 360
    columns = [[-1.0, *(RADIUS_M * np.array([-math.sin(turn), math.cos(turn)]))] for turn in turns]
    load = [-(weight * normal[2]) + 1.0, moment @ first, moment @ second]
    result = linprog(np.ones(360), A_eq=np.array(columns).T, b_eq=-np.array(load), method="highs")
    return result.status == 0 and weight * math.hypot(normal[0], normal[1]) <= tangential_1


@pytest.mark.parametrize("centre", [CENTRE, (0.01, -0.004, 0.02)])
def test_the_weight_that_a_seal_bears_is_what_pressures_on_its_rim_can_balance(centre):
    for point in suction_points(BOX, 0.015, (0.0, 0.0, 0.0)):
        if point.normal[2] < -0.5:
            continue
        own = replace(point, room_m=1.0)
        share = weight_share(own, centre, RADIUS_M, 0.5)
        assert bears(own, centre, 0.998 * share, 0.5), point
        assert not bears(own, centre, 1.002 * share, 0.5), point


def test_candidates_come_in_the_order_of_the_weight_they_bear():
    found = ranked(BOX).grasps
    assert found[0].approach is Approach.ABOVE
    assert found[0].quality_1 == pytest.approx(1.0)
    assert [one.quality_1 for one in found] == sorted((one.quality_1 for one in found), reverse=True)
    # The ends of a lying cylinder are reached from the side alone.
    assert ranked(LYING, GraspCandidates(approaches=(Approach.ABOVE,))).grasps == ()
    assert {grasp.approach for grasp in ranked(LYING).grasps} == {Approach.SIDE}


def test_a_given_point_is_where_the_tool_enters_a_face():
    down = Pose.from_roll_pitch_yaw((0.005, 0.0, 0.0), (math.pi, 0.0, 0.0))
    point = given_suction_point(BOX, RADIUS_M, down)
    assert point.position_m == pytest.approx((0.005, 0.0, 0.04))
    assert point.normal == pytest.approx((0.0, 0.0, 1.0))
    assert point.room_m == pytest.approx(0.025)
    near_edge = replace(down, position_m=(0.015, 0.0, 0.0))
    assert given_suction_point(BOX, RADIUS_M, near_edge) is None
    oblique = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (math.pi - 0.2, 0.0, 0.0))
    assert given_suction_point(BOX, RADIUS_M, oblique) is None


def test_given_points_are_candidates_and_those_without_a_seal_are_counted():
    down = Pose.from_roll_pitch_yaw((0.005, 0.0, 0.0), (math.pi, 0.0, 0.0))
    given = [
        GivenGrasp(id="label", tool_in_object=down, width_m=0.04),
        GivenGrasp(id="edge", tool_in_object=replace(down, position_m=(0.03, 0.0, 0.0)), width_m=0.04),
    ]
    found = ranked(BOX, grasps=tuple(given))

    assert found.rejected_frames[FrameRejection.SEAL] == 1
    (label,) = [grasp for grasp in found.grasps if grasp.id == "label:00"]
    assert label.quality_1 == pytest.approx(RADIUS_M / (0.005 + RADIUS_M))
    assert isinstance(label.suction, SuctionPoint)


def test_a_mesh_of_a_box_has_the_points_of_the_box():
    mesh = MeshShape(parts_m=corners_of(BOX), sha256="box")
    for one, other in zip(suction_points(mesh, RADIUS_M, CENTRE), suction_points(BOX, RADIUS_M, CENTRE), strict=True):
        assert one.position_m == pytest.approx(other.position_m, abs=1e-9)
        assert one.normal == pytest.approx(other.normal)
