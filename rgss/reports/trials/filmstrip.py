"""The states of a trial side by side in one picture."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rgss.documents import replaced_file
from rgss.evidence import PhaseOutcome, PhaseRecord, TrialRecord
from rgss.reports.trials.lettering import FAINT_INK, INK, OUTCOME_INK, PAPER, font, headline, words

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

_COLUMNS = 4
_LEAST_COLUMNS = 3
"""Least number of columns, whose width the headline needs."""
_EMPTY = (236, 238, 241)


def write_filmstrip(path: Path, record: TrialRecord, pictures: Mapping[str, NDArray[np.uint8]]) -> None:
    """Write the filmstrip of a trial as a PNG.

    Args:
        path: The file.
        record: The trial.
        pictures: Picture of the end of each phase that ran, all of one size.

    Raises:
        OSError: The file cannot be written.
    """
    image = filmstrip(record, pictures)
    with replaced_file(path) as part:
        # An adaptive palette halves the file.
        image.quantize(256).save(part, format="PNG", optimize=True)


def still_png(picture: NDArray[np.uint8]) -> bytes:
    """A picture as the bytes of a PNG.

    Args:
        picture: Rows of pixels, of red, green and blue.
    """
    from io import BytesIO

    from PIL import Image

    written = BytesIO()
    Image.fromarray(picture).quantize(256).save(written, format="PNG", optimize=True)
    return written.getvalue()


def filmstrip(record: TrialRecord, pictures: Mapping[str, NDArray[np.uint8]]) -> Image:
    """Rows of up to four panels: title, outcome, time and picture of each state that was entered.

    The panel of the failed state has a red frame; the states that the trial did not reach are
    named in a line below.

    Args:
        record: The trial.
        pictures: Picture of the end of each phase that ran, all of one size; at least one.
    """
    from PIL import Image, ImageDraw

    height, width, _ = next(iter(pictures.values())).shape
    size = max(8, round(width / 26))
    gap, label, title = size, 4 * size, 3 * size
    entered = [phase for phase in record.phases if phase.outcome is not PhaseOutcome.NOT_RUN]
    columns = min(_COLUMNS, max(_LEAST_COLUMNS, len(entered)))
    rows = -(-len(entered) // columns)
    full_width = columns * (width + gap) + gap
    below = _not_run(record, full_width - 2 * gap, size)
    line = round(1.6 * size)
    sheet = Image.new(
        "RGB",
        (full_width, title + rows * (label + height + gap) + (line * len(below) + gap if below else 0)),
        PAPER,
    )
    pen = ImageDraw.Draw(sheet)
    text = headline(record)
    letters = round(1.2 * size)
    while letters > size and font(letters, bold=True).getlength(text) > full_width - 2 * gap:
        letters -= 1
    pen.text((gap, title // 2 + size // 4), text, font=font(letters, bold=True), fill=INK, anchor="lm")
    for place, phase in enumerate(entered):
        row, column = divmod(place, columns)
        left, top = gap + column * (width + gap), title + row * (label + height + gap)
        _label(pen, (left, top + size // 2), record.phases.index(phase) + 1, phase, size)
        box = (left, top + label, left + width - 1, top + label + height - 1)
        picture = pictures.get(phase.phase)
        if picture is None:
            pen.rectangle(box, fill=_EMPTY)
            middle = (left + width // 2, top + label + height // 2)
            pen.text(middle, "no motion", font=font(size), fill=FAINT_INK, anchor="mm")
        else:
            sheet.paste(Image.fromarray(picture), box[:2])
        if phase.outcome is PhaseOutcome.FAILED:
            pen.rectangle(box, outline=OUTCOME_INK[phase.outcome], width=max(2, size // 4))
    for number, text in enumerate(below):
        top = title + rows * (label + height + gap) + number * line
        pen.text((gap, top), text, font=font(size), fill=FAINT_INK, anchor="la")
    return sheet


def _not_run(record: TrialRecord, width: int, size: int) -> list[str]:
    """Lines that name the states that the trial did not reach; none if it reached all."""
    missing = [
        f"{number} {words(phase.phase)}"
        for number, phase in enumerate(record.phases, start=1)
        if phase.outcome is PhaseOutcome.NOT_RUN
    ]
    lines: list[str] = []
    for number, text in enumerate(missing):
        part = text + ("," if number + 1 < len(missing) else "")
        longer = f"{lines[-1]} {part}" if lines else f"Not run: {part}"
        if lines and font(size).getlength(longer) > width:
            lines.append(part)
        else:
            lines[-1:] = [longer]
    return lines


def _label(pen: ImageDraw, place: tuple[int, int], number: int, phase: PhaseRecord, size: int) -> None:
    x, y = place
    first, second = y + size, y + round(2.7 * size)  # baselines
    title = f"{number}  {words(phase.phase)}"
    pen.text((x, first), title, font=font(size, bold=True), fill=INK, anchor="ls")
    outcome = words(phase.outcome.value)
    pen.text((x, second), outcome, font=font(size), fill=OUTCOME_INK[phase.outcome], anchor="ls")
    if phase.duration_s is not None:
        start = x + round(pen.textlength(f"{outcome} ", font=font(size)))
        pen.text((start, second), f"in {phase.duration_s:.2f} s", font=font(size), fill=FAINT_INK, anchor="ls")
