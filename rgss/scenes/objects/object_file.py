"""Object of a scene file: solid, mass properties and pose."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rgss.documents import Document
from rgss.errors import DefinitionError
from rgss.findings import Finding
from rgss.scenes.document import (
    CollisionShapes,
    GivenGraspEntry,
    Rest,
    WorkpieceEntry,
)
from rgss.scenes.findings import Location, named_file_findings
from rgss.scenes.grasps import GivenGrasp, rotation_of
from rgss.scenes.mass_properties import Gyration
from rgss.scenes.mesh_shapes import mesh_mass, mesh_summary, shapes_of_mesh
from rgss.scenes.objects.mesh_findings import mesh_findings
from rgss.scenes.objects.object_entry import OWN, form_findings, object_lengths
from rgss.scenes.pose import Pose
from rgss.scenes.scene import ColourRgba, Workpiece
from rgss.scenes.shapes import Box, Cylinder, LyingCylinder, MeshShape, ObjectShape, Point, corners_of

MOST_PARTS = 16
"""Greatest number of convex parts of an object; each is checked with each body and pad in every step."""

_TIPPED = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, math.pi / 2, 0.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class ObjectSolid:
    """Solid of an object in its resting orientation, without its position in the scene.

    Attributes:
        shape: The solid.
        from_file: Transform of the frame of its file to the frame of the shape.
        mass_kg: Its mass.
        centre_m: Its centre of mass, in the frame of the shape.
        gyration_m2: Inertia about it divided by the mass; None for that of the homogeneous shape.
    """

    shape: ObjectShape
    from_file: Pose
    mass_kg: float
    centre_m: Point
    gyration_m2: Gyration | None


def object_solid(
    path: Path,
    entry: WorkpieceEntry,
    document: Document,
    findings: list[Finding],
    project: Path,
    *,
    at: Location = OWN,
) -> ObjectSolid | None:
    """Solid of an object; None if it is invalid, with findings added.

    Args:
        path: The scene's file; the mesh is relative to its folder.
        entry: The object.
        document: The scene's document.
        findings: List to which findings are added.
        project: The folder that must contain all referenced files.
        at: Location of the entry.
    """
    before = len(findings)
    findings.extend(form_findings(entry, document, at))
    if len(findings) > before or any(value <= 0.0 for _, value in object_lengths(entry, at=at)):
        return None
    if entry.mesh is not None:
        location = (*at, "mesh")
        problems = list(named_file_findings(document, entry.mesh, location, folder=path.parent, project=project))
        findings.extend(problems)
        if problems:
            return None
        try:
            return _mesh_solid(path.parent / entry.mesh, entry, document, findings, at)
        except DefinitionError as error:
            findings.append(document.finding("scene.mesh", str(error), location, hint=error.hint))
            return None
    shape, turn = _primitive(entry)
    upright = _primitive(entry.model_copy(update={"rests": Rest.UPRIGHT}))[0]
    mass_kg = entry.mass if entry.mass is not None else _required(entry.density) * _volume_m3(upright)
    solid = _assembled(entry, shape, turn, mass_kg, (0.0, 0.0, 0.0), None)
    findings.extend(_mass_findings(entry, solid, document, at))
    return solid


def workpiece_of(entry: WorkpieceEntry, solid: ObjectSolid, *, pose: Pose, colour: ColourRgba) -> Workpiece:
    """Object at its start pose."""
    x, y, z = solid.centre_m
    return Workpiece(
        id=entry.id,
        shape=solid.shape,
        mass_kg=solid.mass_kg,
        friction=entry.friction,
        force_limit_n=entry.force_limit,
        force_window_s=entry.force_window,
        landing_limit_m_s=entry.landing_limit,
        centre_of_mass_m=z,
        centre_of_mass_across_m=(x, y),
        gyration_m2=solid.gyration_m2,
        rolling_resistance_m=entry.rolling_resistance or 0.0,
        grasps=tuple(_given(grasp, solid.from_file) for grasp in entry.grasps),
        pose=pose,
        colour=colour,
    )


def _primitive(entry: WorkpieceEntry) -> tuple[Box | Cylinder | LyingCylinder, Pose]:
    """Shape of a box or a cylinder in its resting orientation, and the rotation to its frame."""
    lying = entry.rests is Rest.LYING
    if entry.box is not None:
        x, y, z = entry.box
        return Box(size_m=(z, y, x) if lying else (x, y, z)), _TIPPED if lying else Pose()
    radius, height = entry.radius, entry.height
    if entry.cylinder is not None:
        radius, height = entry.cylinder.radius, entry.cylinder.height
    if lying:
        return LyingCylinder(radius_m=_required(radius), length_m=_required(height)), _TIPPED
    return Cylinder(radius_m=_required(radius), height_m=_required(height)), Pose()


def _mesh_solid(
    path: Path, entry: WorkpieceEntry, document: Document, findings: list[Finding], at: Location
) -> ObjectSolid | None:
    summary = mesh_summary(path, scale=(entry.scale,) * 3)
    before, location = len(findings), (*at, "mesh")
    findings.extend(mesh_findings(entry, summary, document, location))
    if len(findings) > before:
        return None
    how = entry.collision or CollisionShapes.HULL
    sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
    parts = shapes_of_mesh(path, sha256=sha256, scale=(entry.scale,) * 3, how=how)
    if len(parts) > MOST_PARTS:
        raise DefinitionError(
            f"{path.name} takes {len(parts)} convex parts, at most {MOST_PARTS} are simulated",
            hint="use a simpler mesh, or 'collision: hull'",
        )
    turn = _TIPPED if entry.rests is Rest.LYING else Pose()
    corners = np.vstack([np.array(part) for part in parts]) @ rotation_of(turn).T
    x, y, z = (float(value) for value in (corners.min(axis=0) + corners.max(axis=0)) / 2)
    to_shape = Pose(position_m=(-x, -y, -z)) @ turn
    shape = MeshShape(
        parts_m=tuple(
            tuple(_rounded((to_shape @ Pose(position_m=corner)).position_m) for corner in part) for part in parts
        ),
        sha256=sha256,
    )
    centre, gyration, mass_kg = (0.0, 0.0, 0.0), None, entry.mass
    if summary.is_closed:
        found = mesh_mass(path, scale=entry.scale)
        centre, gyration = found.centre_m, found.gyration_m2
        mass_kg = entry.mass if entry.mass is not None else _required(entry.density) * found.volume_m3
    solid = _assembled(entry, shape, to_shape, _required(mass_kg), centre, gyration)
    findings.extend(_mass_findings(entry, solid, document, at))
    return solid


def _assembled(
    entry: WorkpieceEntry,
    shape: ObjectShape,
    to_shape: Pose,
    mass_kg: float,
    centre: Point,
    gyration: Gyration | None,
) -> ObjectSolid:
    """Solid with the stated mass properties in place of those of its shape."""
    stated_centre = centre if entry.centre_of_mass is None else entry.centre_of_mass
    if entry.inertia is not None:
        xx, yy, zz, xy, xz, yz = (value / mass_kg for value in entry.inertia)
        gyration = (xx, yy, zz, xy, xz, yz)
    if gyration is not None:
        gyration = _turned(gyration, to_shape)
    is_same = to_shape == Pose()
    return ObjectSolid(
        shape=shape,
        from_file=to_shape,
        mass_kg=mass_kg,
        centre_m=stated_centre if is_same else _rounded((to_shape @ Pose(position_m=stated_centre)).position_m),
        gyration_m2=gyration,
    )


def _turned(gyration: Gyration, turn: Pose) -> Gyration:
    xx, yy, zz, xy, xz, yz = gyration
    axes = rotation_of(turn)
    found = axes @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ axes.T
    entries = [float(found[row, column]) for row, column in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    return entries[0], entries[1], entries[2], entries[3], entries[4], entries[5]


def _mass_findings(entry: WorkpieceEntry, solid: ObjectSolid, document: Document, at: Location) -> Iterable[Finding]:
    """Findings about a centre of mass outside the hull, and about an inertia that no rigid body has."""
    corners = np.array([corner for part in corners_of(solid.shape) for corner in part])
    if entry.centre_of_mass is not None and not _is_in_hull(np.array(solid.centre_m), corners):
        yield document.finding(
            "scene.centre-of-mass",
            "the centre of mass lies outside the object",
            (*at, "centre_of_mass"),
            hint="it is given in the frame of the shape: of a box or cylinder, from its centre",
        )
    if entry.inertia is not None:
        xx, yy, zz, xy, xz, yz = entry.inertia
        moments = np.linalg.eigvalsh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
        if moments[0] <= 0.0 or moments[0] + moments[1] < moments[2] * (1.0 - 1e-6):
            yield document.finding(
                "scene.inertia",
                "the principal moments of inertia must be positive, each at most the sum of the others",
                (*at, "inertia"),
                hint="give xx, yy, zz, xy, xz, yz about the centre of mass",
            )


def _is_in_hull(point: np.ndarray, corners: np.ndarray) -> bool:
    from scipy.spatial import ConvexHull

    equations = ConvexHull(corners).equations
    return bool(np.max(equations[:, :3] @ point + equations[:, 3]) <= 1e-9)


def _given(entry: GivenGraspEntry, from_file: Pose) -> GivenGrasp:
    frame = Pose.from_roll_pitch_yaw(entry.at, (entry.roll, entry.pitch, entry.yaw))
    return GivenGrasp(id=entry.id, tool_in_object=from_file @ frame, width_m=entry.width)


def _volume_m3(shape: Box | Cylinder | LyingCylinder) -> float:
    if isinstance(shape, Box):
        return math.prod(shape.size_m)
    height_m = shape.height_m if isinstance(shape, Cylinder) else shape.length_m
    return math.pi * shape.radius_m**2 * height_m


def _rounded(point: Point) -> Point:
    """Point rounded to 0.1 nm, without the rounding noise of a rotation."""
    x, y, z = (round(value, 10) for value in point)
    return x, y, z


def _required(value: float | None) -> float:
    if value is None:
        raise AssertionError("checked before: the entry has it")
    return value
