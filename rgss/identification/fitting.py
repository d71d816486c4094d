"""Fit of a joint's servo to a recording by least squares, with intervals and what the recording cannot tell."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.identification.recording import Control, Recording, Segment
from rgss.identification.servo import JointServo, servo_motion

Array = NDArray[np.float64]

CONFIDENCE = 0.95
WIDEST = 0.25
"""Half-width of an interval over its value from which a parameter counts as not determined."""

MOST_AUTOCORRELATION = 0.3
"""Correlation of neighbouring residuals above which the model misses part of the motion."""

_LONGEST_DELAY_S = 0.5
_MOST_GAIN_HZ = 5.0e3
_SINGULAR = 1.0e-9
_ALIKE = 0.9
_ENDS = {
    "velocity_gain_hz": (0.01, _MOST_GAIN_HZ, 1.0),
    "position_gain_hz2": (0.0, _MOST_GAIN_HZ**2, 10.0),
    "delay_s": (0.0, _LONGEST_DELAY_S, 1.0e-3),
    "viscous_hz": (0.0, _MOST_GAIN_HZ, 0.1),
    "coulomb_rad_s2": (0.0, 1.0e4, 0.1),
}
"""Lower end, upper end and least scale of each parameter."""


class FitStatus(str, Enum):
    """What the recording says of a parameter."""

    DETERMINED = "determined"
    NEAR_ZERO = "not distinguishable from zero"
    UNDETERMINED = "not determined"
    ABSENT = "not in the recording"


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedParameter:
    """A fitted parameter.

    Attributes:
        name: The field of `JointServo`.
        status: What the recording says of it.
        value: The least-squares value; None if the recording does not contain it.
        interval: Ends of its 95 % interval, infinite where the recording does not bound it.
        reason: Why it is not determined; empty if it is.
    """

    name: str
    status: FitStatus
    value: float | None
    interval: tuple[float, float] | None
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoFit:
    """The fit of one joint.

    Attributes:
        joint: The joint.
        servo: The least-squares servo, with parameters that are not determined too.
        parameters: Each parameter with its interval.
        rms_rad_s: Root mean square of the measured minus the fitted speed by pose.
        samples: Number of samples.
        autocorrelation: Correlation of neighbouring residuals; far from 0 the model misses part of the motion, and
            the intervals are widened accordingly.
    """

    joint: str
    servo: JointServo
    parameters: tuple[FittedParameter, ...]
    rms_rad_s: dict[str, float]
    samples: int
    autocorrelation: float

    @property
    def adequate(self) -> bool:
        """The residuals are nearly white, so that the model explains the motion and the intervals hold."""
        return self.autocorrelation <= MOST_AUTOCORRELATION

    def determined(self) -> dict[str, float]:
        """Values of the determined parameters by name."""
        return {
            each.name: each.value
            for each in self.parameters
            if each.status is FitStatus.DETERMINED and each.value is not None
        }


def fit_joint(recording: Recording, joint: str) -> ServoFit:
    """Fit the servo of one joint to all segments in which it is excited.

    Under velocity control measured speeds are compared, under position control positions too, each weighted with
    the deviation of its residuals in a first fit. The intervals are those of the linearised problem, from
    (J^T J)^-1 with Student's t, widened by sqrt((1 + r) / (1 - r)) for neighbouring residuals correlated by r > 0
    (first-order autoregression).

    Args:
        recording: The recording.
        joint: Name of the joint.

    Raises:
        DefinitionError: The joint is never excited.
    """
    segments = recording.of_joint(joint)
    if not any(np.abs(each.excited.commanded_rad_s).max() > 0.0 for each in segments):
        raise DefinitionError(f"the recording has no motion of joint {joint!r}", hint="record steps or sines of it")
    problem = _Problem(segments, recording.control)
    found = problem.solved()
    if recording.control is Control.POSITION:
        problem.weigh(found)
        found = problem.solved(found)
    jacobian, residuals = problem.jacobian(found), problem.residuals(found)
    correlation = problem.autocorrelation(residuals)
    half, alike = _half_widths(jacobian, residuals, correlation, np.array([_ENDS[name][2] for name in problem.names]))
    parameters = [_parameter(problem.names, index, found, half, alike) for index in range(len(problem.names))]
    if recording.control is Control.VELOCITY:
        reason = "under velocity control the position gain has no effect"
        absent = FittedParameter(
            name="position_gain_hz2", status=FitStatus.ABSENT, value=None, interval=None, reason=reason
        )
        parameters.insert(0, absent)
    return ServoFit(
        joint=joint,
        servo=problem.servo(found),
        parameters=tuple(parameters),
        rms_rad_s=problem.rms(found),
        samples=sum(len(each.times_s) for each in segments),
        autocorrelation=correlation,
    )


class _Problem:
    """Residuals of a servo, and their derivatives by central differences."""

    def __init__(self, segments: Sequence[Segment], control: Control) -> None:
        self._segments = [each for each in segments if np.abs(each.excited.commanded_rad_s).max() > 0.0]
        self._positions = control is Control.POSITION
        self.names = tuple(name for name in _PARAMETERS if self._positions or name != "position_gain_hz2")
        self._lower, self._upper, self._least = (
            np.array(values) for values in zip(*(_ENDS[n] for n in self.names), strict=True)
        )
        self._weights = (1.0, 1.0)

    def servo(self, values: Array) -> JointServo:
        """The servo with parameters, each within its ends."""
        return JointServo(**dict(zip(self.names, np.clip(values, self._lower, self._upper).tolist(), strict=True)))

    def residuals(self, values: Array) -> Array:
        """Weighted residuals, shape (residuals,)."""
        (found,) = self._many([values])
        return found

    def jacobian(self, values: Array) -> Array:
        """Derivatives of the residuals, shape (residuals, parameters)."""
        steps = 1.0e-4 * np.maximum(np.abs(values), self._least)
        ahead, behind = (
            [
                np.clip(values + sign * step * unit, self._lower, self._upper)
                for step, unit in zip(steps, np.eye(len(values)), strict=True)
            ]
            for sign in (1.0, -1.0)
        )
        found = self._many([*ahead, *behind])
        spans = [
            float(one.sum() - other.sum())
            for one, other in zip(
                np.array(ahead) * np.eye(len(values)), np.array(behind) * np.eye(len(values)), strict=True
            )
        ]
        columns = [
            (one - other) / span
            for one, other, span in zip(found[: len(values)], found[len(values) :], spans, strict=True)
        ]
        return np.column_stack(columns)

    def solved(self, begin: Array | None = None) -> Array:
        """The best parameters from several starts, or from one that is given."""
        from scipy.optimize import least_squares

        starts = _starts(self.names) if begin is None else [begin]
        costs = [float(np.sum(each**2)) for each in self._many(starts)]
        order = sorted(range(len(starts)), key=lambda index: costs[index])[:2]
        found = [
            least_squares(
                self.residuals,
                np.clip(starts[index], self._lower, self._upper),
                jac=self.jacobian,
                bounds=(self._lower, self._upper),
                x_scale=np.maximum(np.abs(starts[index]), self._least),
                xtol=1e-9,
                ftol=1e-10,
                gtol=1e-10,
                max_nfev=200,
            )
            for index in order
        ]
        best: Array = min(found, key=lambda each: float(each.cost)).x
        return best

    def weigh(self, values: Array) -> None:
        """Weight positions and speeds with the deviations of their residuals at these parameters."""
        speeds, positions = self._unweighted(values)
        least = 1.0e-12
        self._weights = (
            1.0 / max(least, float(np.sqrt(np.mean(speeds**2)))),
            1.0 / max(least, float(np.sqrt(np.mean(positions**2)))),
        )

    def rms(self, values: Array) -> dict[str, float]:
        """Root mean square of the residual speeds by pose, in rad/s."""
        speeds, _ = self._unweighted(values)
        found: dict[str, list[Array]] = {}
        start = 0
        for segment in self._segments:
            found.setdefault(segment.pose, []).append(speeds[start : start + len(segment.times_s)])
            start += len(segment.times_s)
        return {pose: math.sqrt(float(np.mean(np.concatenate(parts) ** 2))) for pose, parts in found.items()}

    def autocorrelation(self, residuals: Array) -> float:
        """Correlation of neighbouring residuals."""
        total = float(np.sum(residuals**2))
        return 0.0 if total == 0.0 else float(np.sum(residuals[1:] * residuals[:-1])) / total

    def _unweighted(self, values: Array) -> tuple[Array, Array]:
        both = self._compared([values])[0]
        return np.concatenate([speeds for speeds, _ in both]), np.concatenate([positions for _, positions in both])

    def _many(self, many: Sequence[Array]) -> list[Array]:
        by_speed, by_position = self._weights
        found = []
        for parts in self._compared(many):
            vectors = [by_speed * speeds for speeds, _ in parts]
            if self._positions:
                vectors += [by_position * positions for _, positions in parts]
            found.append(np.concatenate(vectors))
        return found

    def _compared(self, many: Sequence[Array]) -> list[list[tuple[Array, Array]]]:
        """Fitted minus measured speeds and positions of each segment, for each set of parameters."""
        servos = [self.servo(values) for values in many]
        found: list[list[tuple[Array, Array]]] = [[] for _ in servos]
        for segment in self._segments:
            series = segment.excited
            motion = servo_motion(
                servos,
                segment.times_s,
                series.commanded_rad,
                series.commanded_rad_s,
                start=_start(segment),
            )
            for index, parts in enumerate(found):
                parts.append(
                    (
                        motion.velocities_rad_s[index] - series.measured_rad_s,
                        motion.positions_rad[index] - series.measured_rad,
                    )
                )
        return found


_PARAMETERS = ("position_gain_hz2", "velocity_gain_hz", "delay_s", "viscous_hz", "coulomb_rad_s2")


def _start(segment: Segment) -> tuple[float, float]:
    """Position and speed before the first command: the mean of the samples at rest, else the first sample."""
    series = segment.excited
    moving = np.flatnonzero(np.abs(series.commanded_rad_s) > 0.0)
    rest = max(1, int(moving[0]))
    return float(series.measured_rad[:rest].mean()), 0.0 if rest > 1 else float(series.measured_rad_s[0])


def _starts(names: Sequence[str]) -> list[Array]:
    starts = []
    for gain in (3.0, 10.0, 30.0, 100.0, 300.0):
        for delay_s in (1.0e-3, 1.0e-2, 5.0e-2):
            values = {
                "position_gain_hz2": gain**2 / 4,
                "velocity_gain_hz": gain,
                "delay_s": delay_s,
                "viscous_hz": 0.02 * gain,
                "coulomb_rad_s2": 0.01 * gain,
            }
            starts.append(np.array([values[name] for name in names]))
    return starts


def _half_widths(jacobian: Array, residuals: Array, correlation: float, least: Array) -> tuple[Array, Array]:
    """Half-widths of the intervals, and the correlations of the estimates, shapes (n,) and (n, n)."""
    from scipy.stats import t as student

    rows, columns = jacobian.shape
    freedom = max(1, rows - columns)
    variance = float(np.sum(residuals**2)) / freedom
    lengths = np.linalg.norm(jacobian, axis=0)
    scale = np.where(lengths > 0.0, lengths, 1.0)
    _, values, directions = np.linalg.svd(jacobian / scale, full_matrices=False)
    weak = values <= _SINGULAR * values[0]
    inverse = (directions[~weak].T / values[~weak] ** 2) @ directions[~weak]
    covariance = variance * inverse / np.outer(scale, scale)
    widening = (1 + correlation) / (1 - correlation) if 0.0 < correlation < 1.0 else 1.0
    quantile = float(student.ppf(0.5 + CONFIDENCE / 2, freedom))
    half = quantile * np.sqrt(np.diag(covariance) * widening)
    unbounded = (np.abs(directions[weak]) > 1.0e-3).any(axis=0) | (
        lengths * least <= _SINGULAR * lengths.max() * least.max()
    )
    half[unbounded] = math.inf
    deviations = np.sqrt(np.maximum(np.diag(inverse), 1.0e-300))
    return half, inverse / np.outer(deviations, deviations)


def _parameter(names: Sequence[str], index: int, values: Array, half: Array, alike: Array) -> FittedParameter:
    name, value, width = names[index], float(values[index]), float(half[index])
    lower, upper, _ = _ENDS[name]
    interval = (max(lower, value - width), value + width if value + width < upper else math.inf)
    status, reason = FitStatus.DETERMINED, ""
    at_upper = value >= upper * (1.0 - 1e-6)
    if at_upper or width > WIDEST * abs(value):
        status = FitStatus.UNDETERMINED
        reason = "the interval is wider than a quarter of the value"
        others = [(abs(float(alike[index, other])), other) for other in range(len(names)) if other != index]
        likeness, other = max(others)
        if not math.isfinite(width) or at_upper:
            reason = "the recording does not depend on it"
        elif likeness > _ALIKE:
            reason = f"the recording does not tell it from {names[other]}: correlation {likeness:.2f}"
        elif value - width <= lower and lower == 0.0:
            status, reason = FitStatus.NEAR_ZERO, "its interval contains zero"
    return FittedParameter(name=name, status=status, value=value, interval=interval, reason=reason)
