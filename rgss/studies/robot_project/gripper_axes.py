"""Axes of the flange along which a gripper can close on an object."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from rgss.errors import DefinitionError
from rgss.scenes import MechanismError
from rgss.studies.robot_project.draft import DraftedRobot
from rgss.studies.robot_project.drafted_gripper import DraftedGripper, drafted_gripper, drafted_hand
from rgss.studies.robot_project.unfit_shapes import UnfitShapesError, is_any_mesh_concave


def axes_of_gripper(
    draft_gripper: Callable[[DraftedRobot], DraftedGripper],
    axes: Sequence[str],
    project: Path,
    *,
    draft: Callable[..., DraftedRobot],
) -> tuple[tuple[str, ...], DraftedGripper]:
    """Axes of the flange along which a gripper can close on an object, and the gripper along the first of them.

    Args:
        draft_gripper: Drafts the gripper for a drafted arm.
        axes: The axes to try.
        project: The project that is being written.
        draft: Drafts the arm with its tool along an axis.

    Raises:
        MechanismError: It is no mechanism with one driven joint.
        UnfitShapesError: There is none; the reason along the most likely one.
    """
    tried = [(axis, _tried(draft_gripper, draft(tool_axis=axis))) for axis in axes]
    found = [(axis, own) for axis, own in tried if isinstance(own, DraftedGripper)]
    if not found:
        problem = next(problem for _, problem in tried if isinstance(problem, DefinitionError))
        is_concave = is_any_mesh_concave(project)
        raise UnfitShapesError(problem.message, hint=problem.hint, is_concave=is_concave, is_gripper=True)
    return tuple(axis for axis, _ in found), found[0][1]


def _tried(
    draft_gripper: Callable[[DraftedRobot], DraftedGripper], drafted: DraftedRobot
) -> DraftedGripper | DefinitionError:
    try:
        return draft_gripper(drafted)
    except MechanismError:
        # Neither another axis nor other shapes would resolve it.
        raise
    except DefinitionError as error:
        return error


def gripper_or_hand(
    gripper: Path, project: Path, urdf: Path, drafted: DraftedRobot, *, xacro: Mapping[str, str], is_decomposed: bool
) -> DraftedGripper:
    """The gripper of a URDF; a hand for the URDF of the arm itself.

    Args:
        gripper: The URDF of the gripper.
        project: The project that is being written.
        urdf: The URDF of the arm.
        drafted: The arm.
        xacro: Arguments, if the URDF is a xacro.
        is_decomposed: True to divide concave collision meshes into convex parts.
    """
    if gripper.is_file() and urdf.is_file() and gripper.samefile(urdf):
        return drafted_hand(urdf, project, drafted, is_decomposed=is_decomposed)
    return drafted_gripper(gripper, project, xacro, is_decomposed=is_decomposed)
