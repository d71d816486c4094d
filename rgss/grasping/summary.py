"""Summary of the analysis of one grasp."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields

from rgss.evidence.records import Metric
from rgss.grasping.closure import require_force_limit, resistance
from rgss.grasping.contact import ContactPoint, Vector3
from rgss.grasping.geometry import GraspGeometryCache
from rgss.grasping.grasp import Grasp
from rgss.grasping.grasp_matrix import net_wrench
from rgss.grasping.polygon import grasp_polygon
from rgss.grasping.quality import q_diff_m, q_gpri
from rgss.grasping.rigid_body import wrench_norm_n
from rgss.grasping.screws import Wrench


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspQuality:
    """Verdicts and quality measures of a grasp; the names carry the units, 1 for pure numbers.

    Attributes:
        contact_count: Number of contact points.
        finger_count: Number of their fingers.
        characteristic_length_m: Characteristic length, the divisor of torques.
        equilibrium: Whether the contacts can be in equilibrium without a load.
        equilibrium_margin_1: See `rgss.grasping.closure.equilibrium`; None, like the other two, if margins were not
        requested.
        force_closure: Whether every wrench can be resisted.
        force_closure_margin_1: See `rgss.grasping.closure.force_closure`.
        form_closure: Whether the normals alone immobilise the object.
        form_closure_margin_1: See `rgss.grasping.closure.form_closure`.
        q_msv_1: Smallest singular value of the grasp matrix.
        q_voe_1: Volume of the ellipsoid of wrenches.
        q_gii_1: Isotropy of the ellipsoid of wrenches.
        q_gpri_1: Irregularity of the grasp polygon; None for fewer than three corners.
        q_diff_m: Distance from the polygon's centroid to the centre of mass.
        q_smw_n: Smallest maximum wrench; None, like the load factor, if strength was not requested.
        net_wrench_n: Norm of the contacts' present net wrench.
        wrench_resistance: Whether the given load can be resisted; None if none was given.
        load_factor_1: The greatest multiple of that load; None if none was given, or a load of zero.
    """

    contact_count: int
    finger_count: int
    characteristic_length_m: float
    equilibrium: bool
    equilibrium_margin_1: float | None
    force_closure: bool
    force_closure_margin_1: float | None
    form_closure: bool
    form_closure_margin_1: float | None
    q_msv_1: float
    q_voe_1: float
    q_gii_1: float
    q_gpri_1: float | None
    q_diff_m: float
    q_smw_n: float | None
    net_wrench_n: float
    wrench_resistance: bool | None
    load_factor_1: float | None

    def metrics(self) -> dict[str, Metric]:
        """Attributes by name, as recorded by a trial: verdicts as 0 or 1."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: int(value) if isinstance(value, bool) else value for name, value in values.items()}


def analyse_grasp(
    contacts: Sequence[ContactPoint],
    *,
    centre_of_mass_m: Vector3,
    finger_force_limit_n: float,
    grasp_axis: Vector3 | None = None,
    characteristic_length_m: float | None = None,
    external_wrench: Wrench | None = None,
    cone_edges: int = 8,
    with_margins: bool = True,
    with_strength: bool = True,
    memory: GraspGeometryCache | None = None,
) -> GraspQuality:
    """Analyse the grasp of a set of contacts.

    Args:
        contacts: The contacts, at least one, in one frame, preferably fixed to the object (see `ContactPoint`).
        centre_of_mass_m: The object's centre of mass in that frame.
        finger_force_limit_n: Greatest normal force of a finger.
        grasp_axis: Normal of the plane of the grasp polygon, such as the gripper's axis; None to fit it to the
            contacts.
        characteristic_length_m: Characteristic length, the divisor of torques; None for the greatest distance of a
            contact from the centre of mass. Use the same length for all grasps of a comparison.
        external_wrench: Load about the centre of mass to be resisted, such as the weight.
        cone_edges: Edges of each friction pyramid.
        with_margins: True to compute the margins of the verdicts, by linear programs; the verdicts are the same
            without.
        with_strength: True to compute the strength of the grasp: the smallest maximum wrench, by a convex hull, and the
            load factor, by a linear program. An analysis without margins and strength is a few times as fast as with
            either.
        memory: Cache for repeated analysis of one grasp: the geometric measures are recomputed only if a contact has
            moved.

    Raises:
        DefinitionError: The contacts, the limit, the axis, the length or the load are invalid, or a solver failed.
    """
    grasp = Grasp.of(contacts, centre_of_mass_m, characteristic_length_m)
    require_force_limit(finger_force_limit_n)
    geometry = (memory or GraspGeometryCache()).geometry(grasp, cone_edges=cone_edges, with_margins=with_margins)
    polygon = grasp_polygon(grasp, grasp_axis)
    load = (
        resistance(grasp, geometry.edges, external_wrench, finger_force_limit_n=finger_force_limit_n)
        if external_wrench is not None and with_strength
        else None
    )
    is_loaded = load is not None and math.isfinite(load.margin)
    return GraspQuality(
        contact_count=len(grasp.contacts),
        finger_count=len(grasp.fingers()),
        characteristic_length_m=grasp.characteristic_length_m,
        equilibrium=geometry.squeeze.holds,
        equilibrium_margin_1=geometry.squeeze.margin,
        force_closure=geometry.force.holds,
        force_closure_margin_1=geometry.force.margin,
        form_closure=geometry.form.holds,
        form_closure_margin_1=geometry.form.margin,
        q_msv_1=geometry.q_msv_1,
        q_voe_1=geometry.q_voe_1,
        q_gii_1=geometry.q_gii_1,
        q_gpri_1=q_gpri(polygon),
        q_diff_m=q_diff_m(polygon),
        q_smw_n=finger_force_limit_n * geometry.smallest_maximum_1 if with_strength else None,
        net_wrench_n=wrench_norm_n(net_wrench(grasp), grasp.characteristic_length_m),
        wrench_resistance=None if load is None else load.holds,
        load_factor_1=load.margin + 1.0 if load is not None and is_loaded else None,
    )
