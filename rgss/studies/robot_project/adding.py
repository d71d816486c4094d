"""Adding of an arm of which there is a URDF to a project."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from rgss.errors import DefinitionError
from rgss.findings import printable
from rgss.studies.arms import ARM
from rgss.studies.robot_project.urdf import NO_ARGUMENTS, Note
from rgss.studies.robot_project.writing import write_robot_project
from rgss.studies.scaffolding import write_new_files

_ROBOTS = PurePosixPath("scenes/robots")


@dataclass(frozen=True, slots=True, kw_only=True)
class AddedRobot:
    """An arm that was added to a project.

    Attributes:
        id: Its id.
        file: Its robot file, relative to the project.
        files: Names of all its files, relative to the project.
        notes: What was assumed about the URDF; the robot file states it too.
    """

    id: str
    file: str
    files: tuple[str, ...]
    notes: tuple[Note, ...]

    @property
    def component(self) -> str:
        """Its entry for the catalogue, of which the price and its source are to be filled in."""
        return (
            f"  - id: {self.id}\n"
            f"    role: {ARM}\n"
            f"    name: {self.id}\n"
            "    manufacturer: not stated\n"
            f"    geometry: {self.file}\n"
            "    cost: {value: PRICE, source: OFFER}\n"
        )


def add_robot(
    urdf: Path,
    folder: Path,
    *,
    flange: str | None = None,
    tool_axis: str | None = None,
    mass_kg: float | None = None,
    xacro: Mapping[str, str] = NO_ARGUMENTS,
    on_stage: Callable[[str], None] | None = None,
) -> AddedRobot:
    """Write the robot file of another arm into a project, in a folder of its own, beside its URDF and its meshes.

    Flange, axis of the tool, home and ranges of the joints are those with which a project of its own would be made.

    Args:
        urdf: The URDF.
        folder: The project; nothing in it is overwritten.
        flange: The link that carries the gripper; found where None.
        tool_axis: The axis of that link along which the gripper points; the first that works where None.
        mass_kg: Mass of the arm with its base, for a URDF without masses.
        xacro: Arguments, if it is a xacro.
        on_stage: Called with the name of each stage of the search, which may take minutes, before it begins.

    Raises:
        DefinitionError: The folder is no project or has the arm, or the URDF is wrong or has no arm that the task can
            be fitted to.
    """
    if not (folder / "scenes").is_dir():
        message = f"{printable(str(folder))} is not a project: it has no folder 'scenes'"
        raise DefinitionError(message, hint="make one without --add")
    with tempfile.TemporaryDirectory() as scratch:
        alone = Path(scratch) / "alone"
        written = write_robot_project(
            urdf, alone, flange=flange, tool_axis=tool_axis, mass_kg=mass_kg, xacro=xacro, on_stage=on_stage
        )
        own = [PurePosixPath(name) for name in written.files if PurePosixPath(name).is_relative_to(_ROBOTS)]
        (robot,) = (name for name in own if name.parent == _ROBOTS and name.suffix == ".yaml")
        place = _ROBOTS / robot.stem
        if (folder / place).exists():
            message = f"{printable(str(folder / place))} is there already, and nothing is overwritten"
            raise DefinitionError(message, hint="remove it, or give the robot in the URDF another name")
        contents = {(place / name.relative_to(_ROBOTS)).as_posix(): (alone / name).read_bytes() for name in own}
        write_new_files(folder, contents)
    return AddedRobot(
        id=robot.stem, file=(place / robot.name).as_posix(), files=tuple(sorted(contents)), notes=written.notes
    )
