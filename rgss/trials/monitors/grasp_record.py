"""Grasp metrics of the simulated grasp at one instant, for the record."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType

from rgss.evidence import Metric
from rgss.grasping import (
    ContactKind,
    ContactPoint,
    ContactState,
    ContactTolerances,
    GraspGeometryCache,
    Sliding,
    Tendency,
    Twist,
    Wrench,
    analyse_grasp,
    configuration_distance_m,
    contact_status,
    recorded_motion,
    velocity_norm_m_s,
)
from rgss.physics import ContactWorld, FingerContact
from rgss.scenes import RIBS, Cylinder, ObjectShape, Pose, centre_of_mass, girth_radius_m
from rgss.trials.metrics import CARRY_METRICS, GRASP_METRICS, Aggregation, Direction
from rgss.trials.monitors.in_hand_motion import HandMotion

Vector3 = tuple[float, float, float]

_WORST: Mapping[str, Callable[[Iterable[float]], float]] = MappingProxyType(
    {
        metric.name: min if metric.better is Direction.HIGHER else max
        for metric in (*GRASP_METRICS, *CARRY_METRICS)
        if metric.trial is Aggregation.WORST_CARRIED
    }
)
_ANALYSED = (
    "contact_count",
    "equilibrium",
    "force_closure",
    "form_closure",
    "q_msv_1",
    "q_voe_1",
    "q_gii_1",
    "q_gpri_1",
    "q_diff_m",
    "q_smw_n",
    "load_factor_1",
)
# A pyramid of six edges underestimates friction by at most 1 - cos(30°); more edges take longer than the physics.
_CONE_EDGES = 6
# Contacts of the engine penetrate by hundredths of a millimetre beyond a pad's deflection; a held object moves in its
# fingers by less than that between samples (0.35 mm/s was observed; a slipping object is ten times as fast).
_PENETRATION_M, _SLIP_M_S = 5.0e-5, 1.0e-3
# A point deeper than this is not on the wall.
_WALL_M = 1.0e-3
# Metrics of a lost grasp: no closure, all others are undefined.
_APART: Mapping[str, Metric] = {
    **{f"grasp_{name}": 0 for name in ("contact_count", "equilibrium", "force_closure", "form_closure")},
    **{f"grasp_{name}": 0.0 for name in ("q_msv_1", "q_voe_1", "q_gii_1", "q_smw_n", "load_factor_1")},
    "held_wrench_n": 0.0,
}


def grasp_metrics(
    world: ContactWorld, motion: HandMotion, held_at: Pose, memory: GraspGeometryCache, *, strength: bool = True
) -> dict[str, Metric]:
    """Metrics of the present contacts between fingers and workpiece, and of the workpiece's motion in the hand.

    The contacts are points with friction in the workpiece's frame; the characteristic length of torques is the
    workpiece's greatest distance from its vertical axis, so that grasps of one object are comparable; the load is its
    weight.

    Args:
        world: The world after a step.
        motion: Motion in the hand.
        held_at: Transform of the workpiece to the grasp-centre frame at the grasp.
        memory: Cache of the grasp analysis between samples.
        strength: True to compute the strength of the grasp, which takes most of the time.

    Returns:
        Metrics by name with unit; without a contact those that need one are 0 or missing.
    """
    workpiece, gripper = world.scene.workpiece, world.gripper
    contacts = world.finger_contacts()
    moved = _motion_in_the_hand(motion, held_at, girth_radius_m(workpiece.shape))
    if gripper.suction is not None:
        return moved  # a seal is one surface, which contact points do not describe
    if not contacts:
        return {**_APART, **moved}
    closing = [
        _closing_velocity(azimuth, speed, motion)
        for azimuth, speed in zip(gripper.geometry.azimuths_rad, motion.closing_m_s, strict=True)
    ]
    friction = gripper.friction * workpiece.friction
    points = [_point(one, workpiece.shape, friction, motion, closing[one.finger]) for one in contacts]
    weight_n = workpiece.mass_kg * world.scene.gravity_m_s2
    found = analyse_grasp(
        points,
        centre_of_mass_m=centre_of_mass(workpiece),
        finger_force_limit_n=gripper.finger_force_n,
        grasp_axis=(0.0, 0.0, 1.0),
        characteristic_length_m=girth_radius_m(workpiece.shape),
        external_wrench=Wrench(force_n=world.workpiece_pose().inverse_rotate((0.0, 0.0, -weight_n))),
        cone_edges=_CONE_EDGES,
        with_margins=False,
        with_strength=strength,
        memory=memory,
    ).metrics()
    return {
        **{f"grasp_{name}": found[name] for name in _ANALYSED},
        **_kinematics(points, _tolerances(world)),
        **moved,
        "held_wrench_n": found["net_wrench_n"],
    }


def worst_of(samples: Iterable[Mapping[str, Metric]]) -> dict[str, Metric]:
    """Worst value of each metric over several samples, by its preferred direction, if it has any value."""
    rows = list(samples)
    worst: dict[str, Metric] = {}
    for name, choose in _WORST.items():
        known = [value for row in rows if isinstance(value := row.get(name), (int, float))]
        if known:
            worst[name] = choose(known)
    return worst


def _point(
    contact: FingerContact, shape: ObjectShape, friction: float, motion: HandMotion, closing_m_s: Vector3
) -> ContactPoint:
    normal = _wall_normal(contact, shape)
    nx, ny, nz = contact.normal
    fx, fy, fz = contact.friction_n
    force = contact.normal_force_n
    fx, fy, fz = fx + force * nx, fy + force * ny, fz + force * nz
    # The total force is the engine's; its split into normal and friction force depends on the normal.
    pressure = max(0.0, fx * normal[0] + fy * normal[1] + fz * normal[2])
    vx, vy, vz = motion.velocity_at(contact.position_m)
    return ContactPoint(
        position_m=contact.position_m,
        normal=normal,
        kind=ContactKind.HARD,
        friction=friction,
        normal_force_n=pressure,
        friction_force_n=(fx - pressure * normal[0], fy - pressure * normal[1], fz - pressure * normal[2]),
        gap_m=contact.gap_m,
        relative_velocity_m_s=(vx - closing_m_s[0], vy - closing_m_s[1], vz - closing_m_s[2]),
        finger=contact.finger,
    )


def _wall_normal(contact: FingerContact, shape: ObjectShape) -> Vector3:
    """Normal of the wall if the contact is on it; the engine's normal may be outdated."""
    if not isinstance(shape, Cylinder):
        return contact.normal
    x, y, z = contact.position_m
    radius = math.hypot(x, y)
    if radius < shape.radius_m - _WALL_M or abs(z) > shape.half_height_m:
        return contact.normal
    return (-x / radius, -y / radius, 0.0)


def _closing_velocity(azimuth_rad: float, speed_m_s: float, motion: HandMotion) -> Vector3:
    """Velocity of a closing finger in the object's frame; fingers close perpendicular to the tool's axis."""
    return motion.held.inverse_rotate((-speed_m_s * math.cos(azimuth_rad), -speed_m_s * math.sin(azimuth_rad), 0.0))


def _tolerances(world: ContactWorld) -> ContactTolerances:
    """Tolerances of the contact status; a pad may deflect by the finger's full force on one of its ends."""
    yields_m = world.gripper.finger_force_n / (world.settings.pad_stiffness_n_m / RIBS)
    return ContactTolerances(gap_m=_PENETRATION_M + yields_m, speed_m_s=_SLIP_M_S)


def _kinematics(points: Sequence[ContactPoint], tolerances: ContactTolerances) -> dict[str, Metric]:
    """Contact kinematics: gap and its rate, slip, and counts by status."""
    motions = [recorded_motion(point) for point in points]
    statuses = [contact_status(motion, tolerances) for motion in motions]
    rates = [motion.gap_rate_m_s for motion in motions]
    return {
        "contact_gap_min_m": min(point.gap_m for point in points),
        "contact_closing_speed_m_s": max(0.0, -min(rates)),
        "contact_opening_speed_m_s": max(0.0, *rates),
        "contact_slip_speed_m_s": max(math.hypot(*motion.tangential_velocity_m_s) for motion in motions),
        "contacts_penetrating": sum(status.state is ContactState.PENETRATING for status in statuses),
        "contacts_separating": sum(status.tendency is Tendency.SEPARATING for status in statuses),
        "contacts_slipping": sum(status.sliding is Sliding.SLIPPING for status in statuses),
        "contacts_rolling": sum(status.sliding is Sliding.ROLLING for status in statuses),
    }


def _motion_in_the_hand(motion: HandMotion, held_at: Pose, radius_m: float) -> dict[str, Metric]:
    """Rigid-body norms of the workpiece's displacement in the hand since the grasp, and of its velocity."""
    linear, angular = motion.twist()
    return {
        "held_distance_m": configuration_distance_m(held_at, motion.held, radius_m),
        "held_speed_m_s": velocity_norm_m_s(Twist(linear_m_s=linear, angular_rad_s=angular), radius_m),
    }
