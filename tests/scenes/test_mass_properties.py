"""Mass properties against closed forms and the engines that use them."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from rgss.kinematics.dynamics import workpiece_load
from rgss.physics.bodies import add_object
from rgss.physics.engine import ClientOwner
from rgss.scenes import (
    Box,
    LyingCylinder,
    MeshShape,
    Pose,
    Workpiece,
    corners_of,
    inertia_kg_m2,
    principal_frame,
    rotation_of,
    solid_moments,
)
from rgss.scenes.mesh_shapes import mesh_mass


def piece(shape, **changes):
    common = {"id": "o", "mass_kg": 2.0, "friction": 1.0, "force_limit_n": 40.0, "colour": (0.0, 0.0, 0.0, 1.0)}
    return Workpiece(shape=shape, pose=Pose(), **common, **changes)


def test_a_box_as_a_mesh_has_the_closed_form(tmp_path):
    size = (0.06, 0.1, 0.04)
    mesh = trimesh.creation.box(extents=np.array(size) * 1e3)
    mesh.apply_translation([10.0, 20.0, 30.0])
    mesh.export(tmp_path / "box.stl")

    found = mesh_mass(tmp_path / "box.stl", scale=0.001)

    x, y, z = size
    closed = ((y**2 + z**2) / 12, (x**2 + z**2) / 12, (x**2 + y**2) / 12)
    assert found.volume_m3 == pytest.approx(x * y * z)
    assert found.centre_m == pytest.approx((0.01, 0.02, 0.03))
    assert found.gyration_m2[:3] == pytest.approx(closed)
    assert found.gyration_m2[3:] == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_a_lying_cylinder_has_its_least_moment_along_x():
    mesh = trimesh.creation.cylinder(radius=0.03, height=0.2, sections=256)
    moments = mesh.moment_inertia * 2.0 / mesh.mass
    found = solid_moments(LyingCylinder(radius_m=0.03, length_m=0.2), 2.0)
    assert found == pytest.approx((moments[2, 2], moments[0, 0], moments[1, 1]), rel=1e-3)


GYRATION = (3e-3, 2e-3, 2.5e-3, 4e-4, -3e-4, 2e-4)
SKEW = {"gyration_m2": GYRATION, "centre_of_mass_m": 0.01, "centre_of_mass_across_m": (0.005, -0.002)}
BOX = Box(size_m=(0.06, 0.1, 0.04))
SKEWED = {
    "box": piece(BOX, **SKEW),
    "mesh": piece(MeshShape(parts_m=corners_of(BOX), sha256="x"), **SKEW),
    "lying": piece(LyingCylinder(radius_m=0.03, length_m=0.1), **SKEW),
}


@pytest.mark.parametrize("name", SKEWED)
def test_the_principal_frame_gives_the_stated_inertia_back(name):
    frame, moments = principal_frame(SKEWED[name])
    axes = rotation_of(frame)
    assert axes @ np.diag(moments) @ axes.T == pytest.approx(inertia_kg_m2(SKEWED[name]), abs=1e-12)
    assert frame.position_m == (0.005, -0.002, 0.01)


@pytest.mark.parametrize("name", SKEWED)
def test_an_engine_body_turns_by_the_stated_inertia(name):
    """A torque about a fixed axis of the free body gives I⁻¹ τ, a force at the centre of mass no turn."""
    workpiece, torque = SKEWED[name], np.array([0.01, -0.02, 0.03])
    with ClientOwner() as owner:
        engine, client = owner._engine, owner._client
        engine.setPhysicsEngineParameter(fixedTimeStep=1e-3, physicsClientId=client)
        body, frame = add_object(engine, client, workpiece)
        at = engine.getBasePositionAndOrientation(body, physicsClientId=client)
        assert at[0] == pytest.approx(frame.position_m, abs=1e-9)
        engine.changeDynamics(body, -1, linearDamping=0, angularDamping=0, physicsClientId=client)
        engine.applyExternalTorque(body, -1, torque.tolist(), engine.WORLD_FRAME, physicsClientId=client)
        engine.stepSimulation(client)
        linear, angular = engine.getBaseVelocity(body, client)
        held = Pose(position_m=at[0], quaternion_xyzw=at[1]) @ frame.inverse()
    assert held.position_m == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert linear == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert np.array(angular) / 1e-3 == pytest.approx(np.linalg.solve(inertia_kg_m2(workpiece), torque), rel=2e-3)


def test_the_load_of_the_arm_has_the_mass_properties_of_the_object():
    load = workpiece_load(SKEWED["box"], Pose(position_m=(0.0, 0.0, 0.2)))
    assert load.pose.position_m == pytest.approx((0.005, -0.002, 0.21))
    axes = rotation_of(load.pose)
    assert axes @ np.diag(load.moments_kg_m2) @ axes.T == pytest.approx(inertia_kg_m2(SKEWED["box"]), abs=1e-12)
