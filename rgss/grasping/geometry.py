"""Verdicts and measures of a grasp that depend on its geometry, not on its contact forces."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from rgss.grasping.closure import balance, positive_span
from rgss.grasping.contact import ContactPoint, Matrix
from rgss.grasping.feasibility import can_balance, positively_span
from rgss.grasping.grasp import Grasp
from rgss.grasping.grasp_matrix import PrimitiveWrenches, partial_wrench_bases, require_cone_edges, wrenches_of
from rgss.grasping.quality import ball_radius, of_ellipsoid

_SAME = 1e-9


class Verdict(NamedTuple):
    """Verdict on a property, with its margin if that was requested."""

    holds: bool
    margin: float | None


class GraspGeometry:
    """Measures of a grasp that depend only on its geometry and friction.

    Attributes:
        edges: Edges of the friction pyramids.
        squeeze: Equilibrium.
        force: Force closure.
        form: Form closure.
        q_msv_1: Smallest singular value of the grasp matrix.
        q_voe_1: Volume of the ellipsoid of wrenches.
        q_gii_1: Isotropy of the ellipsoid of wrenches.
    """

    def __init__(self, grasp: Grasp, *, cone_edges: int, with_margins: bool) -> None:
        """Compute everything except the convex hull.

        Args:
            grasp: The grasp.
            cone_edges: Edges of each friction pyramid.
            with_margins: True to compute margins of the verdicts, by linear programs.

        Raises:
            DefinitionError: A solver failed.
        """
        self._grasp, self._asked = grasp, (cone_edges, with_margins)
        bases = partial_wrench_bases(grasp)
        self.edges: PrimitiveWrenches = wrenches_of(grasp, bases, cone_edges=require_cone_edges(cone_edges))
        normals = np.hstack([basis[:, :1] for basis in bases])
        self.squeeze, self.force, self.form = _verdicts(grasp, self.edges, normals, with_margins=with_margins)
        self.q_msv_1, self.q_voe_1, self.q_gii_1 = of_ellipsoid(np.hstack(bases))

    @cached_property
    def smallest_maximum_1(self) -> float:
        """Smallest maximum wrench in N for a force limit of 1 N, by a convex hull; 0 without force closure."""
        return ball_radius(self.edges.matrix) if self.force.holds else 0.0

    def is_of(self, grasp: Grasp, *, cone_edges: int, with_margins: bool) -> bool:
        """True if a grasp has the same geometry, within a nanometre, and the same options."""
        mine = self._grasp
        return (
            self._asked == (cone_edges, with_margins)
            and (mine.centre_of_mass_m, mine.characteristic_length_m)
            == (grasp.centre_of_mass_m, grasp.characteristic_length_m)
            and len(mine.contacts) == len(grasp.contacts)
            and all(map(_is_same_place, mine.contacts, grasp.contacts))
        )


class GraspGeometryCache:
    """Cache of the geometric measures of the last analysed grasp.

    A held object mostly does not move in the hand: its contact points persist while their forces change, and only the
    quantities that depend on forces are recomputed.
    """

    def __init__(self) -> None:
        """Start with an empty cache."""
        self._last: GraspGeometry | None = None

    def geometry(self, grasp: Grasp, *, cone_edges: int, with_margins: bool) -> GraspGeometry:
        """Geometric measures of a grasp, computed unless its geometry equals that of the last one.

        Args:
            grasp: The grasp.
            cone_edges: As for `GraspGeometry`.
            with_margins: As for `GraspGeometry`.

        Raises:
            DefinitionError: As for `GraspGeometry`.
        """
        known = self._last
        if known is None or not known.is_of(grasp, cone_edges=cone_edges, with_margins=with_margins):
            known = self._last = GraspGeometry(grasp, cone_edges=cone_edges, with_margins=with_margins)
        return known


def _is_same_place(one: ContactPoint, other: ContactPoint) -> bool:
    if (one.finger, one.kind, one.friction, one.torsional_friction_m, one.tangent) != (
        other.finger,
        other.kind,
        other.friction,
        other.torsional_friction_m,
        other.tangent,
    ):
        return False
    pairs = zip((*one.position_m, *one.normal), (*other.position_m, *other.normal), strict=True)
    return all(abs(mine - theirs) <= _SAME for mine, theirs in pairs)


def _verdicts(
    grasp: Grasp, edges: PrimitiveWrenches, normals: Matrix, *, with_margins: bool
) -> tuple[Verdict, Verdict, Verdict]:
    """Equilibrium, force closure and form closure."""
    if with_margins:
        found = balance(edges, len(grasp.contacts)), positive_span(edges.matrix), positive_span(normals)
        first, second, third = (Verdict(verdict.holds, verdict.margin) for verdict in found)
        return first, second, third
    closed = positively_span(edges.matrix)
    # Wrenches that positively span their space are in equilibrium; only the others must be checked.
    squeezed = closed or can_balance(edges.matrix)
    return Verdict(squeezed, None), Verdict(closed, None), Verdict(positively_span(normals), None)
