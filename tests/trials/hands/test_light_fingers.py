"""Fingers of 20 g hold their force and lift what Coulomb's law says, with and without the inertia of a drive."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from rgss.physics import PhysicsSettings
from rgss.scenes import GripperDrive, assembled_urdf
from rgss.trials.payload_bench.of_trial import payload_bench
from rgss.trials.payload_bench.rig import PayloadLimit, PayloadRig, probe


@pytest.fixture
def light(spec_of):
    """Makes the bench of fingers of 20 g with the inertia of their drives, at a rate."""

    def make(drive_kg, rate_hz):
        spec = spec_of()
        gripper = replace(spec.gripper, base_mass_kg=0.8, finger_mass_kg=0.02, drive=GripperDrive(inertia_kg=drive_kg))
        bench = payload_bench(replace(spec, gripper=gripper))
        return replace(bench, physics=PhysicsSettings(rate_hz=rate_hz))

    return make


@pytest.mark.parametrize("rate_hz", [240.0, 960.0])
@pytest.mark.parametrize("drive_kg", [0.0, 0.1])
def test_light_fingers_hold_their_force_and_payload(light, drive_kg, rate_hz):
    bench = light(drive_kg, rate_hz)
    with PayloadRig(bench, 0.5) as rig:
        rig.grasp()
        forces_n = [rig.contacts().finger_forces_n]
        for _ in range(20):
            rig.accelerate(0.0, 0.05)
            forces_n.append(rig.contacts().finger_forces_n)

    assert np.array(forces_n) == pytest.approx(bench.gripper.finger_force_n, rel=1e-3)
    assert probe(bench, 0.985 * bench.theory_kg).held
    assert probe(bench, 1.015 * bench.theory_kg).stopped_by is PayloadLimit.SLIP


@pytest.mark.parametrize("variant", [65, 30])
def test_the_inertia_of_drives_moves_no_mass_of_the_open_gripper(spec_of, variant):
    spec = spec_of(variant)
    gripper = replace(spec.gripper, base_mass_kg=0.8, drive=GripperDrive(inertia_kg=0.1))
    robot = spec.scene.robot
    plain, driven = (_mass_and_centre(assembled_urdf(robot, gripper, has_drives=drives)) for drives in (False, True))

    assert driven[0] == pytest.approx(plain[0])
    assert driven[1] == pytest.approx(plain[1], abs=1e-9)


def _mass_and_centre(urdf):
    """Mass and centre of mass of the gripper's links, open, in the frame of the flange."""
    root = ET.fromstring(urdf)  # noqa: S314 - the text is made here
    frames = {"gripper_base": (np.zeros(3), 0.0)}
    for joint in root.iter("joint"):
        if joint.find("parent").get("link") == "gripper_base":
            origin = joint.find("origin")
            yaw = float(origin.get("rpy").split()[2])
            frames[joint.find("child").get("link")] = (np.array(origin.get("xyz").split(), dtype=float), yaw)
    masses, centres = [], []
    for name, (position, yaw) in frames.items():
        inertial = root.find(f"link[@name='{name}']/inertial")
        own = np.array(inertial.find("origin").get("xyz").split(), dtype=float)
        turned = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
        masses.append(float(inertial.find("mass").get("value")))
        centres.append(position + turned @ own)
    return sum(masses), np.average(centres, axis=0, weights=masses)
