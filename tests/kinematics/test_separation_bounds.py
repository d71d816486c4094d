"""Bounds of distances never exceed the distances, whatever the shapes and wherever they are."""

from __future__ import annotations

import math

import coal
import numpy as np
import pinocchio
import pytest

from rgss.kinematics.separation_bounds import SeparationBounds

pytestmark = pytest.mark.engine


def shape(rng):
    """A solid of random kind and size."""
    a, b, c = rng.uniform(0.01, 0.8, 3)
    return (
        coal.Box(a, b, c),
        coal.Cylinder(a / 2, b),
        coal.Sphere(a / 2),
        coal.Capsule(a / 4, b),
        coal.Ellipsoid(a / 2, b / 2, c / 2),
        coal.Halfspace(np.array([0.0, 0.0, 1.0]), -c),
    )[rng.integers(6)]


def distances_and_bounds(seed, spread_m):
    rng = np.random.default_rng(seed)
    model = pinocchio.Model()
    geometry = pinocchio.GeometryModel()
    for index in range(8):
        placement = pinocchio.SE3.Random()
        placement.translation = rng.uniform(-spread_m, spread_m, 3)
        placement.rotation = pinocchio.Quaternion(rng.normal(size=4)).normalized().matrix()
        geometry.addGeometryObject(pinocchio.GeometryObject(f"{index}", 0, placement, shape(rng)))
    halfspaces = [isinstance(each.geometry, coal.Halfspace) for each in geometry.geometryObjects]
    for first in range(8):
        for second in range(first + 1, 8):
            if not (halfspaces[first] and halfspaces[second]):
                geometry.addCollisionPair(pinocchio.CollisionPair(first, second))
    state = geometry.createData()
    pinocchio.updateGeometryPlacements(model, model.createData(), geometry, state, np.zeros(0))
    count = len(geometry.collisionPairs)
    found = [pinocchio.computeDistance(geometry, state, index).min_distance for index in range(count)]
    bounds = SeparationBounds.of(geometry, range(count)).least_distances_m(state.oMg)
    return np.array(found), bounds


@pytest.mark.parametrize("spread_m", [0.2, 1.0, 4.0])
def test_no_bound_exceeds_the_distance(spread_m):
    told = overlapping = 0
    for seed in range(60):
        distances, bounds = distances_and_bounds(seed, spread_m)
        assert (bounds <= distances + 1e-7).all()
        told += int(np.isfinite(bounds).sum())
        overlapping += int((distances <= 0.0).sum())
    assert told > 50
    assert overlapping > 20


def test_far_apart_the_bound_is_near_the_distance():
    shares = []
    for seed in range(20):
        distances, bounds = distances_and_bounds(seed, 40.0)
        finite = np.isfinite(bounds)
        shares.extend((bounds[finite] / distances[finite]).tolist())
    assert np.median(shares) > 0.9


def test_of_no_pairs_there_are_no_bounds():
    bounds = SeparationBounds.of(pinocchio.GeometryModel(), ())
    assert bounds.least_distances_m(()).shape == (0,)
    assert math.inf == min(bounds.least_distances_m(()), default=math.inf)
