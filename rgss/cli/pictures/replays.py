"""Replays of one or two trials, as ``rgss run --replay`` writes them."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.errors import DefinitionError
from rgss.reports.replay import PAGE_SUFFIX

if TYPE_CHECKING:
    from rgss.reports.replay import PackedReplay
    from rgss.studies import Project
    from rgss.trials.pieces import TrialSpec
    from rgss.trials.replay import ReplayedTrial


def add_replay(parser: argparse._ArgumentGroup) -> None:
    """Add the options for a replay."""
    parser.add_argument(
        "--replay",
        type=Path,
        metavar="FILE",
        help="write a replay of the trial in three dimensions: a page (.html), or a file for Foxglove (.mcap)",
    )
    parser.add_argument(
        "--beside", type=int, metavar="ID", help="replay this variant with the same seed too, as a ghost or beside it"
    )


def check_replay(options: argparse.Namespace) -> None:
    """Check that ``--beside`` names another variant and comes with ``--replay`` of a page.

    Raises:
        DefinitionError: It does not.
    """
    if options.beside is None:
        return
    if options.replay is None:
        raise DefinitionError("--beside needs a replay", hint="add --replay FILE.html")
    if options.replay.suffix.lower() != PAGE_SUFFIX:
        raise DefinitionError(
            f"--beside needs a page, got --replay {options.replay}", hint="a .html file shows two trials, others one"
        )
    if options.beside == options.variant:
        raise DefinitionError(f"--beside must be another variant than {options.variant}", hint="give its id")


def other_trial(options: argparse.Namespace, project: Project, *, seed: int) -> TrialSpec | None:
    """The trial that is replayed beside the first; None if there is none.

    Raises:
        DefinitionError: There is no such variant.
    """
    from rgss.studies import trial_specs

    if options.beside is None:
        return None
    (spec,) = trial_specs(project, variants=[project.designs.variant(options.beside)], seeds=[seed])
    return spec


def packed_trial(replayed: ReplayedTrial, spec: TrialSpec) -> PackedReplay | None:
    """Trial as embedded in a page; None if nothing moved."""
    from rgss.reports.replay import packed_replay

    if replayed.trace is None or replayed.scene is None:
        return None
    return packed_replay(replayed.record, replayed.trace, replayed.scene, joints=spec.scene.robot.joints)


def write_replay(path: Path, replayed: ReplayedTrial, spec: TrialSpec, other: TrialSpec | None) -> None:
    """Write the page or the file of another viewer; a second trial in which nothing moved is left out.

    Args:
        path: The file.
        replayed: The trial; something moved in it.
        spec: Its inputs.
        other: The inputs of the second trial, which is run for it; None without one.

    Raises:
        OSError: The file cannot be written.
        SimulationError: The physics engine cannot build the world of the second trial.
    """
    from rgss.documents import replaced_file
    from rgss.reports.replay import replay_to_html, replay_to_viewer_file
    from rgss.sweep import compute
    from rgss.trials.replay import run_replayed_trial

    suffix = path.suffix.lower()
    if suffix != PAGE_SUFFIX and replayed.trace is not None and replayed.scene is not None:
        joints = spec.scene.robot.joints
        content = replay_to_viewer_file(suffix, replayed.record, replayed.trace, replayed.scene, joints=joints)
        with replaced_file(path) as part:
            part.write_bytes(content)
        return
    packed = [packed_trial(replayed, spec)]
    if other is not None:
        packed.append(packed_trial(compute(run_replayed_trial, other), other))
    with replaced_file(path) as part:
        part.write_text(replay_to_html([one for one in packed if one is not None]), encoding="utf-8")
