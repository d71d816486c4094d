"""Linkages of which a link is far lighter than the others: the pads press all the same, or the user is told."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pybullet
import pytest

from rgss.physics import PhysicsSettings, light_fingers, light_object
from rgss.scenes import at_opening, leading_joint, load_gripper_file, pad_mass_kg, reflected_inertias
from rgss.trials.payload_bench.rig import PayloadRig
from rgss.trials.second_engine import mujoco_settings
from tests.scenes.linkage_texts import FILE, JAWS
from tests.trials.hands.gripper_files import FILES, HELD, TWO_FINGER, gripper_of

pytestmark = pytest.mark.engine

MASS_KG = 0.3


def with_command_joint(urdf: str, inertial: str = "", multiplier: float = 1.0) -> str:
    """The cranks, both of which follow a joint of a link without a shape, at a ratio."""
    mimic = f'<mimic joint="finger_joint" multiplier="{multiplier}"/>'
    urdf = urdf.replace('name="finger_joint"', 'name="left_crank_joint"')
    head, tail = urdf.split('velocity="1.5"/>', 1)
    urdf = f'{head}velocity="1.5"/>{mimic}{tail}'
    urdf = urdf.replace('<mimic joint="finger_joint" multiplier="1"/>', mimic)
    urdf = urdf.replace('<mimic joint="finger_joint" multiplier="-1"/>', mimic.replace('r="', 'r="-'))
    command = f"""
  <link name="command">{inertial}</link>
  <joint name="finger_joint" type="revolute">
    <origin xyz="0 0 0.02"/><parent link="palm"/><child link="command"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="{0.7 / multiplier}" effort="{2.0 * multiplier}" velocity="{1.5 / multiplier}"/>
  </joint>"""
    return urdf.replace("</robot>", f"{command}\n</robot>")


def of_mass(mass_kg: float) -> str:
    """Inertia of a cube of 10 mm."""
    moment = mass_kg * 1e-4 / 6
    moments = " ".join(f'{key}="{moment}"' for key in ("ixx", "iyy", "izz"))
    return f'<inertial><mass value="{mass_kg}"/><inertia {moments} ixy="0" ixz="0" iyz="0"/></inertial>'


def scaled(urdf: str, links: tuple[str, ...], share: float) -> str:
    """A URDF in which links have a share of their masses and inertias."""
    root = ET.fromstring(urdf)  # noqa: S314 - a URDF of the test
    for link in root.findall("link"):
        if link.get("name") in links:
            for element in (link.find("inertial/mass"), link.find("inertial/inertia")):
                for key, value in element.items():
                    element.set(key, str(float(value) * share))
    return ET.tostring(root, encoding="unicode")


@pytest.fixture
def linkage_of(tmp_path):
    """Reads the linkage of a URDF of the cranks."""

    def read(urdf):
        (tmp_path / TWO_FINGER.name).write_text(urdf, encoding="utf-8")
        (tmp_path / "own.yaml").write_text(FILES["linkage"], encoding="utf-8")
        return at_opening(load_gripper_file(tmp_path / "own.yaml").geometry, HELD.radius_m)

    return read


@pytest.fixture
def pressed_n(bench, linkage_of):
    """Measures the force of both pads on a held object that hangs still, and its slip in m."""

    def measure(urdf, physics=None):
        spec = bench(240.0, 12.0)
        spec = replace(spec, gripper=replace(spec.gripper, geometry=linkage_of(urdf)), physics=physics or spec.physics)
        with PayloadRig(spec, MASS_KG) as rig:
            rig.grasp()
            rig.accelerate(0.5, 0.2)
            rig.accelerate(0.0, 0.3)
            assert rig.stopped_by is None
            return rig.contacts().finger_force_sum_n, rig.slip_m

    return measure


@pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
@pytest.mark.parametrize("multiplier", [1.0, 2.0])
@pytest.mark.parametrize("inertial", ["", of_mass(1e-3), of_mass(0.03)], ids=["no mass", "1 g", "30 g"])
def test_a_joint_that_stands_for_the_command_changes_no_force(pressed_n, inertial, multiplier, engine):
    physics = mujoco_settings() if engine == "mujoco" else None
    plain_n, _ = pressed_n(TWO_FINGER.read_text(encoding="utf-8"), physics)
    with_command = with_command_joint(TWO_FINGER.read_text(encoding="utf-8"), inertial, multiplier)
    found_n, slip_m = pressed_n(with_command, physics)
    assert found_n == pytest.approx(plain_n, rel=1e-3)
    assert slip_m < 2e-5


def test_the_leading_joint_is_the_driven_one_unless_another_carries_far_more(linkage_of):
    plain = linkage_of(TWO_FINGER.read_text(encoding="utf-8")).linkage
    assert leading_joint(plain) == plain.driven

    virtual = linkage_of(with_command_joint(TWO_FINGER.read_text(encoding="utf-8"), of_mass(1e-3))).linkage
    assert virtual.links[virtual.driven].name == "command"
    assert virtual.links[leading_joint(virtual)].name in {"left_crank", "right_crank"}


@pytest.mark.parametrize("multiplier", [1.0, 2.0])
def test_reflected_inertias_are_the_diagonal_of_the_inertia_matrix(linkage_of, tmp_path, multiplier):
    """The matrix is the engine's, of the URDF on a fixed base, without code of ours."""
    urdf = with_command_joint(TWO_FINGER.read_text(encoding="utf-8"), of_mass(0.02), multiplier)
    linkage = linkage_of(urdf).linkage
    (tmp_path / "oracle.urdf").write_text(urdf, encoding="utf-8")
    client = pybullet.connect(pybullet.DIRECT)
    flags = pybullet.URDF_USE_INERTIA_FROM_FILE
    body = pybullet.loadURDF(str(tmp_path / "oracle.urdf"), useFixedBase=True, flags=flags, physicsClientId=client)
    names = [pybullet.getJointInfo(body, at, client)[12].decode() for at in range(pybullet.getNumJoints(body, client))]
    of = {link.name: index for index, link in enumerate(linkage.links)}
    middle = (linkage.opened + linkage.closed) / 2
    positions = [linkage.joint_position(of[name], middle) for name in names]
    matrix = np.array(pybullet.calculateMassMatrix(body, positions, physicsClientId=client))
    pybullet.disconnect(client)

    expected = {of[name]: matrix[at, at] * linkage.links[of[name]].multiplier ** 2 for at, name in enumerate(names)}
    assert dict(reflected_inertias(linkage)) == pytest.approx(expected, rel=1e-5)


def test_the_mass_at_a_sliding_pad_is_that_of_the_lighter_finger(tmp_path):
    urdf = scaled(JAWS, ("right",), 0.5)
    (tmp_path / "jaws.urdf").write_text(urdf, encoding="utf-8")
    (tmp_path / "gripper.yaml").write_text(FILE, encoding="utf-8")
    linkage = load_gripper_file(tmp_path / "gripper.yaml").geometry.linkage
    assert pad_mass_kg(linkage) == pytest.approx(0.025)


def test_fingers_too_light_for_the_solver_are_told_with_the_rate_that_helps(bench, linkage_of):
    """At the bound a cup is held as at four times the rate, and far below it it is not."""
    links = ("left_crank", "right_crank", "left_tip", "right_tip")
    spec = bench(240.0, 12.0)
    for share, is_light in ((1.0, False), (0.2, False), (0.05, True)):
        geometry = linkage_of(scaled(TWO_FINGER.read_text(encoding="utf-8"), links, share))
        gripper = replace(spec.gripper, geometry=geometry, finger_mass_kg=spec.gripper.finger_mass_kg * share)
        assert gripper.driven_mass_kg == pytest.approx(spec.gripper.driven_mass_kg * share)
        told = light_fingers(gripper, spec.physics)
        assert (told is not None) == is_light
        with PayloadRig(
            replace(spec, gripper=gripper, physics=replace(spec, gripper=gripper).physics_for(1.0)), 0.3
        ) as rig:
            rig.grasp()
            rig.accelerate(0.5, 0.2)
            assert (rig.slip_m > 2e-4 or rig.stopped_by is not None) == is_light
    assert told == (
        "fingers of 0.00618 kg at their pads are too light for the solver to press with 12 N; it needs 0.0075 kg",
        "give their links the masses and inertias of the real ones, or increase the physics rate",
    )
    assert light_fingers(gripper, replace(spec.physics, rate_hz=480.0)) is None


def test_sliding_fingers_and_objects_too_light_for_the_solver_are_told(tmp_path):
    gripper = replace(gripper_of(tmp_path, "fingers"), finger_mass_kg=0.001)
    physics = PhysicsSettings()
    assert light_fingers(gripper, physics) == (
        "fingers of 0.001 kg are too light for the solver to press with 10 N; it needs 0.00104 kg",
        "state their drive_inertia, or increase the physics rate",
    )
    assert light_object(0.001, gripper, physics) == (
        "0.001 kg are too light for the solver to press with 10 N on it; it needs 0.00104 kg",
        "lower the force of the fingers, or increase the physics rate",
    )
    assert light_object(0.0011, gripper, physics) is None
    cup = gripper_of(tmp_path, "vacuum")
    assert (light_fingers(cup, physics), light_object(1e-4, cup, physics)) == (None, None)
