"""Text in pictures."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.evidence import PhaseOutcome, TrialRecord

if TYPE_CHECKING:
    from PIL.ImageFont import FreeTypeFont

INK = (33, 37, 43)
FAINT_INK = (107, 114, 124)
PAPER = (255, 255, 255)
OUTCOME_INK = {
    PhaseOutcome.COMPLETED: (28, 122, 62),
    PhaseOutcome.FAILED: (190, 38, 32),
    PhaseOutcome.NOT_RUN: FAINT_INK,
}


@lru_cache(maxsize=8)
def font(size: int, *, bold: bool = False) -> FreeTypeFont:
    """Typeface of all pictures, which Matplotlib contains, so that it is the same on every machine.

    Args:
        size: Height of the letters in pixels.
        bold: True if they are bold.
    """
    from matplotlib import get_data_path
    from PIL import ImageFont

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(str(Path(get_data_path(), "fonts", "ttf", name)), size)


def words(name: str) -> str:
    """Name of an outcome as words: ``move_to_grasp`` as "move to grasp"."""
    return name.replace("_", " ")


def headline(record: TrialRecord) -> str:
    """Outcome of a trial in one line."""
    trial = f"Variant {record.variant}, seed {record.seed}"
    if record.failure is not None and record.failed_phase is not None:
        return f"{trial}: failed at {words(record.failed_phase)}, {words(record.failure.value)}"
    total, motion = record.metrics.get("task_time_s"), record.metrics.get("motion_time_s")
    if isinstance(total, float) and isinstance(motion, float):
        return f"{trial}: done in {total:.1f} s, of which {total - motion:.1f} s are planning"
    return f"{trial}: done"
