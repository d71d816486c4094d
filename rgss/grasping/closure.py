"""Equilibrium, force closure, form closure and wrench resistance by linear programs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import Matrix, Vector3
from rgss.grasping.feasibility import BALANCED, RANK_TOLERANCE, STRICTLY_POSITIVE
from rgss.grasping.grasp import Grasp
from rgss.grasping.grasp_matrix import PrimitiveWrenches, plane_rows, primitive_wrenches
from rgss.grasping.linear import maximise
from rgss.grasping.screws import Wrench


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosureVerdict:
    """Verdict on a property of a grasp, with its margin.

    Attributes:
        holds: The verdict.
        margin: Dimensionless; defined in the function that gives the verdict.
    """

    holds: bool
    margin: float


def equilibrium(grasp: Grasp, *, cone_edges: int = 8, plane_normal: Vector3 | None = None) -> ClosureVerdict:
    """Equilibrium: non-zero contact forces can hold the object at rest without an external load (eq. 3.1).

    Among all contact forces whose normal forces sum to 1 N, a first program finds the smallest net wrench; a second
    one, if that is zero, the most even squeeze. A contact without a share in any squeeze is not essential (sec. 3.3.1).

    Args:
        grasp: The grasp.
        cone_edges: Edges of each friction pyramid.
        plane_normal: For a planar grasp, the unit normal of its plane.

    Returns:
        If it holds, the margin is the smallest share of a contact in the most even squeeze, from 0 (one contact cannot
        take part) to 1 (all forces equal). If not, it is minus the greatest component of the smallest net wrench.

    Raises:
        DefinitionError: The pyramids are ill defined, or the solver failed.
    """
    return balance(primitive_wrenches(grasp, cone_edges=cone_edges, plane_normal=plane_normal), len(grasp.contacts))


def force_closure(grasp: Grasp, *, cone_edges: int = 8, plane_normal: Vector3 | None = None) -> ClosureVerdict:
    """Force closure: unbounded contact forces can resist every wrench (eq. 3.4).

    The primitive wrenches positively span the space: they have full rank, and a combination with coefficients that are
    all above zero is zero (Lynch and Park, Modern Robotics, 2017, chapter 12; Murray, Li, Sastry 1994, chapter 5). The
    program finds the combination whose smallest coefficient is greatest.

    Args:
        grasp: The grasp.
        cone_edges: Edges of each friction pyramid.
        plane_normal: For a planar grasp, the unit normal of its plane.

    Returns:
        The margin is that smallest coefficient over the mean one: 0 if the property does not hold, 1 if all
        coefficients are equal.

    Raises:
        DefinitionError: The pyramids are ill defined, or the solver failed.
    """
    return positive_span(primitive_wrenches(grasp, cone_edges=cone_edges, plane_normal=plane_normal).matrix)


def form_closure(grasp: Grasp, *, plane_normal: Vector3 | None = None) -> ClosureVerdict:
    """Form closure: the contacts' normals alone immobilise the object (sec. 3.3.2.1).

    This is form closure of first order: curvature, which can immobilise with fewer contacts, is ignored. It equals
    force closure without friction, and needs at least 7 contacts in space and 4 in a plane. The margin is that of
    `force_closure`.

    Raises:
        DefinitionError: A contact's normal is not in the given plane, or the solver failed.
    """
    return positive_span(primitive_wrenches(grasp, plane_normal=plane_normal, frictionless=True).matrix)


def wrench_resistance(
    grasp: Grasp,
    external: Wrench,
    *,
    finger_force_limit_n: float,
    cone_edges: int = 8,
    plane_normal: Vector3 | None = None,
) -> ClosureVerdict:
    """Wrench resistance: the fingers can hold the object against an external load within their force limit (eq. 3.4).

    The program finds the greatest multiple of the load for which contact forces in the friction cones balance it, while
    the normal forces of the points of each finger sum to at most its limit.

    Args:
        grasp: The grasp.
        external: The load about the centre of mass.
        finger_force_limit_n: Greatest normal force of a finger.
        cone_edges: Edges of each friction pyramid.
        plane_normal: For a planar grasp, the unit normal of its plane; only components in the plane count.

    Returns:
        The margin is that multiple minus 1, from -1 (no load can be resisted); infinite for a zero load.

    Raises:
        DefinitionError: The load is not finite or the limit not positive; the pyramids are ill defined, or the solver
            failed.
    """
    edges = primitive_wrenches(grasp, cone_edges=cone_edges, plane_normal=plane_normal)
    rows = None if plane_normal is None else plane_rows(plane_normal)
    return resistance(grasp, edges, external, finger_force_limit_n=finger_force_limit_n, rows=rows)


def balance(edges: PrimitiveWrenches, contacts: int) -> ClosureVerdict:
    """The verdict of `equilibrium` from the edges of the friction pyramids.

    Args:
        edges: The edges.
        contacts: Number of contacts to which they belong.

    Raises:
        DefinitionError: The solver failed.
    """
    residual = _smallest_net_wrench(edges.matrix)
    if residual > BALANCED:
        return ClosureVerdict(holds=False, margin=-residual)
    share = _most_even_share(edges, contacts)
    return ClosureVerdict(holds=True, margin=share if share > STRICTLY_POSITIVE else 0.0)


def resistance(
    grasp: Grasp,
    edges: PrimitiveWrenches,
    external: Wrench,
    *,
    finger_force_limit_n: float,
    rows: Matrix | None = None,
) -> ClosureVerdict:
    """The verdict of `wrench_resistance` from the edges of the friction pyramids.

    Args:
        grasp: The grasp.
        edges: The edges.
        external: The external load about the centre of mass.
        finger_force_limit_n: Greatest normal force of a finger.
        rows: Selection matrix of the planar wrench components; None for a grasp in space.

    Raises:
        DefinitionError: The load is not finite or the limit not positive; or the solver failed.
    """
    require_force_limit(finger_force_limit_n)
    numbers = (*external.force_n, *external.torque_n_m)
    if not all(map(math.isfinite, numbers)):
        raise DefinitionError(f"a load with the components {numbers} cannot be resisted", hint="give finite numbers")
    load = np.concatenate([external.force_n, np.array(external.torque_n_m) / grasp.characteristic_length_m])
    if rows is not None:
        load = rows @ load
    size = float(np.linalg.norm(load))
    if size == 0.0:
        return ClosureVerdict(holds=True, margin=math.inf)
    owners = edges.contacts.tolist()
    fingers = np.array([[float(owner in members) for owner in owners] for members in grasp.fingers()])
    # Forces are scaled by the limit and the load by its size, so that the numbers are near 1.
    best = maximise(
        np.append(np.zeros(edges.matrix.shape[1]), 1.0),
        equal=(np.hstack([edges.matrix, (load / size)[:, None]]), np.zeros(len(load))),
        at_most=(np.hstack([fingers, np.zeros((len(fingers), 1))]), np.ones(len(fingers))),
    )
    factor = 0.0 if best is None else float(best[-1]) * finger_force_limit_n / size
    return ClosureVerdict(holds=factor >= 1.0 - BALANCED, margin=factor - 1.0)


def positive_span(wrenches: Matrix) -> ClosureVerdict:
    """True if wrenches positively span their space; the margin is that of `force_closure`.

    Args:
        wrenches: Shape (space, n), in newtons alone.

    Raises:
        DefinitionError: The solver failed.
    """
    rows, columns = wrenches.shape
    values = np.linalg.svd(wrenches, compute_uv=False)
    if columns <= rows or values[-1] <= RANK_TOLERANCE * values[0]:
        return ClosureVerdict(holds=False, margin=0.0)
    # The coefficients are x + t for x ≥ 0, so that t is the smallest of them; they sum to 1.
    best = maximise(
        np.append(np.zeros(columns), 1.0),
        equal=(
            np.block([[wrenches, wrenches.sum(axis=1, keepdims=True)], [np.ones((1, columns)), float(columns)]]),
            np.append(np.zeros(rows), 1.0),
        ),
    )
    margin = 0.0 if best is None else columns * float(best[-1])
    holds = margin > STRICTLY_POSITIVE
    return ClosureVerdict(holds=holds, margin=min(margin, 1.0) if holds else 0.0)


def require_force_limit(finger_force_limit_n: float) -> None:
    """Require a positive force limit.

    Raises:
        DefinitionError: The limit is not a positive number.
    """
    if not 0.0 < finger_force_limit_n < math.inf:
        raise DefinitionError(
            f"a finger cannot have the force limit {finger_force_limit_n:g} N", hint="give a force above zero"
        )


def _smallest_net_wrench(matrix: Matrix) -> float:
    rows, columns = matrix.shape
    bound = np.ones((rows, 1))
    best = maximise(
        np.append(np.zeros(columns), -1.0),
        equal=(np.append(np.ones(columns), 0.0)[None], np.ones(1)),
        at_most=(np.block([[matrix, -bound], [-matrix, -bound]]), np.zeros(2 * rows)),
    )
    return math.inf if best is None else float(np.max(np.abs(matrix @ best[:-1])))


def _most_even_share(edges: PrimitiveWrenches, count: int) -> float:
    rows, columns = edges.matrix.shape
    members = (edges.contacts == np.arange(count)[:, None]).astype(float)
    balance = np.hstack([edges.matrix, np.zeros((rows, 1))])
    best = maximise(
        np.append(np.zeros(columns), 1.0),
        equal=(np.append(np.ones(columns), 0.0)[None], np.ones(1)),
        at_most=(
            np.vstack([np.hstack([-members, np.ones((count, 1))]), balance, -balance]),
            np.concatenate([np.zeros(count), np.full(2 * rows, 2.0 * BALANCED)]),
        ),
    )
    return 0.0 if best is None else min(1.0, count * float(best[-1]))
