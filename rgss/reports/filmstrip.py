"""The eight states of a trial side by side in one picture."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import Phase, PhaseRecord, TrialRecord
from rgss.reports.lettering import FAINT_INK, INK, OUTCOME_INK, PAPER, font, headline, words
from rgss.reports.picture_files import replaced_file

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

_COLUMNS = 4
_EMPTY = (236, 238, 241)


def write_filmstrip(path: Path, record: TrialRecord, pictures: Mapping[Phase, NDArray[np.uint8]]) -> None:
    """Write the filmstrip of a trial as a PNG.

    Args:
        path: The file.
        record: The trial.
        pictures: What each phase that ran looked like at its end, all of one size.

    Raises:
        OSError: The file cannot be written.
    """
    image = filmstrip(record, pictures)
    with replaced_file(path) as part:
        # A palette of the picture's own halves the file.
        image.quantize(256).save(part, format="PNG", optimize=True)


def filmstrip(record: TrialRecord, pictures: Mapping[Phase, NDArray[np.uint8]]) -> Image:
    """Two rows of four panels: title, outcome, time and picture of each state.

    Args:
        record: The trial.
        pictures: What each phase that ran looked like at its end, all of one size; at least one.
    """
    from PIL import Image, ImageDraw

    height, width, _ = next(iter(pictures.values())).shape
    size = max(8, round(width / 26))
    gap, label, title = size, 4 * size, 3 * size
    rows = -(-len(record.phases) // _COLUMNS)
    sheet = Image.new("RGB", (_COLUMNS * (width + gap) + gap, title + rows * (label + height + gap)), PAPER)
    pen = ImageDraw.Draw(sheet)
    pen.text(
        (gap, title // 2 + size // 4), headline(record), font=font(round(1.2 * size), bold=True), fill=INK, anchor="lm"
    )
    for number, phase in enumerate(record.phases):
        row, column = divmod(number, _COLUMNS)
        left, top = gap + column * (width + gap), title + row * (label + height + gap)
        _label(pen, (left, top + size // 2), number + 1, phase, size)
        box = (left, top + label)
        picture = pictures.get(phase.phase)
        if picture is None:
            pen.rectangle((*box, left + width - 1, top + label + height - 1), fill=_EMPTY)
            pen.text(
                (left + width // 2, top + label + height // 2),
                "no motion",
                font=font(size),
                fill=FAINT_INK,
                anchor="mm",
            )
        else:
            sheet.paste(Image.fromarray(picture), box)
    return sheet


def _label(pen: ImageDraw, place: tuple[int, int], number: int, phase: PhaseRecord, size: int) -> None:
    x, y = place
    first, second = y + size, y + round(2.7 * size)  # baselines
    title = f"{number}  {words(phase.phase.value)}"
    pen.text((x, first), title, font=font(size, bold=True), fill=INK, anchor="ls")
    outcome = words(phase.outcome.value)
    pen.text((x, second), outcome, font=font(size), fill=OUTCOME_INK[phase.outcome], anchor="ls")
    if phase.duration_s is not None:
        start = x + round(pen.textlength(f"{outcome} ", font=font(size)))
        pen.text((start, second), f"in {phase.duration_s:.2f} s", font=font(size), fill=FAINT_INK, anchor="ls")
