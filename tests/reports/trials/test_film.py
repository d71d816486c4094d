"""Films: every frame, for its time, whole or not at all."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from rgss.reports.trials.film import CaptionedPicture, captioned_image, write_film

SIZE = (90, 64)


def frame(index):
    """A dark square that moves to the right over a light ground."""
    picture = np.full((SIZE[1], SIZE[0], 3), (220, 230, 240), dtype=np.uint8)
    picture[10:20, 3 * index : 3 * index + 10] = (200, 30, 20)
    return CaptionedPicture(picture=picture, caption=f"frame {index}")


def durations(path):
    with Image.open(path) as image:
        found = []
        for index in range(image.n_frames):
            image.seek(index)
            found.append(image.info["duration"])
        return found


def test_every_frame_is_there_in_its_size_for_its_time(tmp_path):
    path = tmp_path / "film.gif"
    told = []
    write_film(path, frame, count=13, rate_hz=12.0, on_frame=lambda: told.append(1))

    with Image.open(path) as image:
        assert (image.format, image.n_frames, image.size, image.info["loop"]) == ("GIF", 13, SIZE, 0)
    assert set(durations(path)[:-1]) == {80, 90}
    assert sum(durations(path)[:-1]) == 1000
    assert durations(path)[-1] == 1500
    assert len(told) == 13


@pytest.mark.parametrize(("rate_hz", "each"), [(50.0, 20), (25.0, 40), (1.0, 1000)])
def test_rates_that_the_format_can_hold_are_kept_exactly(tmp_path, rate_hz, each):
    path = tmp_path / "film.gif"
    write_film(path, frame, count=4, rate_hz=rate_hz)

    assert durations(path) == [each, each, each, 1500]


def test_frames_show_what_they_were_given(tmp_path):
    path = tmp_path / "film.gif"
    write_film(path, frame, count=9, rate_hz=10.0)

    with Image.open(path) as image:
        for index in (0, 4, 8):
            image.seek(index)
            shown = np.asarray(image.convert("RGB")).astype(int)
            assert shown[15, 3 * index + 5] == pytest.approx((200, 30, 20), abs=12)
            assert shown[5, 5] == pytest.approx((220, 230, 240), abs=12)


def test_a_film_of_one_frame(tmp_path):
    write_film(tmp_path / "film.gif", frame, count=1, rate_hz=10.0)

    assert durations(tmp_path / "film.gif") == [1500]


def test_captions_are_written_in_the_lower_left():
    with_caption, without = (
        np.asarray(captioned_image(CaptionedPicture(picture=frame(0).picture, caption=text))).astype(int)
        for text in ("2 grasp", "")
    )
    rows, columns, _ = (with_caption != without).nonzero()

    assert (without == frame(0).picture).all()
    assert rows.min() > SIZE[1] / 2
    assert columns.min() < 10
    assert with_caption.min() < 60


def test_a_film_that_fails_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "film.gif"
    path.write_bytes(b"old")

    def failing(index):
        if index == 3:
            raise RuntimeError("the light went out")
        return frame(index)

    with pytest.raises(RuntimeError, match="the light went out"):
        write_film(path, failing, count=5, rate_hz=10.0)
    assert path.read_bytes() == b"old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["film.gif"]
