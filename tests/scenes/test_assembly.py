"""The URDF of arm and gripper together, against the design and closed forms."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from rgss.scenes import Box, Cylinder, Gripper, GripperGeometry, Pose, load_gripper, load_scene
from rgss.scenes.assembly import GRIPPER_BASE_LINK, assembled_urdf, finger_joint, finger_link


@pytest.fixture(scope="module")
def arm(shipped):
    return load_scene(shipped / "restaurant.yaml").robot


@pytest.fixture(params=[2, 3])
def gripper(request, shipped):
    return Gripper(
        geometry=load_gripper(shipped / f"grippers/kg-{request.param}.yaml"),
        base_mass_kg=0.55,
        finger_mass_kg=0.3,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )


@pytest.fixture
def assembled(arm, gripper):
    return parsed(assembled_urdf(arm, gripper))


def parsed(urdf: str) -> ET.Element:
    return ET.fromstring(urdf)  # noqa: S314 - our own text


def element(root: ET.Element, kind: str, name: str) -> ET.Element:
    (found,) = (each for each in root.findall(kind) if each.get("name") == name)
    return found


def numbers(found: ET.Element | None, attribute: str) -> tuple[float, ...]:
    assert found is not None
    return tuple(float(word) for word in found.attrib[attribute].split())


def total_mass(root: ET.Element) -> float:
    return sum(numbers(mass, "value")[0] for mass in root.findall("link/inertial/mass"))


def placement(found: ET.Element) -> np.ndarray:
    """The transform of an element's origin, by an independent implementation."""
    transform = np.eye(4)
    origin = found.find("origin")
    transform[:3, 3] = numbers(origin, "xyz")
    transform[:3, :3] = Rotation.from_euler("xyz", numbers(origin, "rpy")).as_matrix()
    return transform


def matrix(pose: Pose) -> np.ndarray:
    transform = np.eye(4)
    transform[:3, 3] = pose.position_m
    transform[:3, :3] = Rotation.from_quat(pose.quaternion_xyzw).as_matrix()
    return transform


def test_the_arm_is_kept_as_it_is(arm, assembled):
    before = parsed(arm.urdf)
    for one, other in zip(before, assembled, strict=False):
        assert ET.canonicalize(ET.tostring(one), strip_text=True) == ET.canonicalize(
            ET.tostring(other), strip_text=True
        )


def test_names_are_unique_and_every_link_hangs_on_one_joint(arm, gripper, assembled):
    links = [link.get("name") for link in assembled.findall("link")]
    joints = [joint.get("name") for joint in assembled.findall("joint")]
    children = [child.get("link") for child in assembled.findall("joint/child")]
    assert len(set(links)) == len(links)
    assert len(set(joints)) == len(joints)
    assert sorted([*children, "base_link"]) == sorted(links)
    assert {parent.get("link") for parent in assembled.findall("joint/parent")} <= set(links)
    added = len(links) - len(parsed(arm.urdf).findall("link"))
    assert added == 1 + gripper.geometry.fingers


def test_masses_sum_to_those_of_arm_and_gripper(arm, gripper, assembled):
    assert total_mass(assembled) == pytest.approx(total_mass(parsed(arm.urdf)) + gripper.mass_kg, rel=1e-12)


def test_the_base_is_a_solid_cylinder_on_the_flange(arm, gripper, assembled):
    base = element(assembled, "link", GRIPPER_BASE_LINK)
    joint = element(assembled, "joint", "gripper_joint")
    shape = gripper.geometry.base
    assert joint.get("type") == "fixed"
    assert joint.find("parent").get("link") == arm.flange
    assert joint.find("child").get("link") == GRIPPER_BASE_LINK
    assert np.array_equal(placement(joint), np.eye(4))
    for part in ("inertial", "collision", "visual"):
        assert np.allclose(placement(base.find(part)), matrix(gripper.geometry.base_pose))
    for part in ("collision", "visual"):
        cylinder = base.find(f"{part}/geometry/cylinder")
        assert numbers(cylinder, "radius") == (shape.radius_m,)
        assert numbers(cylinder, "length") == (shape.height_m,)
    inertia = base.find("inertial/inertia")
    across = gripper.base_mass_kg * (3 * shape.radius_m**2 + shape.height_m**2) / 12
    assert numbers(inertia, "ixx")[0] == numbers(inertia, "iyy")[0] == pytest.approx(across)
    assert numbers(inertia, "izz")[0] == pytest.approx(gripper.base_mass_kg * shape.radius_m**2 / 2)


def test_the_inertia_of_a_finger_is_that_of_its_solid_box(gripper, assembled):
    for finger in range(gripper.geometry.fingers):
        link = element(assembled, "link", finger_link(finger))
        assert numbers(link.find("inertial/mass"), "value") == (0.3,)
        assert np.array_equal(placement(link.find("inertial")), np.eye(4))
        inertia = link.find("inertial/inertia")
        # m (b² + c²) / 12 about each axis, for a box of 12 mm x 20 mm x 90 mm.
        assert numbers(inertia, "ixx")[0] == pytest.approx(0.3 * (0.020**2 + 0.090**2) / 12)
        assert numbers(inertia, "iyy")[0] == pytest.approx(0.3 * (0.012**2 + 0.090**2) / 12)
        assert numbers(inertia, "izz")[0] == pytest.approx(0.3 * (0.012**2 + 0.020**2) / 12)
        assert [numbers(inertia, product) for product in ("ixy", "ixz", "iyz")] == [(0.0,)] * 3
        for part in ("collision", "visual"):
            assert numbers(link.find(f"{part}/geometry/box"), "size") == gripper.geometry.finger.size_m


def test_finger_joints_have_the_limits_of_the_design(gripper, assembled):
    for finger in range(gripper.geometry.fingers):
        joint = element(assembled, "joint", finger_joint(finger))
        limit = joint.find("limit")
        assert joint.get("type") == "prismatic"
        assert joint.find("parent").get("link") == GRIPPER_BASE_LINK
        assert joint.find("child").get("link") == finger_link(finger)
        assert numbers(limit, "lower") == (0.0,)
        assert numbers(limit, "upper") == (gripper.geometry.stroke_m,)
        assert numbers(limit, "velocity") == (gripper.finger_velocity_m_s,)
        assert numbers(limit, "effort") == (gripper.finger_force_n,)


@pytest.mark.parametrize("closed", [0.0, 0.4, 1.0])
def test_fingers_travel_as_the_geometry_says(gripper, assembled, closed):
    geometry = gripper.geometry
    travel = closed * geometry.stroke_m
    for finger in range(geometry.fingers):
        joint = element(assembled, "joint", finger_joint(finger))
        slide = np.eye(4)
        slide[:3, 3] = np.array(numbers(joint.find("axis"), "xyz")) * travel
        expected = matrix(geometry.finger_pose(finger, geometry.largest_opening_m - travel))
        assert np.allclose(placement(joint) @ slide, expected, atol=1e-15)


def test_texts_of_numbers_lose_nothing(gripper, arm):
    odd = Gripper(
        geometry=gripper.geometry,
        base_mass_kg=0.1 + 0.2,
        finger_mass_kg=1 / 3,
        finger_velocity_m_s=1e-7,
        finger_force_n=12345.678901234567,
        friction=0.7,
    )
    root = parsed(assembled_urdf(arm, odd))
    assert numbers(element(root, "link", GRIPPER_BASE_LINK).find("inertial/mass"), "value") == (0.1 + 0.2,)
    assert numbers(element(root, "link", finger_link(0)).find("inertial/mass"), "value") == (1 / 3,)
    assert numbers(element(root, "joint", finger_joint(0)).find("limit"), "velocity") == (1e-7,)
    assert numbers(element(root, "joint", finger_joint(0)).find("limit"), "effort") == (12345.678901234567,)


masses = st.floats(0.01, 10)
lengths = st.floats(0.005, 0.2)


@given(
    masses,
    masses,
    st.lists(st.floats(-10, 10), min_size=2, max_size=5),
    st.tuples(lengths, lengths, lengths),
    lengths,
    lengths,
)
def test_any_gripper_gives_a_sound_machine(arm, base_mass, finger_mass, azimuths, finger, radius, height):
    geometry = GripperGeometry(
        id="any",
        azimuths_rad=tuple(azimuths),
        base=Cylinder(radius_m=radius, height_m=height),
        finger=Box(size_m=finger),
        largest_opening_m=0.07,
        stroke_m=0.05,
        grasp_depth_m=height + finger[2] / 2,
    )
    gripper = Gripper(
        geometry=geometry,
        base_mass_kg=base_mass,
        finger_mass_kg=finger_mass,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )
    root = parsed(assembled_urdf(arm, gripper))
    assert total_mass(root) == pytest.approx(total_mass(parsed(arm.urdf)) + gripper.mass_kg)
    for inertia in root.findall("link/inertial/inertia"):
        # A body's principal moments: none is greater than the two others together.
        x, y, z = (numbers(inertia, axis)[0] for axis in ("ixx", "iyy", "izz"))
        assert 2 * max(x, y, z) <= (x + y + z) * (1 + 1e-12)
    for index, azimuth in enumerate(azimuths):
        yaw = numbers(element(root, "joint", finger_joint(index)).find("origin"), "rpy")[2]
        assert (math.cos(yaw), math.sin(yaw)) == pytest.approx((math.cos(azimuth), math.sin(azimuth)), abs=1e-12)
