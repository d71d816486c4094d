"""Grasp map: from contact forces to the wrench on the object."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import ContactKind, ContactPoint, Matrix, Vector3
from rgss.grasping.grasp import Grasp
from rgss.grasping.screws import Wrench

FEWEST_CONE_EDGES = 3
_IN_PLANE_TOLERANCE = 1e-6
_INTENSITIES = {ContactKind.FRICTIONLESS: 1, ContactKind.HARD: 3, ContactKind.SOFT: 4}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PrimitiveWrenches:
    """Primitive wrenches: the edges of the contacts' linearised friction cones as wrenches on the object.

    Attributes:
        matrix: A column for each edge, for a normal force of 1 N: force in N above torque over the characteristic
            length in N, about the centre of mass. Shape (6, edges); (3, edges) in a plane.
        contacts: Index of the contact of each column, shape (edges,).
    """

    matrix: Matrix
    contacts: np.typing.NDArray[np.int64]


def partial_wrench_basis(grasp: Grasp, index: int) -> Matrix:
    """Partial wrench basis: the columns of the grasp matrix of one contact.

    Rows are force, then torque about the centre of mass over the characteristic length, as in equation 3.1. Columns are
    the contact's intensities, all in N: normal force; for hard and soft contacts the two friction forces along the
    contact's tangents; for a soft one the torque about the normal over the characteristic length.

    Returns:
        Shape (6, 1), (6, 3) or (6, 4); dimensionless.
    """
    return _basis(grasp.contacts[index], grasp.arms_m()[index], grasp.characteristic_length_m)


def grasp_matrix(grasp: Grasp) -> Matrix:
    """Grasp matrix G, shape (6, m), that maps contact intensities to the wrench on the object (sec. 3.4.2)."""
    return np.hstack(partial_wrench_bases(grasp))


def partial_wrench_bases(grasp: Grasp) -> list[Matrix]:
    """`partial_wrench_basis` of every contact; side by side they form the grasp matrix."""
    length = grasp.characteristic_length_m
    return [_basis(contact, arm, length) for contact, arm in zip(grasp.contacts, grasp.arms_m(), strict=True)]


def grasp_map(grasp: Grasp, intensities: Sequence[Sequence[float]]) -> Wrench:
    """Grasp map L_G (eq. 3.1): net wrench of given contact forces about the centre of mass.

    Args:
        grasp: The grasp.
        intensities: The intensities of each contact, as many as its model has: normal force (N); two friction forces
            (N); torque about the normal (N·m).

    Raises:
        DefinitionError: The numbers of intensities do not match the contacts.
    """
    asked = [_INTENSITIES[contact.kind] for contact in grasp.contacts]
    given = [len(row) for row in intensities]
    if given != asked:
        raise DefinitionError(
            f"the numbers of intensities of the contacts must be {asked}, got {given}",
            hint="give 1 for a frictionless contact, 3 for a hard one, 4 for a soft one",
        )
    length = grasp.characteristic_length_m
    scaled = [[*row[:3], *(torque / length for torque in row[3:])] for row in intensities]
    wrench = grasp_matrix(grasp) @ np.concatenate(scaled)
    return _wrench(wrench[:3], wrench[3:] * length)


def net_wrench(grasp: Grasp) -> Wrench:
    """Net wrench of the contacts' present normal and friction forces about the centre of mass."""
    # In plain numbers, as the contacts' axes: it is computed in every analysis of a grasp.
    ox, oy, oz = grasp.centre_of_mass_m
    fx = fy = fz = tx = ty = tz = 0.0
    for contact in grasp.contacts:
        (x, y, z), (nx, ny, nz), press_n = contact.position_m, contact.normal, contact.normal_force_n
        ax, ay, az = contact.friction_force_n
        ax, ay, az = ax + press_n * nx, ay + press_n * ny, az + press_n * nz
        x, y, z = x - ox, y - oy, z - oz
        fx, fy, fz = fx + ax, fy + ay, fz + az
        tx, ty, tz = tx + y * az - z * ay, ty + z * ax - x * az, tz + x * ay - y * ax
    return Wrench(torque_n_m=(tx, ty, tz), force_n=(fx, fy, fz))


def in_friction_cone(contact: ContactPoint, intensities: Sequence[float], *, tolerance_n: float = 1e-9) -> bool:
    """Membership of the generalised friction cone C_i: True if a contact can transmit the intensities.

    The cone is circular: friction up to the coefficient times the normal force, and for a soft contact, independently,
    a torque up to the torsional coefficient times the normal force (Murray, Li, Sastry 1994, chapter 5).
    """
    normal = intensities[0]
    if normal < -tolerance_n:
        return False
    if len(intensities) > 1 and math.hypot(*intensities[1:3]) > contact.friction * normal + tolerance_n:
        return False
    return len(intensities) < 4 or abs(intensities[3]) <= contact.torsional_friction_m * normal + tolerance_n


def primitive_wrenches(
    grasp: Grasp, *, cone_edges: int = 8, plane_normal: Vector3 | None = None, frictionless: bool = False
) -> PrimitiveWrenches:
    """Primitive wrenches of unit normal force, along the edges of friction pyramids inscribed in the cones.

    The circular cone resists whatever the pyramid resists, so that verdicts are conservative; the effective friction is
    at worst cos(π / edges) of the true value, 0.92 for 8 edges.

    Args:
        grasp: The grasp.
        cone_edges: Edges of each pyramid.
        plane_normal: Unit normal of the plane in which a planar grasp lies; the wrenches are then two forces in the
            plane and the torque about its normal, and each friction cone has its two edges in the plane.
        frictionless: True to ignore friction.

    Raises:
        DefinitionError: There are fewer than 3 edges, the plane's normal is not a unit vector, or a contact's normal is
        not in the plane.
    """
    require_cone_edges(cone_edges)
    if plane_normal is not None:
        _check_plane(grasp, plane_normal)
        return _planar_wrenches(grasp, plane_normal, frictionless=frictionless)
    return wrenches_of(grasp, partial_wrench_bases(grasp), cone_edges=cone_edges, frictionless=frictionless)


def wrenches_of(
    grasp: Grasp, bases: Sequence[Matrix], *, cone_edges: int, frictionless: bool = False
) -> PrimitiveWrenches:
    """Primitive wrenches of a grasp in space, from the contacts' partial wrench bases.

    Args:
        grasp: The grasp.
        bases: Its `partial_wrench_bases`.
        cone_edges: Edges of each pyramid, at least 3.
        frictionless: True to ignore friction.
    """
    length, columns, owners = grasp.characteristic_length_m, [], []
    for index, (contact, basis) in enumerate(zip(grasp.contacts, bases, strict=True)):
        kind = ContactKind.FRICTIONLESS if frictionless else contact.kind
        edges = basis[:, :1]
        if kind is not ContactKind.FRICTIONLESS and contact.friction > 0.0:
            edges = edges + contact.friction * basis[:, 1:3] @ _circle(cone_edges)
        twisting = contact.torsional_friction_m / length
        if kind is ContactKind.SOFT and twisting > 0.0:
            spin = twisting * basis[:, 3:]
            edges = np.hstack([edges + spin, edges - spin])
        columns.append(edges)
        owners += [index] * edges.shape[1]
    return PrimitiveWrenches(matrix=np.hstack(columns), contacts=np.array(owners))


def require_cone_edges(cone_edges: int) -> int:
    """Number of edges of a friction pyramid, validated.

    Raises:
        DefinitionError: There are fewer than 3 edges.
    """
    if cone_edges < FEWEST_CONE_EDGES:
        raise DefinitionError(
            f"a friction pyramid must have at least {FEWEST_CONE_EDGES} edges, got {cone_edges}",
            hint=f"give at least {FEWEST_CONE_EDGES}",
        )
    return cone_edges


def _planar_wrenches(grasp: Grasp, plane_normal: Vector3, *, frictionless: bool) -> PrimitiveWrenches:
    """Primitive wrenches in a plane: two edges of each contact's friction cone, one without friction."""
    columns, owners = [], []
    for index, (contact, arm_m) in enumerate(zip(grasp.contacts, grasp.arms_m(), strict=True)):
        forces = contact.axes()[:1]
        if not frictionless and contact.kind is not ContactKind.FRICTIONLESS and contact.friction > 0.0:
            across = contact.friction * np.cross(plane_normal, forces[0])
            forces = np.array([forces[0] + across, forces[0] - across])
        columns.append(np.hstack([forces, _moments(arm_m, forces) / grasp.characteristic_length_m]))
        owners += [index] * len(forces)
    return PrimitiveWrenches(matrix=plane_rows(plane_normal) @ np.vstack(columns).T, contacts=np.array(owners))


def _basis(contact: ContactPoint, arm_m: Matrix, length_m: float) -> Matrix:
    axes = contact.axes()
    forces = axes[:1] if contact.kind is ContactKind.FRICTIONLESS else axes
    columns: Matrix = np.hstack([forces, _moments(arm_m, forces) / length_m]).T
    if contact.kind is ContactKind.SOFT:
        columns = np.hstack([columns, np.concatenate([np.zeros(3), axes[0]])[:, None]])
    return columns


def _moments(arm_m: Matrix, forces: Matrix) -> Matrix:
    """Moments arm × force of forces at one point, shape (n, 3); for few forces several times as fast as NumPy."""
    x, y, z = arm_m.tolist()
    moments: Matrix = forces @ np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    return moments


@lru_cache(maxsize=8)
def _circle(edges: int) -> Matrix:
    """Evenly spaced directions on a circle, shape (2, edges); read-only."""
    angles = 2.0 * math.pi * np.arange(edges) / edges
    return np.array([np.cos(angles), np.sin(angles)])


def _check_plane(grasp: Grasp, plane_normal: Vector3) -> None:
    length = math.hypot(*plane_normal)
    if not abs(length - 1.0) <= _IN_PLANE_TOLERANCE:
        raise DefinitionError(
            f"the normal of a plane must have the length 1, got {length:.9g}", hint="give it the length 1"
        )
    for index, contact in enumerate(grasp.contacts):
        if abs(float(np.dot(contact.normal, plane_normal))) > _IN_PLANE_TOLERANCE:
            raise DefinitionError(
                f"the normal of contact {index} does not lie in the plane of the grasp",
                hint="leave plane_normal out for a grasp in space",
            )


def plane_rows(plane_normal: Vector3) -> Matrix:
    """Selection matrix of two forces in a plane and the torque about its normal from a wrench, shape (3, 6)."""
    frame = ContactPoint(position_m=(0.0, 0.0, 0.0), normal=plane_normal).axes()
    rows = np.zeros((3, 6))
    rows[:2, :3], rows[2, 3:] = frame[1:], frame[0]
    return rows


def _wrench(force_n: Matrix, torque_n_m: Matrix) -> Wrench:
    fx, fy, fz = force_n.tolist()
    tx, ty, tz = torque_n_m.tolist()
    return Wrench(torque_n_m=(tx, ty, tz), force_n=(fx, fy, fz))
