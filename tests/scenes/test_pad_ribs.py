"""The ribs of a pad stand at the ends of the line that the pad touches, inside the finger that they stand for."""

import math
import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.scenes import Box, Cylinder, Gripper, load_gripper, load_scene
from rgss.scenes.assembly import assembled_urdf
from rgss.scenes.grasps.pad_layout import pad_layouts
from rgss.scenes.grasps.rib_geometry import pad_ribs


@pytest.fixture(scope="module")
def geometry(shipped):
    return load_gripper(shipped / "grippers/kg-2.yaml")


def test_they_stand_at_the_ends_of_the_line_of_contact(geometry):
    """Finger from 85 to 175 mm below the flange, its middle at 130; cup of 100 mm at 145 mm: from 95 to 195 mm."""
    ribs = pad_ribs(geometry, Cylinder(radius_m=0.035, height_m=0.1))

    assert ribs.radius_m == pytest.approx(0.003)
    assert ribs.heights_m == pytest.approx((0.095 + 0.003 - 0.130, 0.175 - 0.003 - 0.130))


def test_a_low_object_is_touched_over_all_of_its_height(geometry):
    ribs = pad_ribs(geometry, Cylinder(radius_m=0.035, height_m=0.04))

    assert ribs.heights_m == pytest.approx((0.125 + 0.003 - 0.130, 0.165 - 0.003 - 0.130))


@given(
    thickness=st.floats(0.001, 0.1),
    width=st.floats(0.001, 0.1),
    length=st.floats(0.02, 0.3),
    depth=st.floats(0.001, 0.999),
    height=st.floats(0.001, 1.0),
)
def test_they_are_within_the_finger_and_beside_the_object(geometry, thickness, width, length, depth, height):
    base_m = geometry.base.height_m
    hand = replace(geometry, finger=Box(size_m=(thickness, width, length)), grasp_depth_m=base_m + depth * length)
    cup = Cylinder(radius_m=0.03, height_m=height)
    ribs = pad_ribs(hand, cup)

    low, high = ribs.heights_m
    assert low <= high
    assert 0.0 < ribs.proud_m < ribs.radius_m
    assert 2 * ribs.radius_m < min(thickness, width)
    for rib in ribs.heights_m:
        assert abs(rib) + ribs.radius_m <= length / 2 + 1e-12
        from_centre = base_m + length / 2 + rib - hand.grasp_depth_m
        assert abs(from_centre) + ribs.radius_m <= cup.half_height_m + 1e-12


@pytest.mark.parametrize("fingers", [2, 3])
def test_the_fronts_of_the_ribs_are_where_the_flat_pad_was(shipped, fingers):
    gripper = Gripper(
        geometry=load_gripper(shipped / f"grippers/kg-{fingers}.yaml"),
        base_mass_kg=0.55,
        finger_mass_kg=0.3,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )
    scene = load_scene(shipped / "restaurant.yaml")
    ribs = pad_ribs(gripper.geometry, scene.workpiece.shape)
    flat, ribbed = (
        ET.fromstring(assembled_urdf(scene.robot, gripper, pads=given))  # noqa: S314 - our own text
        for given in ((), pad_layouts(gripper.geometry, scene.workpiece.shape, None))
    )
    thickness, width, length = gripper.geometry.finger.size_m
    for finger in range(fingers):
        link, seen = (root.find(f"link[@name='finger_{finger + 1}']") for root in (ribbed, flat))
        box, *capsules = link.findall("collision")
        size = [float(word) for word in box.find("geometry/box").get("size").split()]
        centre_x = float(box.find("origin").get("xyz").split()[0])
        assert size == pytest.approx([thickness - ribs.proud_m, width, length])
        # The back of the finger stays where it was, and the face between the ribs stands back.
        assert centre_x + size[0] / 2 == pytest.approx(thickness / 2)
        assert centre_x - size[0] / 2 == pytest.approx(-thickness / 2 + ribs.proud_m)
        assert len(capsules) == 2
        for capsule, height in zip(capsules, ribs.heights_m, strict=True):
            x, y, z = (float(word) for word in capsule.find("origin").get("xyz").split())
            roll, pitch, yaw = (float(word) for word in capsule.find("origin").get("rpy").split())
            shape = capsule.find("geometry/capsule")
            assert x - float(shape.get("radius")) == pytest.approx(-thickness / 2)
            assert (y, z) == (0.0, height)
            # A capsule lies along z; turned about x by a right angle it lies across the finger, over its width.
            assert (roll, pitch, yaw) == (math.pi / 2, 0.0, 0.0)
            assert float(shape.get("length")) + 2 * float(shape.get("radius")) == pytest.approx(width)
        # What is seen, what it weighs and where it is joined is the same.
        for part in ("visual", "inertial"):
            assert ET.tostring(link.find(part)) == ET.tostring(seen.find(part))
        assert ET.tostring(ribbed.find(f"joint[@name='finger_{finger + 1}_joint']")) == ET.tostring(
            flat.find(f"joint[@name='finger_{finger + 1}_joint']")
        )
