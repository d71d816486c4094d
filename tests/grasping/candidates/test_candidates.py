"""Grasp candidates against statics and geometry that are computed apart from them."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import linprog

from rgss.grasping.candidates import contact_points, ranked_grasps, symmetric_turns
from rgss.grasping.candidates.ranking import FrameRejection
from rgss.scenes import (
    Approach,
    Box,
    Cylinder,
    GivenGrasp,
    GraspCandidates,
    LyingCylinder,
    MeshShape,
    Pose,
    Workpiece,
    corners_of,
    load_gripper,
    pad_patches,
)
from tests.trials.hands.gripper_files import linkage_file

GRIPPERS = Path(__file__).resolve().parents[3] / "scenes" / "grippers"
EVERY = GraspCandidates(approaches=tuple(Approach), heights=2, yaws=4, samples=12)
BOX = Box(size_m=(0.06, 0.05, 0.08))
SHAPES = {
    "box": BOX,
    "cylinder": Cylinder(radius_m=0.03, height_m=0.1),
    "lying": LyingCylinder(radius_m=0.03, length_m=0.09),
    "mesh": MeshShape(parts_m=corners_of(BOX), sha256="box"),
}


def hand(fingers):
    return load_gripper(GRIPPERS / f"kg-{fingers}.yaml")


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


@cache
def every_grasp(name, fingers, friction=0.7):
    """Grasps of a shape by a hand, of every approach, the best first."""
    return ranked_grasps(piece(SHAPES[name]), hand(fingers), EVERY, friction=friction).grasps


def resists(points, wrench, friction):
    """True if some forces in pyramids inside the friction cones balance a wrench: a program of our own."""
    columns = []
    for point in points:
        normal = np.array(point.normal)
        first = np.cross(normal, [0.3, 0.5, 0.81])
        first /= np.linalg.norm(first)
        second = np.cross(normal, first)
        for turn in np.arange(12) * math.pi / 6:
            force = normal + friction * (math.cos(turn) * first + math.sin(turn) * second)
            columns.append([*force, *(np.cross(point.position_m, force) / 0.05)])
    matrix = np.array(columns).T
    return linprog(np.ones(matrix.shape[1]), A_eq=matrix, b_eq=-wrench, method="highs").status == 0


@pytest.mark.parametrize("fingers", [2, 3])
@pytest.mark.parametrize("name", SHAPES)
def test_every_candidate_resists_every_unit_wrench(name, fingers):
    geometry = hand(fingers)
    found = every_grasp(name, fingers)

    assert found
    for grasp in (*found[:3], found[-1]):
        patches = pad_patches(SHAPES[name], grasp.tool_in_object, geometry)
        points = contact_points(patches, grasp.tool_in_object, geometry, 0.7)
        for axis in range(6):
            for sign in (1.0, -1.0):
                assert resists(points, sign * np.eye(6)[axis], 0.7), grasp.id


def test_two_fingers_on_frictionless_faces_hold_nothing():
    found = ranked_grasps(piece(BOX), hand(2), EVERY, friction=0.0)
    assert found.grasps == ()
    assert found.rejected_frames[FrameRejection.NO_FORCE_CLOSURE] > 0


@pytest.mark.parametrize("fingers", [2, 3])
@pytest.mark.parametrize("name", SHAPES)
def test_pads_touch_the_surface_and_nothing_is_inside_them(name, fingers):
    """The opening against a dense sample of the solid inside the column of each pad."""
    geometry, shape = hand(fingers), SHAPES[name]
    generator = np.random.default_rng(7)
    (corners,) = corners_of(shape, facets=256)
    weights = generator.dirichlet(np.full(len(corners), 0.05), size=40_000)
    solid = weights @ np.array(corners)
    _, width, length = geometry.finger.size_m
    start = geometry.base.height_m - geometry.grasp_depth_m
    for grasp in every_grasp(name, fingers)[:4]:
        in_tool = grasp.tool_in_object.inverse()
        turned = np.array([in_tool.rotate(axis) for axis in np.eye(3).tolist()])
        points = solid[::20] @ turned + in_tool.position_m
        for azimuth in geometry.azimuths_rad:
            radial = points[:, 0] * math.cos(azimuth) + points[:, 1] * math.sin(azimuth)
            across = -points[:, 0] * math.sin(azimuth) + points[:, 1] * math.cos(azimuth)
            inside = (abs(across) <= width / 2) & (points[:, 2] >= start) & (points[:, 2] <= start + length)
            assert np.max(radial[inside], initial=0.0) <= grasp.opening_m + 2e-5


def test_the_best_grasp_of_a_lopsided_box_is_over_its_centre_of_mass():
    heavy = piece(Box(size_m=(0.06, 0.18, 0.06)), centre_of_mass_across_m=(0.0, 0.05))
    best = ranked_grasps(heavy, hand(2), GraspCandidates(approaches=(Approach.ABOVE,)), friction=0.7).grasps[0]
    assert best.tool_in_object.position_m[1] == pytest.approx(0.05)
    assert best.com_distance_m < 0.02


def test_what_is_wider_than_the_hand_has_no_candidate_and_says_so():
    found = ranked_grasps(piece(Box(size_m=(0.2, 0.3, 0.2))), hand(2), GraspCandidates(), friction=0.7)
    assert found.grasps == ()
    assert found.rejected_frames[FrameRejection.TOO_WIDE] > 0


def test_what_is_thinner_than_the_closed_hand_is_too_narrow():
    found = ranked_grasps(piece(Box(size_m=(0.03, 0.03, 0.03))), hand(2), GraspCandidates(), friction=0.7)
    assert found.rejected_frames[FrameRejection.TOO_NARROW] > 0


def test_a_given_grasp_is_a_candidate_by_its_name():
    frame = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.01), (math.pi, 0.0, 0.0))
    given = GivenGrasp(id="rim", tool_in_object=frame, width_m=0.06)
    options = GraspCandidates(samples=0)
    only, _ = ranked_grasps(piece(SHAPES["mesh"], grasps=(given,)), hand(2), options, friction=0.7).grasps
    assert (only.id, only.approach) == ("rim", Approach.ABOVE)
    assert only.opening_m == pytest.approx(0.03)


def test_the_order_is_the_same_each_time():
    first, second = (ranked_grasps(piece(SHAPES["mesh"]), hand(2), EVERY, friction=0.6) for _ in range(2))
    assert first == second


@pytest.mark.parametrize(
    ("shape", "count"),
    [(BOX, 2), (Box(size_m=(0.05, 0.05, 0.1)), 4), (SHAPES["lying"], 2), (SHAPES["cylinder"], 8), (SHAPES["mesh"], 1)],
)
def test_a_symmetric_turn_leaves_the_shape_where_it_was(shape, count):
    turns = symmetric_turns(shape, 8)
    assert len(turns) == count
    if isinstance(shape, Box):
        corners = np.array(corners_of(shape)[0])
        for turn in turns:
            c, s = math.cos(turn), math.sin(turn)
            turned = corners @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T
            distances = np.linalg.norm(turned[:, None] - corners[None], axis=2)
            assert np.max(np.min(distances, axis=1)) < 1e-12


@pytest.mark.parametrize("fingers", [2, 3])
@pytest.mark.parametrize("name", ["box", "cylinder", "mesh"])
@pytest.mark.parametrize("height_m", [0.02, 0.04, 0.06])
def test_low_objects_are_held_with_the_ends_of_the_fingers(name, fingers, height_m):
    """The fingers end 30 mm below the grasp centre: from there down they would be in the table."""
    geometry, clearance_m = hand(fingers), 0.008
    flat = Box(size_m=(0.06, 0.056, height_m))
    shape = {
        "box": flat,
        "cylinder": Cylinder(radius_m=0.03, height_m=height_m),
        "mesh": MeshShape(parts_m=corners_of(flat), sha256="flat"),
    }[name]
    options = GraspCandidates(approaches=(Approach.ABOVE,), heights=3, yaws=4, samples=24)
    found = ranked_grasps(piece(shape), geometry, options, friction=0.7, clearance_m=clearance_m).grasps
    assert found
    for grasp in found:
        tool = grasp.tool_in_object
        tips = [
            (tool @ Pose(position_m=(x, y, geometry.base.height_m + 0.09 - geometry.grasp_depth_m))).position_m[2]
            for x in (-0.07, 0.07)
            for y in (-0.07, 0.07)
        ]
        assert min(tips) + height_m / 2 >= clearance_m
        held_m = height_m - (min(tips) + height_m / 2)
        assert held_m > 0.004
        for patch in pad_patches(shape, tool, geometry):
            assert patch.along_m[1] - patch.along_m[0] == pytest.approx(min(held_m, height_m), abs=5e-3)


def test_an_object_too_low_for_the_ends_of_the_fingers_keeps_its_grasps():
    """12 mm less 9 mm of clearance leave less than 5 mm to hold; the check then names the table."""
    low, options = piece(Box(size_m=(0.06, 0.056, 0.012))), GraspCandidates(approaches=(Approach.ABOVE,))
    kept = ranked_grasps(low, hand(2), options, friction=0.7, clearance_m=0.008)
    assert replace(kept, too_low="") == ranked_grasps(low, hand(2), options, friction=0.7)


def test_an_object_that_is_too_low_for_the_ends_of_the_fingers_says_why():
    """Of a plate of 12 mm, fingers that end 9 mm above its support hold 3 mm, and of one of 14 mm the 5 mm needed."""

    def reason_of(height_m, **changes):
        plate = piece(Box(size_m=(0.09, 0.06, height_m)))
        return ranked_grasps(plate, hand(2), replace(EVERY, **changes), friction=0.7, clearance_m=0.008).too_low

    assert reason_of(0.012) == (
        "from above, fingers that keep the clearance of 8 mm from its support hold 3 mm of its height of 12 mm, and "
        "need 5 mm"
    )
    assert "hold none of its height of 4 mm" in reason_of(0.004)
    assert reason_of(0.0141) == reason_of(0.012, approaches=(Approach.SIDE,)) == ""


def test_a_given_grasp_is_not_raised():
    given = GivenGrasp(
        id="mine", tool_in_object=Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (math.pi, 0.0, 0.0)), width_m=0.056
    )
    low = piece(Box(size_m=(0.06, 0.056, 0.03)), grasps=(given,))
    found = ranked_grasps(low, hand(2), GraspCandidates(approaches=(Approach.ABOVE,)), friction=0.7, clearance_m=0.008)
    (mine,) = (grasp for grasp in found.grasps if grasp.id == "mine")
    assert mine.tool_in_object.position_m[2] == pytest.approx(0.0, abs=1e-9)
    assert all(grasp.id.endswith(":tips") for grasp in found.grasps if not grasp.id.startswith("mine"))


def _axes(pose):
    return np.array([pose.position_m, pose.rotate((1.0, 0.0, 0.0)), pose.rotate((0.0, 0.0, 1.0))])


@pytest.mark.parametrize("name", SHAPES)
def test_the_half_turn_of_each_candidate_of_two_fingers_is_one_of_the_same_quality(name):
    found = every_grasp(name, 2, friction=0.8)
    assert found
    poses = np.array([_axes(one.tool_in_object) for one in found])
    for one, axes in zip(found, poses, strict=True):
        # The first finger where the second one was; position and approach are the same.
        partner = np.flatnonzero(np.abs(poses - axes * [[1.0], [-1.0], [1.0]]).max(axis=(1, 2)) < 1e-6)
        assert len(partner) >= 1
        assert found[partner[0]].quality_1 == pytest.approx(one.quality_1, rel=1e-6)
        assert found[partner[0]].opening_m == pytest.approx(one.opening_m, abs=1e-9)


def test_a_given_grasp_is_tried_with_either_pad_first_and_three_fingers_have_no_half_turn(tmp_path):
    down = Pose(quaternion_xyzw=(1.0, 0.0, 0.0, 0.0))
    given = piece(SHAPES["mesh"], grasps=(GivenGrasp(id="top", tool_in_object=down, width_m=0.05),))
    alone = GraspCandidates(approaches=(Approach.ABOVE,), samples=0)
    two, three = (ranked_grasps(given, hand(count), alone, friction=0.8).grasps for count in (2, 3))
    cranks = ranked_grasps(given, linkage_file(tmp_path).geometry, alone, friction=0.8).grasps
    assert [one.id for one in two] == [one.id for one in cranks] == ["top", "top:turned"]
    for first, turned in ([one.tool_in_object for one in found] for found in (two, cranks)):
        assert turned.position_m == pytest.approx(first.position_m, abs=1e-9)
        assert turned.rotate((1.0, 0.0, 0.0)) == pytest.approx([-x for x in first.rotate((1.0, 0.0, 0.0))], abs=1e-9)
        assert turned.rotate((0.0, 0.0, 1.0)) == pytest.approx(first.rotate((0.0, 0.0, 1.0)), abs=1e-9)
    assert not any(one.id.endswith(":turned") for one in three)
