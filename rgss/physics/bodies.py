"""Bodies of a physics client: fixed primitive shapes, and the object."""

from __future__ import annotations

import math
from typing import Any

from rgss.errors import SimulationError
from rgss.scenes import (
    Box,
    Cylinder,
    LyingCylinder,
    MeshShape,
    Pose,
    Shape,
    Workpiece,
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
        body = _add_mesh(engine, client, shape, pose @ frame, frame, mass_kg)
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


def _add_mesh(engine: Any, client: int, shape: MeshShape, placed: Pose, principal: Pose, mass_kg: float) -> int:
    """Add a body whose frame is its principal frame, with a fixed link for each part after the first.

    A body of the engine has the margin of its own shape, which is set for a shape that is neither displaced nor one of
    several of a link: others keep 1 mm, by which the object would be too large on all sides.
    """
    to_principal = principal.inverse()
    shapes = []
    for part in shape.parts_m:
        corners = part
        if principal != Pose():
            corners = tuple((to_principal @ Pose(position_m=at)).position_m for at in part)
        number = engine.createCollisionShape(engine.GEOM_MESH, vertices=corners, physicsClientId=client)
        # The margin is that of the shape, and is set by a body that has it; other bodies share the shape.
        setter = engine.createMultiBody(1.0, number, physicsClientId=client)
        engine.changeDynamics(setter, -1, collisionMargin=_MARGIN_M, physicsClientId=client)
        engine.removeBody(setter, physicsClientId=client)
        shapes.append(number)
    others = len(shapes) - 1
    nowhere, unturned = [(0.0, 0.0, 0.0)] * others, [(0.0, 0.0, 0.0, 1.0)] * others
    return int(
        engine.createMultiBody(
            mass_kg,
            shapes[0],
            -1,
            placed.position_m,
            placed.quaternion_xyzw,
            linkMasses=[0.0] * others,
            linkCollisionShapeIndices=shapes[1:],
            linkVisualShapeIndices=[-1] * others,
            linkPositions=nowhere,
            linkOrientations=unturned,
            linkInertialFramePositions=nowhere,
            linkInertialFrameOrientations=unturned,
            linkParentIndices=[0] * others,
            linkJointTypes=[engine.JOINT_FIXED] * others,
            linkJointAxis=[(0.0, 0.0, 1.0)] * others,
            physicsClientId=client,
        )
    )


def links_of(engine: Any, client: int, body: int) -> range:
    """Links of a body: its base, and one for each further shape of a mesh.

    Args:
        engine: The engine's module.
        client: The physics client.
        body: Its id in the engine.
    """
    return range(-1, engine.getNumJoints(body, physicsClientId=client))


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
