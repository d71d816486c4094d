"""Masses of links for which a URDF has none: from the arm's total mass, by volume."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from rgss.errors import DefinitionError
from rgss.scenes import LinkSolid, carried_by, link_solid, loads_without_inertia, standing_links
from rgss.studies.robot_project.urdf.files import find_named_file
from rgss.studies.robot_project.urdf.reading import Note

_LEAST_SHARE = 1e-3
_GYRATION_M = 0.02
_SMALL_KG = 1e-3
_NAMES_SHOWN = 6


def complete_masses(root: ET.Element, urdf: Path, *, leave: Sequence[str], mass_kg: float | None) -> list[Note]:
    """Give each link that needs a mass and has none one.

    A link that is fixed to one with a mass is taken to be weighed with it. Others share, by the volume of their shapes,
    what the links that state a mass leave of the arm's total.

    Args:
        root: The URDF; it is changed.
        urdf: Its file, from which meshes are found.
        leave: Links that are not of the arm, with what they carry.
        mass_kg: Mass of the whole arm with its base; None where it is not known.

    Raises:
        DefinitionError: Masses are missing and the total is not given, or it is less than the stated ones.
    """
    links = {link.get("name", ""): link for link in root.findall("link")}
    gone = carried_by(root, leave)
    standing = standing_links(root)
    of_arm = [name for name in links if name not in gone]
    stated = {name: mass for name in of_arm if (mass := _mass(links[name])) > 0.0}
    lacking = [name for name in loads_without_inertia(root) if name not in gone]
    notes = [
        *_without_inertia(links, [name for name in lacking if name in stated], urdf),
        *_weighed_with_others(root, links, [name for name in lacking if name not in stated], stated),
    ]
    massless = [name for name in loads_without_inertia(root) if name not in gone]
    if not massless:
        if mass_kg is None:
            return notes
        raise DefinitionError("every link of the arm has a mass", hint="leave --mass out, or correct the URDF's masses")
    stated_kg = sum(stated.values())
    left_kg = _mass_left(mass_kg, stated_kg, massless, urdf)
    sharing = [*massless, *(name for name in of_arm if name in standing and name not in stated)]
    have_shapes = _distribute(left_kg, links, massless, sharing, urdf)
    rationale = (
        f"{len(massless)} links have no mass in the URDF. {mass_kg:g} kg of the whole arm are distributed"
        " over them and the base by the volume of their shapes, as homogeneous bodies: a caution on all torques,"
        " and on the payload."
        if have_shapes
        else f"{', '.join(massless)} have neither a mass nor a shape in the URDF, and weigh "
        f"{_LEAST_SHARE * left_kg:.3g} kg each: the {stated_kg:g} kg of the other links are kept, not scaled to "
        f"{mass_kg:g} kg."
    )
    return [*notes, Note(about="description", rationale=rationale)]


def _mass_left(mass_kg: float | None, stated_kg: float, massless: Sequence[str], urdf: Path) -> float:
    """Mass that the links with a mass leave of the arm's total."""
    if mass_kg is None:
        shown = ", ".join(massless[:_NAMES_SHOWN]) + (", …" if len(massless) > _NAMES_SHOWN else "")
        links_text = "1 link" if len(massless) == 1 else f"{len(massless)} links"
        raise DefinitionError(
            f"{urdf.name} has no mass or no inertia for {links_text}: {shown}",
            hint="give the mass of the whole arm, which is distributed by volume: --mass '20 kg'",
        )
    if mass_kg <= stated_kg:
        raise DefinitionError(
            f"--mass is {mass_kg:g} kg, and the links that state a mass weigh {stated_kg:g} kg",
            hint="give the mass of the whole arm with its base",
        )
    return mass_kg - stated_kg


def _distribute(
    left_kg: float, links: Mapping[str, ET.Element], massless: Sequence[str], sharing: Sequence[str], urdf: Path
) -> bool:
    """Write the masses of links, by their volume among those that share; False if none of these has a shape."""
    solids = {name: link_solid(links[name], lambda file: find_named_file(file, urdf)) for name in sharing}
    total_m3 = sum(solid.volume_m3 for solid in solids.values() if solid is not None)
    for name in massless:
        solid = solids[name]
        share = 0.0 if solid is None or total_m3 == 0.0 else solid.volume_m3 / total_m3
        _write(links[name], max(share, _LEAST_SHARE) * left_kg, solid)
    return total_m3 != 0.0


def _without_inertia(links: dict[str, ET.Element], names: list[str], urdf: Path) -> list[Note]:
    for name in names:
        solid = link_solid(links[name], lambda file: find_named_file(file, urdf))
        _write(links[name], _mass(links[name]), solid)
    if not names:
        return []
    text = f"The URDF has a mass and no inertia of {', '.join(names)}: homogeneous bodies of their shapes are assumed."
    return [Note(about="description", rationale=text)]


def _weighed_with_others(
    root: ET.Element, links: dict[str, ET.Element], names: list[str], stated: dict[str, float]
) -> list[Note]:
    """Write a mass that counts for nothing to links fixed to one that states a mass."""
    beside: dict[str, set[str]] = {name: {name} for name in links}
    for joint in root.findall("joint"):
        ends = [end.get("link", "") for key in ("parent", "child") for end in joint.findall(key)]
        if joint.get("type") == "fixed" and len(ends) == 2 and all(end in links for end in ends):
            joined = beside[ends[0]] | beside[ends[1]]
            for name in joined:
                beside[name] = joined
    found = [name for name in names if beside[name] & stated.keys()]
    for name in found:
        _write(links[name], _SMALL_KG, None)
    if not found:
        return []
    text = f"{', '.join(found)} have no mass in the URDF, and are fixed to links that have one: weighed with these."
    return [Note(about="description", rationale=text)]


def _write(link: ET.Element, mass_kg: float, solid: LinkSolid | None) -> None:
    """Replace a link's inertial by that of its shapes, of a small ball where it has none."""
    for old in link.findall("inertial"):
        link.remove(old)
    centre = np.zeros(3) if solid is None else solid.centre_m
    inertia = np.eye(3) * mass_kg * _GYRATION_M**2 if solid is None else solid.inertia_m5 / solid.volume_m3 * mass_kg
    inertial = ET.Element("inertial")
    link.insert(0, inertial)
    ET.SubElement(inertial, "origin", {"xyz": " ".join(f"{value:.6g}" for value in centre), "rpy": "0 0 0"})
    ET.SubElement(inertial, "mass", {"value": f"{mass_kg:.6g}"})
    entries = (("ixx", 0, 0), ("iyy", 1, 1), ("izz", 2, 2), ("ixy", 0, 1), ("ixz", 0, 2), ("iyz", 1, 2))
    ET.SubElement(inertial, "inertia", {key: f"{inertia[row, column]:.9g}" for key, row, column in entries})


def _mass(link: ET.Element) -> float:
    mass = link.find("inertial/mass")
    try:
        value = 0.0 if mass is None else float(mass.get("value", "0"))
    except ValueError:
        return 0.0
    return value if math.isfinite(value) else 0.0
