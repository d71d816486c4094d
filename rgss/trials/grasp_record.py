"""The grasp as the simulation has it, analysed for the record."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.evidence import Metric
from rgss.grasping import (
    ContactKind,
    ContactPoint,
    ContactState,
    ContactTolerances,
    Sliding,
    Tendency,
    Wrench,
    analyse_grasp,
    contact_status,
    recorded_motion,
)
from rgss.physics import World
from rgss.scenes import Pose

_RECORDED = (
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
PREFIX = "grasp_"
# A pyramid of six edges underrates friction by at most 1 - cos(30°); more edges cost more than the physics.
_CONE_EDGES = 6
# Contacts of the engine penetrate by hundredths of a millimetre, and friction gives way at less than this.
_TOLERANCES = ContactTolerances(gap_m=5.0e-5, speed_m_s=1.0e-3)


def grasp_metrics(world: World) -> dict[str, Metric]:
    """Analyse the contacts between fingers and workpiece as they are now.

    The contacts are hard points with friction, in the workpiece's frame; torques are divided by
    the workpiece's radius, so that grasps of one object can be compared; the load is its weight.

    Args:
        world: The world after a step.

    Returns:
        The measures of the grasp by name with unit; empty where no finger touches.
    """
    contacts = world.finger_contacts()
    if not contacts:
        return {}
    workpiece, gripper = world.scene.workpiece, world.gripper
    to_object = world.workpiece_pose().inverse()
    turn = Pose(quaternion_xyzw=to_object.quaternion_xyzw)
    points = [
        ContactPoint(
            position_m=(to_object @ Pose(position_m=contact.position_m)).position_m,
            normal=turn.rotate(contact.normal),
            kind=ContactKind.HARD,
            friction=gripper.friction * workpiece.friction,
            normal_force_n=contact.normal_force_n,
            friction_force_n=turn.rotate(contact.friction_n),
            gap_m=contact.gap_m,
            relative_velocity_m_s=turn.rotate(contact.relative_velocity_m_s),
            finger=contact.finger,
        )
        for contact in contacts
    ]
    weight_n = workpiece.mass_kg * world.scene.gravity_m_s2
    quality = analyse_grasp(
        points,
        centre_of_mass_m=(0.0, 0.0, 0.0),
        finger_force_limit_n=gripper.finger_force_n,
        grasp_axis=(0.0, 0.0, 1.0),
        characteristic_length_m=workpiece.shape.radius_m,
        external_wrench=Wrench(force_n=turn.rotate((0.0, 0.0, -weight_n))),
        cone_edges=_CONE_EDGES,
    )
    found = quality.metrics()
    return {**{f"{PREFIX}{name}": found[name] for name in _RECORDED}, **_kinematics(points)}


def _kinematics(points: Sequence[ContactPoint]) -> dict[str, Metric]:
    """How the contacts move: their least gap, and how many penetrate, part, or slip."""
    statuses = [contact_status(recorded_motion(point), _TOLERANCES) for point in points]
    return {
        "contact_gap_min_m": min(point.gap_m for point in points),
        "contacts_penetrating": sum(status.state is ContactState.PENETRATING for status in statuses),
        "contacts_separating": sum(status.tendency is Tendency.SEPARATING for status in statuses),
        "contacts_slipping": sum(status.sliding is Sliding.SLIPPING for status in statuses),
    }
