"""Least-squares problem of a joint's servo: residuals over segments, their derivatives, and its solution."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.identification.motion_of_servos import LONGEST_STEP_S, ServoCommands, servo_motions
from rgss.identification.recording import CommandedPositions, Segment
from rgss.scenes import JointServo, ServoControl

Array = NDArray[np.float64]

_LONGEST_DELAY_S = 0.5
_SEARCH_STEP_S = 1.0e-3
_MOST_GAIN_HZ = 5.0e3
LAGS = 20
"""Lags over which residuals are tested for whiteness."""

PARAMETER_ENDS = {
    "velocity_gain_hz": (0.01, _MOST_GAIN_HZ, 1.0),
    "position_gain_hz2": (0.0, _MOST_GAIN_HZ**2, 10.0),
    "delay_s": (0.0, _LONGEST_DELAY_S, 1.0e-3),
    "viscous_hz": (0.0, _MOST_GAIN_HZ, 0.1),
    "coulomb_rad_s2": (0.0, 1.0e4, 0.1),
}
"""Lower end, upper end and least scale of each parameter."""


_START_SCALES = (1.0e-3, 1.0e-2)
"""Scales of the position (rad) and the speed (rad/s) at the start of a segment."""


class ServoProblem:
    """Residuals of a servo, and their derivatives by central differences.

    The parameters are those of the servo; under position control the position at the start of each segment follows,
    and under both the speed of each that does not start at rest. They are measured with noise as the other samples are,
    so that taking them as known would make intervals too narrow.

    Attributes:
        names: The parameters of the servo, which come first.
        least: Least scale of every parameter.
    """

    def __init__(
        self,
        segments: Sequence[Segment],
        control: ServoControl,
        commands: CommandedPositions = CommandedPositions.HELD,
    ) -> None:
        self._segments = [each for each in segments if np.abs(each.excited.commanded_rad_s).max() > 0.0]
        self._commands = commands
        self._positions = control is ServoControl.POSITION
        self.names = tuple(name for name in _PARAMETERS if self._positions or name != "position_gain_hz2")
        self._begun = [_start(segment) for segment in self._segments]
        # Of each further parameter: its segment, and 0 for the position or 1 for the speed.
        self._of_starts = [
            (index, part)
            for part in (0, 1)
            for index, segment in enumerate(self._segments)
            if (self._positions if part == 0 else _samples_at_rest(segment) == 1)
        ]
        ends = [PARAMETER_ENDS[name] for name in self.names]
        ends += [(-math.inf, math.inf, _START_SCALES[part]) for _, part in self._of_starts]
        self._lower, self._upper, self.least = (np.array(values) for values in zip(*ends, strict=True))
        self._weights = (1.0, 1.0)
        self._longest_step_s = _SEARCH_STEP_S
        self._last: tuple[bytes, Array, Array] | None = None

    def refine(self) -> None:
        """Solve servos in the finest steps from now on; the search among several starts needs none."""
        self._longest_step_s = LONGEST_STEP_S
        self._last = None

    def servo(self, values: Array) -> JointServo:
        """The servo with parameters, each within its ends."""
        within = np.clip(values, self._lower, self._upper)[: len(self.names)].tolist()
        return JointServo(**dict(zip(self.names, within, strict=True)))

    def residuals(self, values: Array) -> Array:
        """Weighted residuals, shape (residuals,)."""
        return self._linearised(values)[0]

    def jacobian(self, values: Array) -> Array:
        """Derivatives of the residuals, shape (residuals, parameters)."""
        return self._linearised(values)[1]

    def slopes(self, values: Array, deviations: Array) -> Array:
        """Mean derivatives of the residuals over the deviations of the parameters, shape (residuals, parameters).

        A response has kinks: where a delayed step arrives at a sample, and where friction stops a joint. A derivative
        at a point misses those next to it, with which the estimates vary more than by the derivative.

        Args:
            values: The parameters.
            deviations: Their standard deviations; infinite where they are unknown. A tenth of a value is the most.
        """
        most = 0.1 * np.maximum(np.abs(values), self.least)
        return self._both(values, np.maximum(np.minimum(deviations, most), self._steps(values)))[1]

    def solved(self, begin: Array | None = None) -> Array:
        """The best parameters from several starts, or from one that is given."""
        from scipy.optimize import least_squares

        of_starts = np.array([self._begun[index][part] for index, part in self._of_starts])
        starts = [np.append(each, of_starts) for each in _starts(self.names)] if begin is None else [begin]
        costs = [float(np.sum(each**2)) for each in self._many(starts)]
        order = sorted(range(len(starts)), key=lambda index: costs[index])[:2]
        found = [
            least_squares(
                self.residuals,
                np.clip(starts[index], self._lower, self._upper),
                jac=self.jacobian,
                bounds=(self._lower, self._upper),
                x_scale=np.maximum(np.abs(starts[index]), self.least),
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
        self._last = None

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

    def portmanteau(self, residuals: Array) -> float:
        """Statistic of Ljung and Box (1978) over `LAGS` lags: chi-squared with as many degrees if they are white."""
        count, total = len(residuals), float(np.sum(residuals**2))
        if total == 0.0 or count <= LAGS + 1:
            return 0.0
        correlations = [float(np.sum(residuals[lag:] * residuals[:-lag])) / total for lag in range(1, LAGS + 1)]
        return count * (count + 2.0) * math.fsum(r * r / (count - k) for k, r in enumerate(correlations, start=1))

    def _linearised(self, values: Array) -> tuple[Array, Array]:
        """Residuals and their derivatives; both are computed at once, and kept for the next call."""
        key = values.tobytes()
        if self._last is None or self._last[0] != key:
            self._last = key, *self._both(values, self._steps(values))
        return self._last[1], self._last[2]

    def _steps(self, values: Array) -> Array:
        steps: Array = 1.0e-4 * np.maximum(np.abs(values), self.least)
        return steps

    def _both(self, values: Array, steps: Array) -> tuple[Array, Array]:
        groups = self._independent()
        ahead, behind = (
            [np.clip(values + sign * np.where(group, steps, 0.0), self._lower, self._upper) for group in groups]
            for sign in (1.0, -1.0)
        )
        residuals, *found = self._many([values, *ahead, *behind])
        columns = np.zeros((len(residuals), len(values)))
        for index, group in enumerate(groups):
            change = found[index] - found[len(groups) + index]
            for column in np.flatnonzero(group).tolist():
                span = float(ahead[index][column] - behind[index][column])
                columns[:, column] = np.where(self._rows_of(column), change, 0.0) / span
        return residuals, columns

    def _independent(self) -> list[NDArray[np.bool_]]:
        """Parameters that may be changed at once, since no residual depends on two of them."""
        count = len(self.names)
        of_servo = [np.arange(len(self.least)) == index for index in range(count)]
        parts = np.array([-1] * count + [part for _, part in self._of_starts])
        return [*of_servo, *(parts == part for part in (0, 1) if part in parts)]

    def _rows_of(self, column: int) -> NDArray[np.bool_]:
        """The residuals that depend on a parameter: those of its segment for a start, otherwise all."""
        lengths = [len(segment.times_s) for segment in self._segments]
        of_segment = np.repeat(np.arange(len(lengths)), lengths)
        rows = np.concatenate([of_segment, of_segment]) if self._positions else of_segment
        if column < len(self.names):
            return np.ones(len(rows), dtype=np.bool_)
        found: NDArray[np.bool_] = rows == self._of_starts[column - len(self.names)][0]
        return found

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
        given = [
            ServoCommands(
                times_s=segment.times_s,
                commanded_rad=segment.excited.commanded_rad,
                commanded_rad_s=segment.excited.commanded_rad_s,
                start=self._starts_of(number, many),
            )
            for number, segment in enumerate(self._segments)
        ]
        motions = servo_motions(servos, given, commands=self._commands, longest_step_s=self._longest_step_s)
        return [
            [
                (
                    motion.velocities_rad_s[index] - segment.excited.measured_rad_s,
                    motion.positions_rad[index] - segment.excited.measured_rad,
                )
                for segment, motion in zip(self._segments, motions, strict=True)
            ]
            for index in range(len(servos))
        ]

    def _starts_of(self, number: int, many: Sequence[Array]) -> tuple[float | Array, float | Array]:
        """Position and speed at the start of a segment, for each set of parameters."""
        found: list[float | Array] = list(self._begun[number])
        for index, (segment, part) in enumerate(self._of_starts, start=len(self.names)):
            if segment == number:
                found[part] = np.array([values[index] for values in many])
        return found[0], found[1]


_PARAMETERS = ("position_gain_hz2", "velocity_gain_hz", "delay_s", "viscous_hz", "coulomb_rad_s2")


def _start(segment: Segment) -> tuple[float, float]:
    """Position and speed before the first command: the mean of the samples at rest, else the first sample."""
    series = segment.excited
    rest = _samples_at_rest(segment)
    return float(series.measured_rad[:rest].mean()), 0.0 if rest > 1 else float(series.measured_rad_s[0])


def _samples_at_rest(segment: Segment) -> int:
    """Number of samples before the first command, at least one."""
    moving = np.flatnonzero(np.abs(segment.excited.commanded_rad_s) > 0.0)
    return max(1, int(moving[0]))


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
