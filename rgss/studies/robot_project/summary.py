"""Kinematic and dynamic summary of an arm, and what is suspicious in its description."""

from __future__ import annotations

import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.documents import read_document
from rgss.findings import Finding, Severity
from rgss.kinematics import Arm, lasting_contacts, touching_links
from rgss.scenes import Pose, Robot, convex_parts, load_robot
from rgss.studies.robot_project.description import assumed_subjects, description_findings, weak_joint_findings
from rgss.studies.robot_project.draft import drafted_robot
from rgss.studies.robot_project.holding import payload_kg
from rgss.studies.robot_project.reach import arm_reach_m, sampled_configurations
from rgss.studies.robot_project.urdf import NO_ARGUMENTS, Note

_YAML = frozenset({".yaml", ".yml"})


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RobotSummary:
    """Summary of an arm.

    Attributes:
        robot: The arm, its base in the world's origin.
        masses_kg: Mass of each link that has one, in the order of the URDF; mere frames are left out.
        reach_m: Greatest distance of the flange from the line of the first axis, or from the middle of its region if
            the first joint is prismatic, over sampled configurations.
        payload_kg: Mass at the flange that the joints' efforts hold in every sampled configuration; infinite if no
            joint carries weight.
        convex_shapes: Number of convex shapes that replace meshes.
        left_out: Pairs of links that touch in every configuration, and are not checked.
        at_home: Pairs of links that touch at the home.
        positions_m: Positions of the flange in sampled configurations, shape (k, 3).
        findings: The findings.
        notes: What was assumed about the URDF.
    """

    robot: Robot
    masses_kg: dict[str, float]
    reach_m: float
    payload_kg: float
    convex_shapes: int
    left_out: tuple[tuple[str, str], ...]
    at_home: tuple[tuple[str, str], ...]
    positions_m: NDArray[np.float64]
    findings: tuple[Finding, ...]
    notes: tuple[Note, ...] = ()


def robot_summary(
    path: Path, *, flange: str | None = None, mass_kg: float | None = None, xacro: Mapping[str, str] = NO_ARGUMENTS
) -> RobotSummary:
    """Summarise the arm of a URDF or of a robot file.

    Args:
        path: The URDF, or the robot file.
        flange: Of a URDF, the link that carries the gripper; found where None.
        mass_kg: Of a URDF without masses, that of the whole arm.
        xacro: Arguments, if the URDF is a xacro.

    Raises:
        DefinitionError: There is no arm in the URDF, or it is wrong.
        DocumentError: The robot file is wrong; with every problem in it.
    """
    if path.suffix.lower() in _YAML:
        project = next((one for one in path.resolve().parents if (one / "scenes").is_dir()), path.resolve().parent)
        robot = load_robot(path, base=Pose(), label=path.name, project=project)
        data = read_document(path, label=path.name).data
        urdf = path.parent / str(data["description"])
        return _summary(robot, urdf, urdf.name, assumed_subjects(data))
    with tempfile.TemporaryDirectory() as folder:
        drafted = drafted_robot(path, Path(folder), flange=flange, mass_kg=mass_kg, xacro=xacro)
        found = _summary(drafted.robot, drafted.file.with_suffix(".urdf"), path.name, lines_of=path)
        return replace(found, notes=drafted.arm.notes)


def _summary(
    robot: Robot, urdf: Path, label: str, assumed: Collection[str] = (), lines_of: Path | None = None
) -> RobotSummary:
    root = ET.fromstring(robot.urdf)  # noqa: S314 - entities and document types were refused on reading
    masses = {
        link.get("name", ""): float(mass.get("value", "0"))
        for link in root.findall("link")
        for mass in link.findall("inertial/mass")
    }
    at_home = touching_links(robot, robot.home_rad)
    findings = list(description_findings(robot, urdf, label, assumed=assumed, lines_of=lines_of))
    left_out = lasting_contacts(robot)
    pairs = [pair for pair in at_home if frozenset(pair) not in left_out]
    findings += [
        Finding(
            file=label,
            line=1,
            column=1,
            rule="robot.self-collision",
            severity=Severity.WARNING,
            message=f"{first} touches {second} at the home",
            hint="choose another home, or let the collision shapes be closer to the links",
        )
        for first, second in pairs
    ]
    findings += weak_joint_findings(robot, urdf if lines_of is None else lines_of, label)
    return RobotSummary(
        robot=robot,
        masses_kg={name: mass for name, mass in masses.items() if mass > 1e-5},
        reach_m=arm_reach_m(robot),
        payload_kg=payload_kg(robot),
        convex_shapes=len(convex_parts(robot.urdf)[1]),
        left_out=tuple(sorted((min(pair), max(pair)) for pair in left_out)),
        at_home=tuple(pairs),
        positions_m=Arm(robot, Pose()).tool_position(sampled_configurations(robot)),
        findings=tuple(findings),
    )
