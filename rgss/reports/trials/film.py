"""A film of a trial as a GIF file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rgss.documents import replaced_file
from rgss.reports.trials.lettering import INK, PAPER, font

if TYPE_CHECKING:
    from PIL.Image import Image

HIGHEST_RATE_HZ = 50.0
"""Highest frame rate that viewers show; the format counts in hundredths of a second."""

_LAST_FRAME_MS = 1500
_COLOURS = 255
_PALETTE_FRAMES = 8


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CaptionedPicture:
    """A frame of a film.

    Attributes:
        picture: Its colours, shape (height, width, 3).
        caption: The text in its lower left corner.
    """

    picture: NDArray[np.uint8]
    caption: str


def write_film(
    path: Path,
    frame_at: Callable[[int], CaptionedPicture],
    *,
    count: int,
    rate_hz: float,
    on_frame: Callable[[], None] = lambda: None,
) -> None:
    """Write an animated GIF that loops, with a pause on its last frame.

    Args:
        path: The file.
        frame_at: Function from an index to its frame; a few frames are requested twice.
        count: Number of frames.
        rate_hz: Frames a second, at most 50.
        on_frame: Called after each frame.

    Raises:
        OSError: The file cannot be written.
    """
    from PIL import Image

    # One palette for all, so that static parts do not change from frame to frame.
    every = max(1, count // _PALETTE_FRAMES)
    palette = _palette([captioned_image(frame_at(index)) for index in range(0, count, every)])

    def reduced(index: int) -> Image.Image:
        image = captioned_image(frame_at(index)).quantize(palette=palette, dither=Image.Dither.NONE)
        on_frame()
        return image

    # Each frame begins at the hundredth of a second nearest to its time, so that roundings do not add up.
    starts_ms = [10 * round(100 * index / rate_hz) for index in range(count)]
    durations_ms = [after - before for before, after in pairwise(starts_ms)]
    with replaced_file(path) as part:
        reduced(0).save(
            part,
            format="GIF",
            save_all=True,
            append_images=(reduced(index) for index in range(1, count)),
            duration=[*durations_ms, _LAST_FRAME_MS],
            loop=0,
            optimize=True,
        )


def captioned_image(frame: CaptionedPicture) -> Image:
    """A frame with its caption, which has a light outline to be legible on any background."""
    from PIL import Image, ImageDraw

    image = Image.fromarray(frame.picture)
    size = max(9, round(image.height / 30))
    pen = ImageDraw.Draw(image)
    place = (size // 2, image.height - size)
    pen.text(place, frame.caption, font=font(size), fill=INK, anchor="lm", stroke_width=2, stroke_fill=PAPER)
    return image


def _palette(images: list[Image]) -> Image:
    from PIL import Image

    width, height = images[0].size
    sheet = Image.new("RGB", (width, height * len(images)))
    for row, image in enumerate(images):
        sheet.paste(image, (0, row * height))
    return sheet.quantize(_COLOURS, method=Image.Quantize.MEDIANCUT)
