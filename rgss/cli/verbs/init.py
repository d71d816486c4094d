"""``rgss init``: a new project."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

HELP = "make a new project: one scene, four designs, requirements that trace to them"
EXAMPLE = "rgss init my_project"
MORE_EXAMPLES = (
    ("rgss init", "in the current folder, whose files are kept"),
    ("rgss init --robot my_arm.urdf my_project", "for your own arm, from its URDF"),
    ("rgss init --robot my_arm.urdf --gripper my_gripper.urdf my_project", "and your own gripper"),
    ("rgss init --robot other_arm.urdf --add my_project", "another arm for its designs to choose"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    from rgss.cli.options import add_arm_mass, add_xacro_arguments

    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path(), metavar="FOLDER", help="the new folder (default: this one)"
    )
    parser.add_argument(
        "--robot", type=Path, metavar="URDF", help="make it for this arm; the URDF, or xacro, and its meshes are copied"
    )
    parser.add_argument(
        "--flange", metavar="LINK", help="with --robot: the link that carries the gripper (default: the arm's last)"
    )
    parser.add_argument(
        "--tool-axis",
        choices=("x", "-x", "y", "-y", "z", "-z"),
        help="with --robot: the axis of that link along which the gripper points (default: the first that works)",
    )
    add_arm_mass(parser, "with --robot")
    parser.add_argument(
        "--gripper",
        type=Path,
        metavar="URDF",
        help="with --robot: the URDF of your gripper, or again that of the arm for the hand that it has",
    )
    add_xacro_arguments(parser, "with --robot")
    parser.add_argument(
        "--add", action="store_true", help="with --robot: add the arm to the project in FOLDER, and nothing else"
    )
    parser.add_argument(
        "--currency", default="USD", metavar="CODE", help="currency of the costs by its ISO 4217 code (default: USD)"
    )


def run(options: argparse.Namespace) -> int:
    """Write the files and name the next commands."""
    import shlex

    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json
    from rgss.currencies import is_currency
    from rgss.errors import DefinitionError
    from rgss.findings import printable, shown

    folder: Path = options.folder
    if options.project is not None:
        raise DefinitionError("--project names an existing project", hint=f"rgss init {options.project}")
    for name, what in (
        ("flange", "names a link"),
        ("tool_axis", "names an axis"),
        ("mass", "is that of the arm"),
        ("gripper", "is for the arm"),
        ("xacro", "is an argument"),
        ("add", "adds the arm"),
    ):
        if getattr(options, name) not in (None, False) and options.robot is None:
            option = f"--{name.replace('_', '-')}"
            raise DefinitionError(f"{option} {what} of a URDF", hint="give the URDF with --robot")
    if options.add and options.gripper is not None:
        hint = "make a project with both, and copy its gripper file"
        raise DefinitionError("--gripper is not for an arm that is added", hint=hint)
    if not is_currency(options.currency):
        upper = options.currency.upper()
        hint = f"did you mean {upper}?" if is_currency(upper) else "give an ISO 4217 code, such as EUR"
        raise DefinitionError(f"--currency: {shown(options.currency)} is not the code of a currency", hint=hint)
    if options.add:
        return _add(options)
    files, notes = _new_files(options) if options.robot is None else _robot_files(options)
    if options.json:
        print_json({"folder": str(folder), "files": list(files), "assumed": list(notes)})
        return CLEAN
    for note in notes:
        print(f"Assumed: {note}", file=sys.stderr)
    name = folder.resolve().name if folder.resolve() == Path.cwd() else printable(folder.as_posix())
    print(f"A project of {len(files)} files is in {name}/; its README.md says what each is for. Next:")
    print()
    if folder.resolve() != Path.cwd():
        print(f"  cd {shlex.quote(str(folder))}")
    print("  rgss check     # are the files sound?")
    print("  rgss sweep     # run the trials in simulation")
    print("  rgss trade     # which design is best, and why")
    return CLEAN


def _new_files(options: argparse.Namespace) -> tuple[tuple[str, ...], tuple[str, ...]]:
    from rgss.exchange import MAPPING_KIND
    from rgss.studies import write_scaffold

    return write_scaffold(options.folder, [MAPPING_KIND], currency=options.currency), ()


def _robot_files(options: argparse.Namespace) -> tuple[tuple[str, ...], tuple[str, ...]]:
    from rgss.cli.options import arm_mass_kg, xacro_arguments
    from rgss.cli.terminal import stage_progress
    from rgss.engines import require_engines
    from rgss.exchange import MAPPING_KIND
    from rgss.studies.robot_project import write_robot_project

    require_engines("rgss init --robot")
    with stage_progress(options.robot.name) as on_stage:
        written = write_robot_project(
            options.robot,
            options.folder,
            flange=options.flange,
            tool_axis=options.tool_axis,
            mass_kg=arm_mass_kg(options.mass),
            gripper=options.gripper,
            xacro=xacro_arguments(options.xacro),
            currency=options.currency,
            kinds=[MAPPING_KIND],
            on_stage=on_stage,
        )
    return written.files, tuple(note.rationale for note in written.notes)


def _add(options: argparse.Namespace) -> int:
    """Add an arm to a project, and print what lets the designs choose it."""
    from rgss.cli.main import CLEAN
    from rgss.cli.options import arm_mass_kg, xacro_arguments
    from rgss.cli.output import print_json
    from rgss.cli.terminal import stage_progress
    from rgss.engines import require_engines
    from rgss.studies.robot_project import add_robot

    require_engines("rgss init --robot")
    with stage_progress(options.robot.name) as on_stage:
        added = add_robot(
            options.robot,
            options.folder,
            flange=options.flange,
            tool_axis=options.tool_axis,
            mass_kg=arm_mass_kg(options.mass),
            xacro=xacro_arguments(options.xacro),
            on_stage=on_stage,
        )
    notes = [note.rationale for note in added.notes]
    if options.json:
        print_json({"folder": str(options.folder), "files": list(added.files), "assumed": notes})
        return CLEAN
    for note in notes:
        print(f"Assumed: {note}", file=sys.stderr)
    print(f"The arm {added.id} is in {added.file}. Add it to the components of the catalogue, with its price:")
    print()
    print(added.component)
    print("A design parameter chooses between the arms, and a factor has them as levels:")
    print()
    print("  - {id: arm, name: arm, symbol: a, kind: name, sets: catalogue.manipulator, description: The arm.}")
    return CLEAN
