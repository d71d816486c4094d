"""Least-squares fit of a joint's servo to a recording, with confidence intervals and identifiability."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.identification.recording import Recording
from rgss.identification.servo_parameters import parameter_key
from rgss.identification.servo_problem import PARAMETER_ENDS, ServoProblem
from rgss.scenes import JointServo, ServoControl

Array = NDArray[np.float64]

CONFIDENCE = 0.95
WIDEST = 0.25
"""Half-width of an interval over its value from which a parameter counts as not determined."""

MOST_AUTOCORRELATION = 0.3
"""Correlation of neighbouring residuals above which the model misses part of the motion."""

MOST_PORTMANTEAU = 60.0
"""White residuals exceed it with a probability of 7 in a million: chi-squared with 20 degrees of freedom."""

_SINGULAR = 1.0e-9
_ALIKE = 0.9


class FitStatus(str, Enum):
    """Identifiability of a parameter from the recording."""

    DETERMINED = "determined"
    NEAR_ZERO = "not distinguishable from zero"
    UNDETERMINED = "not determined"
    ABSENT = "not in the recording"


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedParameter:
    """A fitted parameter.

    Attributes:
        name: The field of `JointServo`.
        status: Its identifiability.
        value: The least-squares value; None if not identifiable.
        interval: Ends of its 95 % interval, infinite if the recording does not bound it.
        reason: Reason why it is not identified; empty if it is.
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
        portmanteau: Statistic of Ljung and Box of the residuals' correlations over 20 lags.
    """

    joint: str
    servo: JointServo
    parameters: tuple[FittedParameter, ...]
    rms_rad_s: dict[str, float]
    samples: int
    autocorrelation: float
    portmanteau: float

    @property
    def adequate(self) -> bool:
        """The residuals are nearly white, so that the model explains the motion and the intervals hold."""
        return self.autocorrelation <= MOST_AUTOCORRELATION and self.portmanteau <= MOST_PORTMANTEAU

    def determined(self) -> dict[str, float]:
        """Values of the determined parameters by name."""
        return {
            each.name: each.value
            for each in self.parameters
            if each.status is FitStatus.DETERMINED and each.value is not None
        }


def fit_joint(recording: Recording, joint: str) -> ServoFit:
    """Fit the servo of one joint to all segments in which it is excited.

    Under velocity control measured speeds are compared, under position control positions too, each weighted with the
    deviation of its residuals in a first fit. The intervals are those of the linearised problem, with derivatives over
    the deviations of the parameters, from (J^T J)^-1 with Student's t, widened by sqrt((1 + r) / (1 - r)) for
    neighbouring residuals correlated by r > 0 (first-order autoregression).

    Raises:
        DefinitionError: The joint is never excited.
    """
    segments = recording.of_joint(joint)
    if not any(np.abs(each.excited.commanded_rad_s).max() > 0.0 for each in segments):
        raise DefinitionError(f"the recording has no motion of joint {joint!r}", hint="record steps or sines of it")
    problem = ServoProblem(segments, recording.control, recording.commands)
    found = problem.solved()
    problem.refine()
    if recording.control is ServoControl.POSITION:
        problem.weigh(found)
    found = problem.solved(found)
    jacobian, residuals = problem.jacobian(found), problem.residuals(found)
    correlation = problem.autocorrelation(residuals)
    half, _ = _half_widths(jacobian, residuals, correlation, problem.least)
    # Two deviations are the half-width of a 95 % interval, nearly.
    half, alike = _half_widths(problem.slopes(found, half / 2), residuals, correlation, problem.least)
    parameters = [_parameter(problem.names, index, found, half, alike) for index in range(len(problem.names))]
    if recording.control is ServoControl.VELOCITY:
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
        portmanteau=problem.portmanteau(residuals),
    )


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
    lower, upper, _ = PARAMETER_ENDS[name]
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
            reason = f"the recording does not tell it from {parameter_key(names[other])[0]}: correlation {likeness:.2f}"
        elif value - width <= lower and lower == 0.0:
            status, reason = FitStatus.NEAR_ZERO, "its interval contains zero"
    return FittedParameter(name=name, status=status, value=value, interval=interval, reason=reason)
