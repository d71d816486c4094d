"""The trial of a kind of gripper, and the bench of the cranks."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.physics import PhysicsSettings
from rgss.scenes import Pose
from rgss.trials.payload_bench.of_trial import payload_bench
from tests.trials.hands.gripper_files import HELD, gripper_of


@pytest.fixture
def trial(spec_of, tmp_path):
    """Makes the trial of a kind of gripper with an object, at a fidelity."""

    def make(name, fidelity, *, radius_m=HELD.radius_m, mass_kg=0.1):
        base = spec_of()
        shape = replace(HELD, radius_m=radius_m)
        own = base.scene.workpiece
        x, y, z = own.pose.position_m
        lowered_m = own.shape.half_height_m - shape.half_height_m
        workpiece = replace(own, shape=shape, mass_kg=mass_kg, pose=Pose(position_m=(x, y, z - lowered_m)))
        planning = replace(base.settings.planning, clearance_m=5.0e-4)
        return replace(
            base,
            scene=replace(base.scene, workpiece=workpiece),
            gripper=gripper_of(tmp_path, name, shape),
            fidelity=fidelity,
            settings=replace(base.settings, planning=planning),
        )

    return make


@pytest.fixture
def bench(spec_of, tmp_path):
    """Makes the bench of the cranks with an object, at a rate and with other forces of the pads."""

    def make(rate_hz=240.0, force_n=None):
        spec = spec_of()
        gripper = gripper_of(tmp_path, "linkage")
        if force_n is not None:
            gripper = replace(gripper, finger_force_n=force_n)
        scene = replace(spec.scene, workpiece=replace(spec.scene.workpiece, shape=HELD))
        bench = payload_bench(replace(spec, gripper=gripper, scene=scene))
        return replace(bench, physics=PhysicsSettings(rate_hz=rate_hz))

    return make
