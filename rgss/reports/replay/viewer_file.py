"""Replay of a trial as a file for another viewer, chosen by the suffix."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.evidence import TrialRecord
from rgss.evidence.records import TrialTrace
from rgss.reports.replay.foxglove import replay_to_mcap
from rgss.reports.replay.packing import replay_title
from rgss.reports.replay.timeline import timeline_of
from rgss.scenes import Joint
from rgss.trials.replay import ReplayScene

_WRITERS = {".mcap": replay_to_mcap}


def replay_to_viewer_file(
    suffix: str, record: TrialRecord, trace: TrialTrace, scene: ReplayScene, *, joints: Sequence[Joint]
) -> bytes:
    """Content of the file of a replay.

    Args:
        suffix: Suffix of the file, one of `VIEWER_PACKAGES`, whose package is installed.
        record: The trial.
        trace: Its course.
        scene: The scene of its replay.
        joints: The joints of the arm.
    """
    return _WRITERS[suffix](timeline_of(record, trace, scene, joints=joints, title=replay_title(record)), scene)
