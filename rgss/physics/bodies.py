"""Bodies of one primitive shape in a physics client."""

from __future__ import annotations

import math
from typing import Any

from rgss.errors import SimulationError
from rgss.scenes import Box, Pose, Shape


def add_body(
    engine: Any, client: int, shape: Shape, pose: Pose, mass_kg: float, *, centre_of_mass_m: float = 0.0
) -> int:
    """Add a body; returns the engine's number of it.

    Args:
        engine: The engine's module.
        client: The physics client.
        shape: Its solid.
        pose: Transform of the shape's frame to the world.
        mass_kg: Its mass; 0 for a body that does not move.
        centre_of_mass_m: Height of its centre of mass above the centre of its shape; its moments of inertia about
            the centre of mass are those of the homogeneous shape.

    Raises:
        SimulationError: The engine refuses it.
    """
    body = int(
        engine.createMultiBody(
            mass_kg,
            _shape(engine, client, shape),
            -1,
            pose.position_m,
            pose.quaternion_xyzw,
            baseInertialFramePosition=(0.0, 0.0, centre_of_mass_m),
            # What stands still is no articulated body without links: the same results, to the bit, for less
            # time. What moves is one, since the engine has a rougher law of friction between two that are not.
            useMaximalCoordinates=int(mass_kg == 0.0),
            physicsClientId=client,
        )
    )
    if body < 0:
        raise SimulationError("the physics engine refused a body", hint="check its sizes")
    return body


def _shape(engine: Any, client: int, shape: Shape) -> int:
    sizes = shape.size_m if isinstance(shape, Box) else (shape.radius_m, shape.height_m)
    if not all(0.0 < size < math.inf for size in sizes):
        # The engine accepts some of these silently and prints messages about the others.
        raise SimulationError(f"a body cannot have the sizes {sizes}", hint="give lengths greater than zero")
    if isinstance(shape, Box):
        half = [size / 2 for size in shape.size_m]
        return int(engine.createCollisionShape(engine.GEOM_BOX, halfExtents=half, physicsClientId=client))
    return int(
        engine.createCollisionShape(
            engine.GEOM_CYLINDER, radius=shape.radius_m, height=shape.height_m, physicsClientId=client
        )
    )
