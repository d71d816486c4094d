"""Replay of one or two trials as a self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from typing import Any

from rgss.reports.page import render_page, template_text

REPLAY_SCRIPTS = ("replay/scene.js", "replay/plots.js", "replay/replay.js")
"""Scripts of a page with replays, in their order."""

REPLAY_STYLE = "replay/replay.css"
"""Style sheet of a page with replays."""

MOST_TRIALS = 2
"""Most trials of one replay."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PackedReplay:
    """Replay as embedded in a page: texts in base64, each compressed by gzip.

    Attributes:
        title: Title of the trial.
        model: The GLB file.
        timeline: JSON of the timeline.
    """

    title: str
    model: str
    timeline: str


def replay_to_html(replays: Sequence[PackedReplay]) -> str:
    """A page that plays one trial, or two as a ghost or side by side.

    Raises:
        DefinitionError: The package ``jinja2`` is not installed.
    """
    if not 1 <= len(replays) <= MOST_TRIALS:
        raise AssertionError(f"checked before: a replay shows 1 to {MOST_TRIALS} trials, not {len(replays)}")
    return render_page(
        "replay/replay.html.j2",
        styles=[template_text(REPLAY_STYLE)],
        scripts=[template_text(script) for script in REPLAY_SCRIPTS],
        held_scripts=[rendering_library()],
        title=f"Replay: {' and '.join(replay.title for replay in replays)}",
        replays=[as_context(replay) for replay in replays],
    )


def as_context(replay: PackedReplay) -> dict[str, Any]:
    """Variables of the template of a replay."""
    return {"title": replay.title, "model": replay.model, "timeline": replay.timeline}


def rendering_library() -> str:
    """The part of three.js that replays use; its licence is beside it in this package."""
    return resources.files("rgss.reports").joinpath("bundles/three/three.min.js").read_text(encoding="utf-8")
