"""Writing of a new project round an arm."""

from __future__ import annotations

import itertools
import math
import re
import tempfile
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path, PurePosixPath

from rgss.currencies import DOLLAR
from rgss.errors import DefinitionError
from rgss.scenes import GripperGeometry, Robot, load_gripper_file
from rgss.studies.project import load_project
from rgss.studies.robot_project.descent_search import (
    DOWN_ELSEWHERE,
    NOT_VERTICAL,
    UNMENDED,
    angles_from_vertical_rad,
)
from rgss.studies.robot_project.description import description_findings
from rgss.studies.robot_project.draft import DraftedRobot, drafted_robot
from rgss.studies.robot_project.drafted_gripper import DraftedGripper
from rgss.studies.robot_project.first_trial import carries_object, has_scene_errors
from rgss.studies.robot_project.fitting import POINTS_INTO_ARM, CellSearch, FittedCell
from rgss.studies.robot_project.gripper_axes import axes_of_gripper, gripper_or_hand
from rgss.studies.robot_project.gripper_texts import with_gripper
from rgss.studies.robot_project.hand_size import HandSize, hand_sizes
from rgss.studies.robot_project.holding import payload_kg
from rgss.studies.robot_project.layout import scene_text
from rgss.studies.robot_project.reach import SAMPLES, greatest_travel_m
from rgss.studies.robot_project.robot_text import robot_text
from rgss.studies.robot_project.unfit_shapes import UnfitShapesError, is_any_mesh_concave
from rgss.studies.robot_project.urdf import INSTALL, NO_ARGUMENTS, Note, can_decompose
from rgss.studies.scaffolding import in_currency, scaffold_texts, schema_texts, write_new_files
from rgss.studies.schemas import DocumentKind

_MOST_AXES, _MOST_CELLS = 3, 4
# Greatest angle from the vertical, in a sampled configuration, of an axis that an arm may turn down.
_NEAR_DOWN_RAD = math.radians(30.0)
_RESOLUTION_RAD, _RESOLUTION_STEP_RAD = 0.01, 0.0005
_ITERATIONS = "solver_iterations: 100 # joints follow their targets with any distribution of the arm's masses"


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotProject:
    """A project that was written round an arm.

    Attributes:
        files: Names of the files, relative to the folder.
        notes: What was assumed about the URDF; the robot file states it too.
    """

    files: tuple[str, ...]
    notes: tuple[Note, ...]


def write_robot_project(
    urdf: Path,
    folder: Path,
    *,
    flange: str | None = None,
    tool_axis: str | None = None,
    mass_kg: float | None = None,
    gripper: Path | None = None,
    xacro: Mapping[str, str] = NO_ARGUMENTS,
    currency: str = DOLLAR,
    kinds: Sequence[DocumentKind] = (),
    on_stage: Callable[[str], None] | None = None,
) -> RobotProject:
    """Write a new project round the arm of a URDF into a folder, which is made if it is not there.

    The URDF and the meshes that it names are copied. The robot file has the URDF's limits; the tables are scaled to
    the arm's reach.

    Args:
        urdf: The URDF.
        folder: The folder; nothing in it is overwritten.
        flange: The link that carries the gripper; found where None.
        tool_axis: The axis of that link along which the gripper points; the first that works where None.
        mass_kg: Mass of the arm with its base, for a URDF without masses.
        gripper: The URDF of a gripper, or that of the arm for the hand that it has; two grippers with sliding fingers
            where None.
        xacro: Arguments, if one of them is a xacro.
        currency: Code of the currency of its amounts, which are the same in each.
        kinds: Further kinds of documents whose schemas it gets.
        on_stage: Called with the name of each stage of the search, which may take minutes, before it begins.

    Raises:
        DefinitionError: A URDF is wrong or has no arm that the task can be fitted to, or a file is there already.
    """
    report = on_stage or (lambda _: None)
    with tempfile.TemporaryDirectory() as scratch:

        def write(name: str, *, is_decomposed: bool, is_gripper: bool = False) -> tuple[Path, tuple[Note, ...]]:
            project = Path(scratch) / name
            draft = partial(drafted_robot, urdf, project, flange=flange, mass_kg=mass_kg, xacro=xacro)
            draft = partial(draft, is_decomposed=is_decomposed and not is_gripper)
            draft_gripper = None
            if gripper is not None:
                draft_gripper = partial(
                    gripper_or_hand, gripper, project, urdf, xacro=xacro, is_decomposed=is_decomposed
                )
            return project, _write_files(project, tool_axis, draft, draft_gripper, currency, on_stage=report)

        try:
            project, notes = write("project", is_decomposed=False)
        except UnfitShapesError as error:
            if not error.is_concave:
                raise
            if not can_decompose():
                raise DefinitionError(error.message, hint=f"{error.hint}. Or {INSTALL}") from error
            report("dividing concave collision meshes")
            try:
                project, notes = write("decomposed", is_decomposed=True, is_gripper=error.is_gripper)
            except UnfitShapesError:
                raise error from None
        names = tuple(sorted(path.relative_to(project).as_posix() for path in project.rglob("*") if path.is_file()))
        schemas = {name: text.encode("utf-8") for name, text in schema_texts(kinds).items()}
        write_new_files(folder, {**{name: (project / name).read_bytes() for name in names}, **schemas})
    return RobotProject(files=tuple(sorted({*names, *schemas})), notes=notes)


def _write_files(
    project: Path,
    tool_axis: str | None,
    draft: Callable[..., DraftedRobot],
    draft_gripper: Callable[[DraftedRobot], DraftedGripper] | None,
    currency: str,
    *,
    on_stage: Callable[[str], None],
) -> tuple[Note, ...]:
    drafted = draft(tool_axis=tool_axis or "z")
    id_ = drafted.robot.id
    texts = scaffold_texts()
    (old,) = (PurePosixPath(name).stem for name in texts if re.fullmatch(r"scenes/robots/[^/]+\.yaml", name))
    axes, own = _axes_down(drafted, tool_axis), None
    if draft_gripper is not None:
        axes, own = axes_of_gripper(draft_gripper, axes, project, draft=draft)
    reasons: dict[str, str] = {}
    renamed = partial(_renamed, old=old, id_=id_, name=drafted.arm.name)
    if own is not None:
        texts = with_gripper(texts, own)
    texts = in_currency(texts, currency)
    sizes = tuple(hand_sizes(drafted.robot, () if own is None else own.cups))
    for size, axis in itertools.product(sizes, axes):
        if reasons.get(axis) in {POINTS_INTO_ARM, *UNMENDED}:
            continue
        _write_texts(project, texts, size, renamed=renamed)
        drafted = draft(tool_axis=axis)
        if draft_gripper is not None:
            own = draft_gripper(drafted)
        files = sorted((project / "scenes" / "grippers").glob("*.yaml"))
        geometries = [load_gripper_file(path, project=project).geometry for path in files]
        _write_resolution(project, drafted.robot, geometries, size)
        within = partial(_report, on_stage, f"gripper along {axis}, size {sizes.index(size) + 1} of {len(sizes)}")
        search = CellSearch(project, drafted.robot, drafted.file.name, geometries, size=size, on_stage=within)
        if _is_written(project, drafted, search, on_stage=within):
            return drafted.arm.notes if own is None else (*drafted.arm.notes, *own.notes)
        reasons.setdefault(axis, search.reason)
    found = "; ".join(
        f"with the gripper along {' or '.join(axis for axis in reasons if reasons[axis] == reason)}, {reason}"
        for reason in dict.fromkeys(reasons.values())
    )
    raise UnfitShapesError(
        f"no layout was found in which {id_} grasps a cup on a table with its tool pointing down: {found}",
        hint=_units_hint(drafted) or _layout_hint(set(reasons.values()), drafted.flange),
        is_concave=is_any_mesh_concave(project),
    )


def _units_hint(drafted: DraftedRobot) -> str:
    """Hint for an arm with lengths that no arm has, such as those of a mesh in millimetres; empty without one."""
    found = description_findings(drafted.robot, drafted.file.with_suffix(".urdf"), drafted.file.name)
    wrong = [one for one in found if one.rule == "robot.units"]
    return f"{wrong[0].message} {wrong[0].hint}; rgss robot lists all findings" if wrong else ""


def _layout_hint(reasons: Set[str], flange: str) -> str:
    """Hint for an arm without a layout, by the reasons along the axes that were tried."""
    if reasons == {NOT_VERTICAL}:
        return (
            "if the URDF mounts the arm at a tilt, take the tilt out of its base's joint, and turn the robot in the "
            "scene (robot: roll, pitch). Another arm without a vertical first axis needs a scene and a task of its own"
        )
    if reasons == {DOWN_ELSEWHERE}:
        return (
            "tables are laid out for arms that choose distance and height of the tool; one with too few joints for "
            "that needs a scene and a task of its own"
        )
    return (
        f"is {flange} the link that carries the gripper (--flange), and one of these its axis out of the arm "
        "(--tool-axis)? An arm that cannot turn its tool down needs a scene and a task of its own"
    )


def _is_written(project: Path, drafted: DraftedRobot, search: CellSearch, *, on_stage: Callable[[str], None]) -> bool:
    """Write the first cell in which the task succeeds, else the first without errors; False if there is none.

    The robot file may have narrower ranges, and has another home than the draft, so that other pairs of links may be
    found to touch each other for good: what the search took for valid may be an error in the project.
    """
    first = None
    for cell in itertools.islice(search.cells(), _MOST_CELLS):
        on_stage("trying a cell in a trial")
        _write_cell(project, drafted, cell)
        written = load_project(project)
        if carries_object(written):
            return True
        if first is None and not has_scene_errors(written):
            first = cell
    if first is not None:
        _write_cell(project, drafted, first)
    return first is not None


def _report(on_stage: Callable[[str], None], part: str, stage: str) -> None:
    on_stage(f"{part}: {stage}")


def _write_cell(project: Path, drafted: DraftedRobot, cell: FittedCell) -> None:
    arm, id_ = drafted.arm, drafted.robot.id
    ranges = zip(arm.joints, cell.lower, cell.upper, strict=True)
    narrowed = replace(
        arm,
        joints=tuple(
            replace(joint, lower=low, upper=high, whole=(joint.lower, joint.upper)) for joint, low, high in ranges
        ),
    )
    text = robot_text(narrowed, id_=id_, urdf=f"{id_}.urdf", home=cell.home, held_kg=payload_kg(drafted.robot))
    drafted.file.write_text(text, encoding="utf-8")
    (project / "scenes" / "kitchen.yaml").write_text(scene_text(cell.layout, robot=drafted.file.name), encoding="utf-8")


def _axes_down(drafted: DraftedRobot, tool_axis: str | None) -> tuple[str, ...]:
    """Axes of the flange to try, of those that the arm can turn down, the most likely first."""
    angles = angles_from_vertical_rad(drafted.robot)
    likely = {axis: angles[axis] for axis in drafted.likely_tool_axes}
    if tool_axis is not None:
        likely = {tool_axis: angles["z"]}
    axes = tuple(axis for axis, angle in likely.items() if angle <= _NEAR_DOWN_RAD)
    if not axes:
        nearest = min(likely, key=lambda axis: likely[axis])
        of = "any axis" if tool_axis is None else f"the axis {tool_axis}"
        raise DefinitionError(
            f"{drafted.robot.id} does not turn {of} of {drafted.flange} down: in {SAMPLES} configurations the nearest, "
            f"{nearest}, stays {math.degrees(likely[nearest]):.0f} deg from the vertical on a level base",
            hint="name the link that carries the gripper with --flange, and its axis out of the arm with --tool-axis; "
            "a task in which objects are grasped from above is not for an arm that cannot do so",
        )
    return axes[:_MOST_AXES]


def _write_texts(project: Path, texts: Mapping[str, str], size: HandSize, *, renamed: Callable[[str], str]) -> None:
    """Write the scaffold without its arm and scene, with hands of a size."""
    for name, content in texts.items():
        if name.startswith("scenes/robots/") or name == "scenes/kitchen.yaml":
            continue
        path = project / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(renamed(size.fitted_text(name, content)), encoding="utf-8", newline="\n")


def _write_resolution(project: Path, robot: Robot, geometries: Sequence[GripperGeometry], size: HandSize) -> None:
    """Let paths be verified so finely that the tool moves no more than twice the clearance between two states.

    The tool is then within the clearance of a state that keeps it, everywhere on a planned line.
    """
    longest = max(geometries, key=lambda geometry: geometry.grasp_depth_m)
    finest_rad = 2.0 * size.clearance_m / greatest_travel_m(robot, longest.grasp_centre)
    finest_rad = math.floor(finest_rad / _RESOLUTION_STEP_RAD) * _RESOLUTION_STEP_RAD
    if finest_rad >= _RESOLUTION_RAD:
        return
    line = f"  resolution: {_RESOLUTION_RAD:g} rad\n"
    finest_rad = max(finest_rad, _RESOLUTION_STEP_RAD)
    finer = f"  verification_resolution: {finest_rad:g} rad # from one to the next the tool moves twice the clearance\n"
    study = project / "studies" / "pick_place.yaml"
    study.write_text(study.read_text(encoding="utf-8").replace(line, line + finer), encoding="utf-8")


def _renamed(text: str, *, old: str, id_: str, name: str) -> str:
    """A file of the scaffold with the arm's name in the place of the scaffold's."""
    text = text.replace(f"scenes/robots/{old}.yaml", f"scenes/robots/{id_}.yaml")
    text = re.sub(r"solver_iterations: \d+", _ITERATIONS, text)
    component = rf"id: {re.escape(old)}\n( *)role: manipulator\n *name: .*\n *manufacturer: .*\n"
    return re.sub(component, lambda found: _component(found[1], id_, name), text)


def _component(indent: str, id_: str, name: str) -> str:
    lines = ("role: manipulator", f"name: {name}", "manufacturer: not stated")
    return f"id: {id_}\n" + "".join(f"{indent}{line}\n" for line in lines)
