"""Trials of two objects."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.scenes import PlaceRegion, SceneObject
from rgss.tasks import load_task
from tests.trials.objects.two_objects import CANDIDATES, CARTON, STEPS, TIN, on_the_ground


@pytest.fixture(scope="session")
def with_two(spec_of, tmp_path_factory):
    """Makes the nominal trial of a variant with a carton and a tin beside it."""

    def make(variant=65, order="cup, tin", tin=TIN, aside_m=-0.15, **carton):
        spec = spec_of(variant)
        scene = spec.scene
        own, foot_m = scene.workpiece, scene.workpiece.pose.position_m[2] - scene.workpiece.shape.half_height_m
        x, y, z = scene.place.centre_m
        centred = {"centre_of_mass_m": 0.0, "gyration_m2": None}
        carton = replace(
            own, shape=CARTON, pose=on_the_ground(own.pose, CARTON, foot_m=foot_m), **{**centred, **carton}
        )
        other = replace(own, id="tin", shape=tin, pose=on_the_ground(own.pose, tin, foot_m=foot_m, aside_m=aside_m))
        further = SceneObject(
            workpiece=replace(other, mass_kg=0.15, **centred),
            support=scene.support,
            place=PlaceRegion(centre_m=(x - 0.15, y, z), radius_m=0.02, largest_tilt_rad=0.1),
            place_support=scene.place_support,
        )
        path = tmp_path_factory.mktemp("task") / "two.yaml"
        path.write_text(STEPS.format(objects=order.replace("cup", own.id)), encoding="utf-8")
        return replace(
            spec,
            scene=replace(scene, workpiece=carton, others=(further,), task=replace(scene.task, candidates=CANDIDATES)),
            task=load_task(path).program,
            settings=replace(spec.settings, planning=replace(spec.settings.planning, moves=())),
            planner="RRTConnect",
            planner_settings=None,
            planning_limit_s=8.0,
        )

    return make
