"""Grippers, the scene and whole trials for tests of the second engine."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from rgss.scenes import Gripper, GripperGeometry, Scene, load_gripper, load_scene
from rgss.studies.project import load_project

from .comparison import Comparison

PROJECT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def scene() -> Scene:
    return load_scene(PROJECT / "scenes/restaurant.yaml")


@pytest.fixture(scope="session")
def geometries() -> dict[int, GripperGeometry]:
    return {fingers: load_gripper(PROJECT / f"scenes/grippers/kg-{fingers}.yaml") for fingers in (2, 3)}


@pytest.fixture(scope="session")
def gripper_with(geometries) -> Callable[..., Gripper]:
    """A gripper by its fingers, and by what else is not as in the standard design."""

    def make(fingers: int, *, friction: float = 0.7, force_n: float = 10.0, finger_mass_kg: float = 0.3) -> Gripper:
        return Gripper(
            geometry=geometries[fingers],
            base_mass_kg=0.4,
            finger_mass_kg=finger_mass_kg,
            finger_velocity_m_s=0.04,
            finger_force_n=force_n,
            friction=friction,
        )

    return make


@pytest.fixture(scope="session")
def comparison() -> Comparison:
    return Comparison(load_project(PROJECT, "studies/nominal_world.yaml"))
