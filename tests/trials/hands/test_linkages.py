"""The drive of a linkage: joints follow within a bound, and pads press with what virtual work gives."""

from __future__ import annotations

import copy
import math
import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest

from rgss.kinematics import gripper_loads
from rgss.physics.hands import least_iterations
from rgss.scenes import LinkageMotion, assembled_urdf, at_opening, finger_pads, load_gripper_file
from rgss.trials.payload_bench.rig import PayloadRig, probe
from rgss.trials.second_engine import mujoco_settings
from tests.trials.hands.gripper_files import FILES, HELD, gripper_of, linkage_file, with_thin_pads

MASS_KG = 0.3


# As docs/grippers.md states them: rad by which a joint is off while an object is closed on and held.
@pytest.mark.parametrize(("rate_hz", "bound_rad"), [(240.0, 5e-4), (960.0, 5e-6), (None, 1e-5)])
def test_joints_follow_while_the_hand_closes_and_holds(bench, rate_hz, bound_rad):
    """Without a rate, in MuJoCo."""
    spec = bench(rate_hz) if rate_hz else replace(bench(), physics=mujoco_settings())
    with PayloadRig(spec, MASS_KG) as rig:
        world, worst_rad = rig._world, 0.0
        step = world.step

        def watched():
            nonlocal worst_rad
            step()
            worst_rad = max(worst_rad, world.follow_error)

        world.step = watched
        rig.grasp()
        rig.accelerate(1.0, 0.3)

    assert rig.stopped_by is None
    assert 0.0 < worst_rad < bound_rad


@pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
@pytest.mark.parametrize("force_n", [6.0, 15.0])
def test_pads_press_with_what_virtual_work_gives(bench, force_n, engine):
    """Torque 2 J F balances the pads' force F; what hangs on the mechanism adds its share along the arcs."""
    spec = bench(960.0, force_n)
    spec = spec if engine == "pybullet" else replace(spec, physics=mujoco_settings())
    linkage = spec.gripper.geometry.linkage
    with PayloadRig(spec, MASS_KG) as rig:
        rig.grasp()
        rig.accelerate(0.5, 0.2)
        rig.accelerate(0.0, 0.3)
        sums_n = []
        for _ in range(20):
            rig.accelerate(0.0, 0.01)
            sums_n.append(rig.contacts().finger_force_sum_n)

    motion = LinkageMotion(linkage)
    driven = motion.driven_at(motion.largest_opening_m - HELD.radius_m)
    small = 1e-4
    arm_m = motion.transmission(driven)
    lowered_m = (linkage.depth_m(driven + small) - linkage.depth_m(driven - small)) / (2 * small)
    loads = [
        gripper_loads(spec.gripper, motion.largest_opening_m - motion.travel_m(at))
        for at in (driven - small, driven + small)
    ]
    work = math.fsum(
        after.mass_kg * (after.pose.position_m[2] - before.pose.position_m[2]) / (2 * small)
        for before, after in zip(*loads, strict=True)
    )
    weights_n_m = spec.gravity_m_s2 * (MASS_KG * lowered_m + work)
    expected_n = 2 * force_n + weights_n_m / arm_m

    assert sum(sums_n) / len(sums_n) == pytest.approx(expected_n, rel=0.005)
    # The share of the weights is no noise.
    assert abs(expected_n - 2 * force_n) > 0.2


@pytest.mark.parametrize("radius_m", [0.015, 0.035])
def test_a_wide_object_is_held_although_friction_takes_a_part_of_the_force(bench, radius_m):
    """Pads that slide along the object while they close press with F / (1 + mu s) at least, and with F at most."""
    spec = bench(240.0, 12.0)
    geometry = at_opening(spec.gripper.geometry, radius_m)
    wide = replace(spec, shape=replace(HELD, radius_m=radius_m), gripper=replace(spec.gripper, geometry=geometry))
    sine = (radius_m - 0.012) / math.hypot(0.0325, 0.0463)
    slope = sine / math.sqrt(1.0 - sine**2)
    motion = LinkageMotion(geometry.linkage)
    assert motion.axial_slope(motion.driven_at(motion.largest_opening_m - radius_m)) == pytest.approx(slope, rel=0.02)
    with PayloadRig(wide, MASS_KG) as rig:
        rig.grasp()
        forces_n = rig.contacts().finger_forces_n
    assert rig.stopped_by is None
    assert 12.0 / (1.0 + wide.friction * slope) * 0.95 < sum(forces_n) / 2 < 12.0 * 1.05
    assert probe(wide, MASS_KG).held


def test_the_effort_of_the_joint_limits_the_force(bench):
    strong = bench(240.0, 100.0)
    linkage = strong.gripper.geometry.linkage
    motion = LinkageMotion(linkage)
    driven = motion.driven_at(motion.largest_opening_m - HELD.radius_m)
    with PayloadRig(replace(strong, force_limit_n=1e3), MASS_KG) as rig:
        world = rig._world
        world.drive_fingers(0.04, 100.0)
        for _ in range(240):
            world.step()
        pressed_n = world.contacts().finger_force_sum_n

    assert pressed_n == pytest.approx(linkage.effort / motion.transmission(driven), rel=0.05)


def test_the_solver_takes_the_iterations_that_gears_need(bench):
    linkage = bench().gripper.geometry.linkage
    assert [link.kind is None for link in linkage.links].count(False) == 4
    assert bench().physics.solver_iterations < least_iterations(linkage) == 1200


def test_what_carries_a_pad_is_of_its_finger(bench, spec_of, tmp_path):
    """Pads of their own, 0.3 mm before the tips: no other force, and that of virtual work as without them."""
    sums_n = {}
    for name in ("plain", "thin pads"):
        spec = bench(960.0, 15.0)
        if name == "thin pads":
            path = tmp_path / "two_finger.urdf"
            path.write_text(with_thin_pads(path.read_text(encoding="utf-8")), encoding="utf-8")
            text = FILES["linkage"].replace("left_tip, right_tip", "left_pad, right_pad")
            (tmp_path / "own.yaml").write_text(text, encoding="utf-8")
            geometry = at_opening(load_gripper_file(tmp_path / "own.yaml").geometry, HELD.radius_m)
            spec = replace(spec, gripper=replace(spec.gripper, geometry=geometry))
            linkage = geometry.linkage
            of_fingers = [[linkage.links[part].name for part in parts] for parts in linkage.finger_parts]
            assert of_fingers == [["left_tip", "left_pad"], ["right_tip", "right_pad"]]
        others_n, found_n = [], []
        with PayloadRig(spec, MASS_KG) as rig:
            rig.grasp()
            for _ in range(30):
                rig.accelerate(2.0, 0.01)
                others_n.append(rig.contacts().other_force_n)
                found_n.append(rig.contacts().finger_force_sum_n)
        assert (rig.stopped_by, max(others_n)) == (None, 0.0)
        sums_n[name] = sum(found_n) / len(found_n)
    assert sums_n["thin pads"] == pytest.approx(sums_n["plain"], rel=0.02)


def test_loads_are_the_masses_of_the_links(tmp_path):
    gripper = replace(gripper_of(tmp_path, "linkage"), base_mass_kg=1.2, finger_mass_kg=0.18)
    loads = gripper_loads(gripper, gripper.geometry.largest_opening_m)

    # Twice what the URDF has of the palm, and twice of what moves.
    assert [load.mass_kg for load in loads] == pytest.approx([1.2, 0.08, 0.08, 0.1, 0.1])
    assert math.fsum(load.mass_kg for load in loads) == pytest.approx(gripper.mass_kg)
    crank, tip = loads[1], loads[3]
    assert crank.pose.position_m == pytest.approx((0.012 + 0.01625, 0.0, 0.07 + 0.02315))
    assert tip.pose.position_m == pytest.approx((0.0445 + 0.005, 0.0, 0.1163 + 0.025))
    assert sorted(tip.moments_kg_m2) == pytest.approx([6e-6, 2.4e-5, 2.6e-5])


def test_a_layer_of_a_pad_is_left_to_its_contact_elements(spec_of, tmp_path):
    """What lies within the margin behind a face would be flattened to a plane, which is no solid."""
    names, layers = ("left_tip", "right_tip"), {}
    for name in ("plain", "with a layer"):
        folder = tmp_path / name
        folder.mkdir()
        linkage_file(folder)
        urdf = ET.parse(folder / "two_finger.urdf")  # noqa: S314 - written here
        for link in (urdf.find(f"link[@name='{one}']") for one in names) if name != "plain" else ():
            # A tenth of a millimetre of the tip's own box; the tips face each other along x of their frames.
            layer = copy.deepcopy(link.find("collision"))
            depth, width, length = (float(word) for word in layer.find("geometry/box").get("size").split())
            layer.find("geometry/box").set("size", f"1e-4 {width} {length}")
            x, y, z = (float(word) for word in layer.find("origin").get("xyz").split())
            layer.find("origin").set("xyz", f"{x - (depth - 1e-4) / 2} {y} {z}")
            link.append(layer)
        urdf.write(folder / "two_finger.urdf")
        geometry = at_opening(load_gripper_file(folder / "gripper.yaml").geometry, HELD.radius_m)
        gripper = replace(gripper_of(tmp_path, "linkage"), geometry=geometry)
        scene = replace(spec_of().scene, workpiece=replace(spec_of().scene.workpiece, shape=HELD))
        text = assembled_urdf(scene.robot, gripper, pads=finger_pads(scene, geometry))
        root = ET.fromstring(text)  # noqa: S314 - our own text
        layers[name] = [
            [len(root.findall(f"link[@name='finger_{finger}']/{tag}")) for tag in ("collision", "visual")]
            for finger in (1, 2)
        ]
    (collisions, seen), _ = layers["plain"]
    assert layers["plain"][0] == layers["plain"][1]
    assert layers["with a layer"] == [[collisions, seen + 1]] * 2
