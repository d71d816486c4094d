"""``rgss robot``: summary of a robot's description, with findings."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rgss.counted import counted

if TYPE_CHECKING:
    from rgss.scenes import Follower, Joint
    from rgss.studies.robot_project import RobotSummary

HELP = "summarise an arm (joints, masses, reach, payload) and check its description"
EXAMPLE = "rgss robot my_arm.urdf -o workspace.svg"
MORE_EXAMPLES = (("rgss robot scenes/robots/my_arm.yaml", "an arm of a project, with the project's limits"),)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    from rgss.cli.options import add_arm_mass, add_xacro_arguments

    parser.add_argument("file", type=Path, metavar="FILE", help="a URDF, or a robot file of a project")
    parser.add_argument("--flange", metavar="LINK", help="of a URDF: the link that carries the gripper")
    add_arm_mass(parser, "of a URDF")
    add_xacro_arguments(parser, "of a URDF")
    parser.add_argument(
        "-o", "--output", type=Path, metavar="PICTURE", help="draw the workspace into this .png or .svg file"
    )


def run(options: argparse.Namespace) -> int:
    """Summarise; 1 if there are findings, 2 if the description cannot be used."""
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.options import arm_mass_kg, xacro_arguments
    from rgss.cli.output import print_json
    from rgss.engines import require_engines
    from rgss.reports import draw_workspace
    from rgss.studies.robot_project import robot_summary

    require_engines("'rgss robot'", pictures=options.output is not None)
    summary = robot_summary(
        options.file,
        flange=options.flange,
        mass_kg=arm_mass_kg(options.mass),
        xacro=xacro_arguments(options.xacro),
    )
    if options.output is not None:
        draw_workspace(summary.positions_m, options.output, title=summary.robot.id)
    if options.json:
        print_json(_plain(summary))
    else:
        _show(summary)
    return FINDINGS if summary.findings else CLEAN


def _show(summary: RobotSummary) -> None:
    from rgss.cli.output import print_table
    from rgss.scenes import JointKind

    robot = summary.robot
    print(
        f"{robot.id}: {counted(len(robot.joints), 'joint')} to {robot.flange}, {sum(summary.masses_kg.values()):.4g} kg"
    )
    print()
    rows = [(joint.name, joint.kind.value, *_limits(joint)) for joint in robot.joints]
    print_table(["joint", "kind", "range", "speed", "effort"], rows)
    for one in robot.followers:
        print(f"{one.name} ({one.kind.value}) follows: {_followed(one, robot.joints[one.driver])}.")
    print()
    start = "middle of its region" if robot.joints[0].kind is JointKind.PRISMATIC else "first axis"
    count = len(summary.positions_m)
    print(f"Reach: {summary.reach_m:.3f} m from the {start} to the flange, in the farthest of {count} configurations.")
    print(f"Payload by the joints' efforts, in the worst of {count} configurations: {_payload(summary.payload_kg)}.")
    if summary.convex_shapes:
        print(f"Collision meshes: {summary.convex_shapes} convex shapes stand for them.")
    if summary.left_out:
        pairs = ", ".join(f"{first} and {second}" for first, second in summary.left_out)
        print(f"Not checked, since they touch however the arm stands: {pairs}.")
    for note in summary.notes:
        print(f"Assumed: {note.rationale}")
    for finding in summary.findings:
        print(finding)


def _payload(held_kg: float) -> str:
    if math.isinf(held_kg):
        return "not limited by the joints, which carry no weight"
    return f"{held_kg:g} kg" if held_kg > 0.0 else "none"


def _followed(one: Follower, driver: Joint) -> str:
    from rgss.scenes import JointKind

    unit, factor = ("mm", 1e3) if one.kind is JointKind.PRISMATIC else ("deg", math.degrees(1.0))
    shift = f" {'+' if one.offset > 0.0 else '-'} {abs(one.offset) * factor:.6g} {unit}" if one.offset else ""
    ratio = "" if one.kind is driver.kind else " m/rad" if one.kind is JointKind.PRISMATIC else " rad/m"
    return f"{one.multiplier:.6g}{ratio} * {driver.name}{shift}"


def _limits(joint: Joint) -> tuple[str, str, str]:
    from rgss.scenes import JointKind

    if joint.kind is JointKind.PRISMATIC:
        ends = f"{joint.lower_rad * 1e3:.0f} to {joint.upper_rad * 1e3:.0f} mm"
        return ends, f"{joint.speed_rad_s:.3g} m/s", f"{joint.torque_n_m:.4g} N"
    lower, upper, speed = (math.degrees(value) for value in (joint.lower_rad, joint.upper_rad, joint.speed_rad_s))
    return f"{lower:.1f} to {upper:.1f} deg", f"{speed:.4g} deg/s", f"{joint.torque_n_m:.4g} N*m"


def _plain(summary: RobotSummary) -> dict[str, Any]:
    return {
        "robot": summary.robot.id,
        "flange": summary.robot.flange,
        "joints": [
            {
                "name": joint.name,
                "kind": joint.kind.value,
                "range": [joint.lower_rad, joint.upper_rad],
                "speed": joint.speed_rad_s,
                "effort": joint.torque_n_m,
            }
            for joint in summary.robot.joints
        ],
        "followers": [
            {
                "name": one.name,
                "kind": one.kind.value,
                "driver": summary.robot.joints[one.driver].name,
                "multiplier": one.multiplier,
                "offset": one.offset,
                "effort": one.effort if math.isfinite(one.effort) else None,
            }
            for one in summary.robot.followers
        ],
        "masses_kg": summary.masses_kg,
        "reach_m": summary.reach_m,
        "payload_kg": summary.payload_kg if math.isfinite(summary.payload_kg) else None,
        "convex_shapes": summary.convex_shapes,
        "left_out": [list(pair) for pair in summary.left_out],
        "touching_at_home": [list(pair) for pair in summary.at_home],
        "assumed": [note.rationale for note in summary.notes],
        "findings": [str(finding) for finding in summary.findings],
    }
