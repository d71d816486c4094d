"""Joint positions of a gripper for rendering, without drives."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.scenes import GripperGeometry, finger_joint, link_names_of, motion_of


def finger_joint_names(geometry: GripperGeometry) -> list[str]:
    """Names of the joints of sliding fingers, or of all movable joints of a linkage.

    Args:
        geometry: The gripper's shape.
    """
    linkage = geometry.linkage
    if linkage is None:
        return [finger_joint(finger) for finger in range(geometry.fingers)]
    named = zip(link_names_of(linkage), linkage.links, strict=True)
    return [f"{name}_joint" for name, link in named if link.kind is not None]


def finger_joint_positions(geometry: GripperGeometry, travel_m: Sequence[float]) -> Sequence[float]:
    """Positions of those joints at a travel of the pads from open.

    Args:
        geometry: The gripper's shape.
        travel_m: Travel of each pad in m.
    """
    linkage = geometry.linkage
    if linkage is None:
        return travel_m
    driven = motion_of(linkage).driven_at(travel_m[0])
    moved = (index for index, link in enumerate(linkage.links) if link.kind is not None)
    return [linkage.joint_position(index, driven) for index in moved]
