"""Measures of a joint's response to a commanded speed: rise time, overshoot, steady state, lag, tracking error."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.identification.recording import Recording, Segment

Array = NDArray[np.float64]

_STEADY_SHARE = 0.25
_MOST_DRIFT = 0.02
"""Greatest change of the speed between the halves of that share, over its mean, if it has settled."""

_DEVIATIONS = 3.0
"""So many standard errors of the noise are no change."""

_LEVEL = 1.0e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class Response:
    """Response of the excited joint in one segment; None where the signal does not define a measure.

    A speed that has not settled in the last quarter of the first step has no steady value, and so neither rise time nor
    overshoot nor steady error.

    Attributes:
        pose: Name of the pose.
        joint: The excited joint.
        signal: Name of the signal.
        rise_s: Time from 10 % to 90 % of the steady speed after the first step; of steps alone, and None if it passes
            between two samples.
        overshoot: Greatest speed after the first step over the steady speed, minus one; of steps alone. Noise of the
            measured speed adds to it.
        steady_error_rad_s: Commanded minus measured speed, mean over the last quarter of the first step.
        lag_s: Delay of the measured speed at which it correlates best with the commanded speed.
        rms_rad_s: Root mean square of commanded minus measured speed.
    """

    pose: str
    joint: str
    signal: str
    rise_s: float | None
    overshoot: float | None
    steady_error_rad_s: float | None
    lag_s: float
    rms_rad_s: float


def responses(recording: Recording) -> tuple[Response, ...]:
    """The response of each segment."""
    return tuple(_response(segment) for segment in recording.segments)


def _response(segment: Segment) -> Response:
    times_s, series = segment.times_s, segment.excited
    wanted, got = series.commanded_rad_s, series.measured_rad_s
    rise_s = overshoot = steady_error = None
    step = _first_step(wanted)
    if step is not None:
        first, last = step
        level = float(wanted[first])
        tail = got[last - max(1, int(_STEADY_SHARE * (last - first))) : last]
        steady = float(tail.mean())
        if _is_settled(tail):
            steady_error = level - steady
        if steady_error is not None and steady * level > 0.0:
            # The response to the sample that begins the step is measured from the next one on.
            course = got[first : last + 1] / steady
            rise_s = _crossing(times_s[first : last + 1], course, 0.9, 0.1)
            overshoot = max(0.0, float(course.max()) - 1.0)
    return Response(
        pose=segment.pose,
        joint=segment.joint,
        signal=segment.signal,
        rise_s=rise_s,
        overshoot=overshoot,
        steady_error_rad_s=steady_error,
        lag_s=lag_s(times_s, wanted, got),
        rms_rad_s=math.sqrt(float(np.mean((wanted - got) ** 2))),
    )


def lag_s(times_s: Array, wanted: Array, got: Array) -> float:
    """Lag of a signal by cross-correlation, with a parabola through the greatest value and its neighbours.

    Args:
        times_s: Times, shape (times,).
        wanted: The leading signal, shape (times,).
        got: The signal that follows, shape (times,).

    Returns:
        The lag, at least 0 and at most half of the segment.
    """
    count = len(times_s)
    step_s = float(times_s[-1] - times_s[0]) / (count - 1)
    one, other = wanted - wanted.mean(), got - got.mean()
    size = 1 << (2 * count).bit_length()
    products = np.fft.irfft(np.fft.rfft(other, size) * np.conj(np.fft.rfft(one, size)), size)[: count // 2]
    best = int(np.argmax(products))
    if not 0 < best < len(products) - 1:
        return best * step_s
    before, at, after = products[best - 1 : best + 2].tolist()
    bend = before - 2 * at + after
    return step_s * (best + (0.0 if bend == 0.0 else 0.5 * (before - after) / bend))


def _first_step(wanted: Array) -> tuple[int, int] | None:
    """First sample of the first constant speed that is not zero, and the sample behind its last; None for a sine."""
    moving = np.flatnonzero(np.abs(wanted) > _LEVEL)
    if not len(moving):
        return None
    first = int(moving[0])
    other = np.flatnonzero(np.abs(wanted[first:] - wanted[first]) > _LEVEL)
    last = first + int(other[0]) if len(other) else len(wanted) - 1
    return (first, last) if last - first >= 4 else None


def _is_settled(tail: Array) -> bool:
    """True if the speed changes no more between the halves of the end of a step than its noise does."""
    half = len(tail) // 2
    if not half:
        return True
    noise = float(np.sqrt(np.mean(np.diff(tail) ** 2) / 2))
    change = abs(float(tail[half:].mean() - tail[:half].mean()))
    return change <= _MOST_DRIFT * abs(float(tail.mean())) + _DEVIATIONS * noise * math.sqrt(2.0 / half)


def _crossing(times_s: Array, course: Array, high: float, low: float) -> float | None:
    """Time between the first crossings of two levels, each interpolated.

    None if one is not crossed, or if both are between the same samples, which do not resolve it.
    """
    found, places = [], []
    for level in (low, high):
        above = np.flatnonzero(course >= level)
        if not len(above) or above[0] == 0:
            return None
        index = int(above[0])
        places.append(index)
        share = (level - course[index - 1]) / (course[index] - course[index - 1])
        found.append(float(times_s[index - 1] + share * (times_s[index] - times_s[index - 1])))
    return found[1] - found[0] if places[0] < places[1] else None
