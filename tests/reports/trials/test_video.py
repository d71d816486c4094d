"""Videos: every frame at its time, the same bytes each time, whole or not at all."""

from __future__ import annotations

import hashlib
from fractions import Fraction

import av
import numpy as np
import pytest
from av.video.reformatter import ColorRange, Colorspace

from rgss.reports.trials.film import CaptionedPicture
from rgss.reports.trials.video import write_video

SIZE = (128, 96)
SUFFIXES = (".webm", ".mp4")


def frame(index, size=SIZE):
    """A dark square that moves to the right over a light ground."""
    picture = np.full((size[1], size[0], 3), (220, 230, 240), dtype=np.uint8)
    picture[10:26, 3 * index : 3 * index + 16] = (200, 30, 20)
    return CaptionedPicture(picture=picture, caption="")


def decoded(path):
    """Codec, and time and colours of each frame, by the decoder."""
    with av.open(str(path)) as file:
        (stream,) = file.streams
        return stream.codec_context.name, [
            (one.pts * one.time_base, one.to_ndarray(format="rgb24").astype(int)) for one in file.decode(video=0)
        ]


@pytest.fixture(params=SUFFIXES)
def path(request, tmp_path):
    return tmp_path / f"film{request.param}"


def test_the_suffix_sets_the_codec(tmp_path):
    found = {}
    for suffix in SUFFIXES:
        write_video(tmp_path / f"film{suffix}", frame, count=2, rate_hz=10.0)
        found[suffix] = decoded(tmp_path / f"film{suffix}")[0]

    assert found == {".webm": "vp9", ".mp4": "h264"}


@pytest.mark.parametrize("rate_hz", [1.0, 8.0, 12.5, 50.0])
def test_every_frame_is_shown_once_at_its_time(path, rate_hz):
    advanced = []
    write_video(path, frame, count=13, rate_hz=rate_hz, on_frame=lambda: advanced.append(1))
    _, frames = decoded(path)

    assert len(frames) == len(advanced) == 13
    for index, (time_s, colours) in enumerate(frames):
        # WebM counts in milliseconds.
        assert abs(time_s - index / Fraction(rate_hz)) <= Fraction(1, 1000)
        assert colours.shape == (SIZE[1], SIZE[0], 3)
        assert colours[18, 3 * index + 8] == pytest.approx((200, 30, 20), abs=25)
        assert colours[60, 60] == pytest.approx((220, 230, 240), abs=12)


def test_a_key_frame_each_second(path):
    write_video(path, frame, count=33, rate_hz=8.0)
    with av.open(str(path)) as file:
        keys = sorted(round(float(one.pts * one.time_base), 2) for one in file.demux(video=0) if one.is_keyframe)

    assert set(keys) >= {0.0, 1.0, 2.0, 3.0, 4.0}


def test_the_same_frames_give_the_same_bytes(path):
    digests = set()
    for _ in range(3):
        write_video(path, frame, count=20, rate_hz=10.0)
        digests.add(hashlib.sha256(path.read_bytes()).hexdigest())
    write_video(path, lambda index: frame(index + 1), count=20, rate_hz=10.0)

    assert len(digests) == 1
    assert hashlib.sha256(path.read_bytes()).hexdigest() not in digests


def test_the_matrix_of_the_colours_is_in_the_file(path):
    write_video(path, frame, count=2, rate_hz=10.0)
    with av.open(str(path)) as file:
        shown = next(file.decode(video=0))

    assert (shown.colorspace, shown.color_range) == (Colorspace.SMPTE170M, ColorRange.MPEG)


def test_an_odd_size_is_filled_up_with_its_edge(path):
    write_video(path, lambda index: frame(index, (129, 97)), count=3, rate_hz=10.0)
    _, frames = decoded(path)

    for _, colours in frames:
        assert colours.shape == (98, 130, 3)
        assert colours[-1, -1] == pytest.approx(colours[-2, -2], abs=3)


def test_a_film_of_one_frame(path):
    write_video(path, frame, count=1, rate_hz=10.0)

    assert [time_s for time_s, _ in decoded(path)[1]] == [0]


def test_a_film_that_fails_leaves_the_old_file_and_nothing_else(path):
    path.write_bytes(b"old")

    def failing(index):
        if index == 3:
            raise RuntimeError("the light went out")
        return frame(index)

    with pytest.raises(RuntimeError, match="the light went out"):
        write_video(path, failing, count=5, rate_hz=10.0)
    assert path.read_bytes() == b"old"
    assert list(path.parent.iterdir()) == [path]


def test_another_suffix_writes_nothing(tmp_path):
    with pytest.raises(KeyError):
        write_video(tmp_path / "film.avi", frame, count=1, rate_hz=10.0)
    assert list(tmp_path.iterdir()) == []
