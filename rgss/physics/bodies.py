"""Bodies of a physics client: fixed primitive shapes, and the object."""

from __future__ import annotations

import math
from typing import Any

from rgss.errors import SimulationError
from rgss.physics.engine import load_urdf_text
from rgss.scenes import (
    Box,
    Cylinder,
    LyingCylinder,
    MeshShape,
    Pose,
    Shape,
    Workpiece,
    convex_link_urdf,
    principal_frame,
)

_MARGIN_M = 1.0e-5
_HALF_TURN = math.sqrt(0.5)
_ALONG_X = (0.0, _HALF_TURN, 0.0, _HALF_TURN)


def add_body(
    engine: Any, client: int, shape: Shape, pose: Pose, mass_kg: float, *, centre_of_mass_m: float = 0.0
) -> int:
    """Add a body; returns its id in the engine.

    Args:
        engine: The engine's module.
        client: The physics client.
        shape: Its solid.
        pose: Transform of the shape's frame to the world.
        mass_kg: Its mass; 0 for a fixed body.
        centre_of_mass_m: Height of its centre of mass above the centre of its shape; its moments of inertia about
            the centre of mass are those of the homogeneous shape.

    Raises:
        SimulationError: The engine rejects it.
    """
    body = int(
        engine.createMultiBody(
            mass_kg,
            _shape(engine, client, shape),
            -1,
            pose.position_m,
            pose.quaternion_xyzw,
            baseInertialFramePosition=(0.0, 0.0, centre_of_mass_m),
            # A fixed body is not a multibody: the same results, bit for bit, in less time. A moving body is one, since
            # the engine's friction model between two bodies that are not multibodies is coarser.
            useMaximalCoordinates=int(mass_kg == 0.0),
            physicsClientId=client,
        )
    )
    if body < 0:
        raise SimulationError("the physics engine rejected a body", hint="check its sizes")
    return body


def add_object(engine: Any, client: int, workpiece: Workpiece) -> tuple[int, Pose]:
    """Add the object with its mass properties.

    Args:
        engine: The engine's module.
        client: The physics client.
        workpiece: The object.

    Returns:
        Its id in the engine, and the transform of its principal axes, whose pose the engine reports, to the frame of
        its shape.

    Raises:
        SimulationError: The engine rejects it.
    """
    shape, mass_kg, pose = workpiece.shape, workpiece.mass_kg, workpiece.pose
    at_m = (*workpiece.centre_of_mass_across_m, workpiece.centre_of_mass_m)
    if isinstance(shape, Cylinder) and workpiece.gyration_m2 is None and not any(at_m[:2]):
        body = add_body(engine, client, shape, pose, mass_kg, centre_of_mass_m=at_m[2])
        return body, Pose(position_m=at_m)
    frame, moments = principal_frame(workpiece)
    if isinstance(shape, MeshShape):
        body = load_urdf_text(
            client,
            convex_link_urdf(workpiece.id, shape.parts_m, mass_kg=mass_kg, moments_kg_m2=moments, principal=frame),
            position=pose.position_m,
            orientation=pose.quaternion_xyzw,
            flags=engine.URDF_USE_INERTIA_FROM_FILE,
            is_fixed=False,
        )
        engine.changeDynamics(body, -1, collisionMargin=_MARGIN_M, physicsClientId=client)
    else:
        solid = _lying(engine, client, shape) if isinstance(shape, LyingCylinder) else _shape(engine, client, shape)
        body = int(
            engine.createMultiBody(
                mass_kg,
                solid,
                -1,
                pose.position_m,
                pose.quaternion_xyzw,
                baseInertialFramePosition=frame.position_m,
                baseInertialFrameOrientation=frame.quaternion_xyzw,
                physicsClientId=client,
            )
        )
    if body < 0:
        raise SimulationError("the physics engine rejected the object", hint="check its sizes")
    engine.changeDynamics(body, -1, localInertiaDiagonal=moments, physicsClientId=client)
    return body, frame


def _lying(engine: Any, client: int, shape: LyingCylinder) -> int:
    return int(
        engine.createCollisionShape(
            engine.GEOM_CYLINDER,
            radius=shape.radius_m,
            height=shape.length_m,
            collisionFrameOrientation=_ALONG_X,
            physicsClientId=client,
        )
    )


def _shape(engine: Any, client: int, shape: Shape) -> int:
    sizes = shape.size_m if isinstance(shape, Box) else (shape.radius_m, shape.height_m)
    if not all(0.0 < size < math.inf for size in sizes):
        # The engine accepts some of these silently and only prints a message for the others.
        raise SimulationError(
            f"the sizes of a body must be positive, got {sizes}", hint="give lengths greater than zero"
        )
    if isinstance(shape, Box):
        half = [size / 2 for size in shape.size_m]
        return int(engine.createCollisionShape(engine.GEOM_BOX, halfExtents=half, physicsClientId=client))
    return int(
        engine.createCollisionShape(
            engine.GEOM_CYLINDER, radius=shape.radius_m, height=shape.height_m, physicsClientId=client
        )
    )
