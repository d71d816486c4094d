"""Two engines judge the same states: Coal, which plans, and PyBullet, in which it runs."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.kinematics import CollisionContext, CollisionModel
from rgss.physics import World

pytestmark = pytest.mark.engine

STATES = 2000
NEAR_TOUCHING_M = 0.002


@pytest.mark.verifies("SYS-020")
@pytest.mark.parametrize("variant", [1, 65], ids=["three fingers", "two fingers"])
def test_collision_verdicts_agree_away_from_touching(spec_of, variant):
    spec = spec_of(variant)
    scene, geometry = spec.scene, spec.gripper.geometry
    coal = CollisionModel(
        scene, geometry, CollisionContext(opening_m=geometry.largest_opening_m, standing=scene.workpiece.pose)
    )
    outside = {scene.workpiece.id, *(body.id for body in scene.bodies)}
    lower = [joint.lower_rad for joint in scene.robot.joints]
    upper = [joint.upper_rad for joint in scene.robot.joints]
    generator = np.random.default_rng(20)
    verdicts = []
    with World(scene, spec.gripper, spec.settings.physics) as world:
        while len(verdicts) < STATES:
            state = generator.uniform(lower, upper)
            distance = distance_to(coal, state, outside)
            if abs(distance) > NEAR_TOUCHING_M:
                verdicts.append((distance < 0.0, touches(world, state)))

    assert [index for index, (one, other) in enumerate(verdicts) if one is not other] == []
    assert 0.1 < np.mean([one for one, _ in verdicts]) < 0.9


def distance_to(model, state, names):
    """Distance of the robot from the scene and the workpiece, by Coal; its own links are left out."""
    model.distance(state)
    results = zip(model._pairs, model._state.distanceResults, strict=True)
    return min(float(result.min_distance) for pair, result in results if not names.isdisjoint(pair))


def touches(world, state):
    """Whether the robot touches anything, by PyBullet."""
    engine, client = world._engine, world._client
    world.reset_arm(state.tolist())
    engine.performCollisionDetection(physicsClientId=client)
    points = engine.getContactPoints(bodyA=world._robot, physicsClientId=client)
    return any(point[8] < 0.0 for point in points)
