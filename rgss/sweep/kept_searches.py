"""Searches of compared planners, kept beside the evidence so that a report searches again only for what changed.

They are no evidence: what is missing, damaged or cannot be written is searched again.
"""

from __future__ import annotations

import contextlib
import json
from dataclasses import dataclass
from pathlib import Path

from rgss.documents import canonical_json, digest, replaced_file
from rgss.errors import EvidenceError, RgssError
from rgss.motion import ClockKind
from rgss.sweep.engine_process import compute
from rgss.trials import TaskPlan, TrialSpec, searches_of
from rgss.trials.code import versions
from rgss.trials.pieces import digests_of, plan_from_json, plan_to_json

MOST_KEPT = 1_000
"""Most files in the folder; the oldest are removed."""

_KIND = "searches for every move"


@dataclass(frozen=True, slots=True)
class KeptSearches:
    """Searches in a folder, one file for each task, planner, gripper shape and seed.

    Attributes:
        folder: The folder; None to keep nothing.
    """

    folder: Path | None

    @staticmethod
    def beside(evidence: Path) -> KeptSearches:
        """The searches beside an evidence store.

        Args:
            evidence: The store's file.
        """
        return KeptSearches(evidence.with_suffix(".searches"))

    def plan(self, spec: TrialSpec) -> TaskPlan:
        """Searches for every planned move of a trial's task.

        Raises:
            MotionError: The planner is not available.
        """
        # Times of a wall clock are not a function of the inputs.
        if self.folder is None or spec.settings.planning.clock.kind is not ClockKind.COUNTED:
            return compute(searches_of, spec)
        key = digest([_KIND, digests_of(spec, versions()).plan])
        path = self.folder / f"{key}.json"
        found = _read(path)
        if found is None:
            found = compute(searches_of, spec)
            _write(path, plan_to_json(found))
        return found


def _read(path: Path) -> TaskPlan | None:
    """The plan of a file; None if there is none or it is damaged."""
    try:
        kept = json.loads(path.read_bytes())
        text = kept["plan"]
        return plan_from_json(text) if kept["sha256"] == digest(text) else None
    except (OSError, ValueError, TypeError, KeyError, EvidenceError):
        return None


def _write(path: Path, text: str) -> None:
    # A disk that is full or read-only costs the searches of the next report, and nothing of this one.
    with contextlib.suppress(OSError, RgssError):
        path.parent.mkdir(exist_ok=True)
        with replaced_file(path) as part:
            part.write_text(canonical_json({"plan": text, "sha256": digest(text)}), encoding="utf-8")
        by_age = sorted(path.parent.glob("*.json"), key=lambda one: (one.stat().st_mtime_ns, one.name))
        for old in by_age[:-MOST_KEPT]:
            old.unlink(missing_ok=True)
