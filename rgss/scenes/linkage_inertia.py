"""Inertia of a gripper's linkage, as its driven joint and its pads feel it.

The kinetic energy of a mechanism of one degree of freedom is half of its reflected inertia times the square of the
driven joint's speed. The share of one joint is the diagonal entry of the joint-space inertia matrix, the inertia of
all that the joint carries about its axis, times the square of the joint's ratio (R. Featherstone, *Rigid Body Dynamics
Algorithms*, 2008, section 6.2).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from rgss.scenes.joints import JointKind
from rgss.scenes.linkage import Linkage, LinkageLink, motion_of
from rgss.scenes.pose import Pose

_FAR_LIGHTER = 0.5


def reflected_inertias(linkage: Linkage) -> Mapping[int, float]:
    """Inertia of what each joint carries, reflected to the driven joint in mid-stroke, in kg·m² or kg."""
    poses = linkage.link_poses((linkage.opened + linkage.closed) / 2)
    return {
        index: link.multiplier**2
        * math.fsum(
            _about_axis(link, poses[index], linkage.links[part], poses[part]) for part in _carried_by(linkage, index)
        )
        for index, link in enumerate(linkage.links)
        if link.kind is not None
    }


@lru_cache(maxsize=16)
def leading_joint(linkage: Linkage) -> int:
    """Index of the child link of the joint to which a solver of impulses should tie all others.

    That is the driven joint, unless what it carries is far lighter than what another one carries. Many grippers have a
    driven joint that stands for the command alone. What passes through so light a link arrives only after as many
    iterations as the others are heavier.
    """
    inertias = reflected_inertias(linkage)
    heaviest = max(inertias, key=lambda index: (inertias[index], -index))
    return linkage.driven if inertias[linkage.driven] >= _FAR_LIGHTER * inertias[heaviest] else heaviest


@lru_cache(maxsize=16)
def pad_mass_kg(linkage: Linkage) -> float:
    """Equivalent mass of one finger at its pad, the lesser of both: what an object feels that the pad strikes.

    It is the greatest inertia that a joint of the finger reflects to the driven joint, divided by the square of the
    greatest travel of a pad per travel of that joint.
    """
    inertias = reflected_inertias(linkage)
    fingers = []
    for pad in linkage.pads:
        chain, link = [], pad.link
        while link >= 0:
            chain.append(link)
            link = linkage.links[link].parent
        fingers.append(max(inertias.get(index, 0.0) for index in chain))
    return min(fingers) / motion_of(linkage).greatest_transmission ** 2


def _carried_by(linkage: Linkage, carrier: int) -> list[int]:
    """Indices of a link and of all links beyond it."""
    found = [carrier]
    for index, link in enumerate(linkage.links):
        if index > carrier and link.parent in found:
            found.append(index)
    return found


def _about_axis(joint: LinkageLink, frame: Pose, link: LinkageLink, pose: Pose) -> float:
    """Inertia of a link about the axis of a revolute joint; its mass for a prismatic one."""
    if joint.kind is JointKind.PRISMATIC:
        return link.mass_kg
    axis = np.array(frame.rotate(joint.axis))
    placed = pose @ link.inertial
    along = np.array(placed.inverse_rotate(frame.rotate(joint.axis)))
    xx, yy, zz, xy, xz, yz = link.inertia_kg_m2
    moments = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    arm_m = np.cross(axis, np.subtract(placed.position_m, frame.position_m))
    return float(along @ moments @ along + link.mass_kg * arm_m @ arm_m)
