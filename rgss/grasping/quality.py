"""Quality measures of a grasp (sec. 3.4) from grasp matrix, grasp polygon and contact forces."""

from __future__ import annotations

import math

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.closure import require_force_limit
from rgss.grasping.contact import Matrix
from rgss.grasping.feasibility import RANK_TOLERANCE, positively_span
from rgss.grasping.grasp import Grasp
from rgss.grasping.grasp_matrix import primitive_wrenches
from rgss.grasping.polygon import FEWEST_CORNERS, GraspPolygon, internal_angles, worst_deviation

_NEAREST_FACETS = 32


def singular_values(matrix: Matrix) -> Matrix:
    """Singular values of a grasp matrix, one for each row, in descending order.

    A matrix with fewer columns than rows is padded with zeros; values within rounding of zero are set to zero.
    """
    values = np.zeros(matrix.shape[0])
    found = np.linalg.svd(matrix, compute_uv=False)
    values[: len(found)] = found
    values[values <= RANK_TOLERANCE * values[0]] = 0.0
    return values


def q_msv(matrix: Matrix) -> float:
    """Smallest singular value of the grasp matrix (eq. 3.6): 0 if some wrench cannot be resisted; greater is better."""
    return of_ellipsoid(matrix)[0]


def q_voe(matrix: Matrix) -> float:
    """Volume of the wrench ellipsoid, √det(G Gᵀ), the product of the singular values (eq. 3.7); greater is better."""
    return of_ellipsoid(matrix)[1]


def q_gii(matrix: Matrix) -> float:
    """Isotropy of the wrench ellipsoid, σ_min / σ_max (eq. 3.8): from 0, singular, to 1, isotropic."""
    return of_ellipsoid(matrix)[2]


def of_ellipsoid(matrix: Matrix) -> tuple[float, float, float]:
    """Measures `q_msv`, `q_voe` and `q_gii` of a grasp matrix from one singular value decomposition."""
    values = singular_values(matrix)
    return float(values[-1]), float(np.prod(values)), float(values[-1] / values[0])


def q_gpri(polygon: GraspPolygon) -> float | None:
    """Regularity of the grasp polygon, Σ|θ_i - θ̄| / θ_max (eq. 3.9): from 0, regular, to 1, degenerate.

    A corner inside the hull of the others has an angle above π, and the sum may exceed that of any convex polygon: it
    is clipped to 1.

    Returns:
        None for fewer than three corners.
    """
    count = len(polygon.corners_m)
    if count < FEWEST_CORNERS:
        return None
    if polygon.is_flat:
        return 1.0
    mean = math.pi * (count - 2) / count
    deviation = float(np.sum(np.abs(internal_angles(polygon.corners_m) - mean)))
    return min(1.0, deviation / worst_deviation(count))


def q_diff_m(polygon: GraspPolygon) -> float:
    """Distance in m from the centroid of the grasp polygon to the object's centre of mass (eq. 3.10, 3.11)."""
    return float(np.linalg.norm(polygon.centroid_m))


def q_smw_n(grasp: Grasp, *, finger_force_limit_n: float, cone_edges: int = 8) -> float:
    """Smallest maximum wrench (eq. 3.12, 3.13): greatest wrench resisted in the weakest direction, in N.

    Each finger's wrench cone W_i is bounded by the limit of the normal force, and W is the convex hull of all W_i, so
    that the fingers share one limit. The measure is the radius of the largest ball about the origin in W, with torques
    divided by the characteristic length; friction pyramids give at most the value of circular cones.

    Args:
        grasp: The grasp.
        finger_force_limit_n: Greatest normal force of a finger.
        cone_edges: Edges of each friction pyramid.

    Returns:
        0 without force closure.

    Raises:
        DefinitionError: The limit is not positive, the pyramids are ill defined, or no hull could be built.
    """
    require_force_limit(finger_force_limit_n)
    edges = primitive_wrenches(grasp, cone_edges=cone_edges).matrix
    return finger_force_limit_n * ball_radius(edges) if positively_span(edges) else 0.0


def ball_radius(wrenches: Matrix) -> float:
    """Radius in N of the largest ball about the origin in the convex hull of wrenches that positively span their space.

    It is the minimum, over the facets' normals u, of the hull's support function max_i u·w_i.

    Args:
        wrenches: Shape (space, n).

    Raises:
        DefinitionError: The hull has no facets, because the wrenches are coplanar or nearly so.
    """
    from scipy.spatial import QhullError

    # Facets that are coplanar but for rounding are merged, which can fail, or avoided by perturbing the points by some
    # 1e-11, which takes half the time.
    try:
        facets = _facets(wrenches, "QJ")
    except QhullError:
        try:
            facets = _facets(wrenches, "Qt Qx")
        except QhullError as error:
            raise DefinitionError(
                f"the convex hull of a grasp's wrenches cannot be computed: {str(error).splitlines()[0]}",
                hint="check that contacts do not nearly coincide",
            ) from error
    # Of thousands of facets, those nearest by the perturbed offsets are measured with the original points.
    nearest = facets[np.argsort(-facets[:, -1], kind="stable")[:_NEAREST_FACETS], :-1]
    return float(np.min(np.max(nearest @ wrenches, axis=1)))


def _facets(wrenches: Matrix, options: str) -> Matrix:
    """Unit normal and minus the offset of each facet, shape (facets, space + 1)."""
    from scipy.spatial import ConvexHull

    facets: Matrix = ConvexHull(wrenches.T, qhull_options=options).equations
    return facets
