"""Film of a trial as a WebM or MP4 file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from rgss.documents import replaced_file
from rgss.reports.trials.film import CaptionedPicture, captioned_image

if TYPE_CHECKING:
    from av.video.frame import VideoFrame

_BLOCK = 2
_KEY_FRAME_S = 1.0
_RATE_DENOMINATOR = 1000


@dataclass(frozen=True, slots=True, kw_only=True)
class _Encoding:
    """Container, codec and settings of a suffix."""

    container: str
    codec: str
    options: Mapping[str, str]
    container_options: Mapping[str, str]


# Omits the release that wrote the file, and the random identifier of a WebM segment.
_REPEATABLE: Mapping[str, str] = MappingProxyType({"fflags": "+bitexact"})

# Constant quality; one thread, since the bytes of some encoders depend on the number of threads.
_ENCODINGS: Mapping[str, _Encoding] = MappingProxyType(
    {
        ".webm": _Encoding(
            container="webm",
            codec="libvpx-vp9",
            options=MappingProxyType(
                {"crf": "30", "b": "0", "deadline": "good", "cpu-used": "4", "row-mt": "0", "threads": "1"}
            ),
            container_options=_REPEATABLE,
        ),
        ".mp4": _Encoding(
            container="mp4",
            codec="libx264",
            options=MappingProxyType({"crf": "21", "preset": "medium", "threads": "1"}),
            # The index comes first, so that playback can start before the whole file is loaded.
            container_options=MappingProxyType({**_REPEATABLE, "movflags": "+faststart"}),
        ),
    }
)


def write_video(
    path: Path,
    frame_at: Callable[[int], CaptionedPicture],
    *,
    count: int,
    rate_hz: float,
    on_frame: Callable[[], None] = lambda: None,
) -> None:
    """Write a seekable video, VP9 in WebM or H.264 in MP4 by the suffix of the file.

    The same frames give the same bytes with the same release of PyAV on processors of the same kind: one thread
    encodes, and the file holds neither a date nor a random identifier. Frames of odd width or height get one more
    column or row, a copy of the last, because both codecs store colour for blocks of two by two pixels.

    Args:
        path: The file, which ends in ``.webm`` or ``.mp4``.
        frame_at: Function from an index to its frame; called once for each, in order.
        count: Number of frames.
        rate_hz: Frames a second.
        on_frame: Called after each frame.

    Raises:
        OSError: The file cannot be written.
        KeyError: The file has another suffix.
    """
    import av

    encoding = _ENCODINGS[path.suffix.lower()]
    rate = Fraction(rate_hz).limit_denominator(_RATE_DENOMINATOR)
    first = _encodable(frame_at(0))
    with (
        replaced_file(path) as part,
        av.open(str(part), mode="w", format=encoding.container, options=dict(encoding.container_options)) as file,
    ):
        stream = file.add_stream(encoding.codec, rate=rate, options=dict(encoding.options))
        stream.width, stream.height = first.width, first.height
        stream.pix_fmt = "yuv420p"
        stream.time_base = 1 / rate
        # The colour matrix of the conversion; without it some players assume another one from 720 rows on.
        stream.codec_context.colorspace = av.video.reformatter.Colorspace.SMPTE170M
        stream.codec_context.color_range = av.video.reformatter.ColorRange.MPEG
        stream.codec_context.thread_count = 1
        # A player seeks to the preceding key frame; one each second makes seeking fast.
        stream.codec_context.gop_size = max(1, round(rate_hz * _KEY_FRAME_S))
        stream.codec_context.flags |= av.codec.context.Flags.bitexact
        for index in range(count):
            frame = first if index == 0 else _encodable(frame_at(index))
            frame.pts, frame.time_base = index, 1 / rate
            file.mux(stream.encode(frame))
            on_frame()
        file.mux(stream.encode(None))


def _encodable(frame: CaptionedPicture) -> VideoFrame:
    import av

    colours = np.asarray(captioned_image(frame))
    height, width = colours.shape[:2]
    padded = np.pad(colours, ((0, height % _BLOCK), (0, width % _BLOCK), (0, 0)), mode="edge")
    encodable: VideoFrame = av.VideoFrame.from_ndarray(np.ascontiguousarray(padded), format="rgb24")
    return encodable
