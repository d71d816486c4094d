"""Packing of a replayed trial for a page."""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Sequence

from rgss.evidence import TrialRecord
from rgss.evidence.records import TrialTrace
from rgss.reports.replay.gltf_scene import replay_to_glb
from rgss.reports.replay.replay_page import PackedReplay
from rgss.reports.replay.timeline import timeline_of
from rgss.reports.replay.timeline_json import timeline_to_json
from rgss.scenes import Joint
from rgss.trials.replay import ReplayScene


def replay_title(record: TrialRecord) -> str:
    """Title of a trial's replay: its variant and its seed."""
    return f"Variant {record.variant}, seed {record.seed}"


def packed_replay(
    record: TrialRecord, trace: TrialTrace, scene: ReplayScene, *, joints: Sequence[Joint]
) -> PackedReplay:
    """Pack a replay for a page; the same trial gives the same bytes.

    Args:
        record: The trial.
        trace: Its course.
        scene: The scene of its replay.
        joints: The joints of the arm.
    """
    title = replay_title(record)
    timeline = timeline_to_json(timeline_of(record, trace, scene, joints=joints, title=title), scene)
    return PackedReplay(
        title=title,
        model=_packed(replay_to_glb(scene, title=title)),
        timeline=_packed(json.dumps(timeline, allow_nan=False, separators=(",", ":")).encode("utf-8")),
    )


def _packed(content: bytes) -> str:
    return base64.b64encode(gzip.compress(content, compresslevel=9, mtime=0)).decode("ascii")
