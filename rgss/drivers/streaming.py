"""Fixed-rate stream of set points: slow start, heartbeat, and a stop in every case that is not as planned."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from rgss.drivers.driver import Driver, Estimate, GripperState, SetPoint
from rgss.drivers.limits import Guard
from rgss.drivers.stream_clock import StreamClock
from rgss.drivers.task import TaskCursor, TimedTask, rate_candidates
from rgss.errors import DefinitionError, DriverError

_ROUNDING_MS = 1e-6
"""Differences of clock readings are rounded; a period on the limit is allowed."""

_LEAST_SPEED = 0.01
"""At less, a task of seconds would take hours, of which every period is kept."""


class StreamOutcome(str, Enum):
    """Outcome of a stream; the robot is stopped in every case."""

    COMPLETED = "completed"
    REFUSED = "refused"
    HEARTBEAT_LOST = "heartbeat_lost"
    FOLLOWING_ERROR = "following_error"
    FAULT = "fault"
    LATE = "late"
    INTERRUPTED = "interrupted"


@dataclass(frozen=True, slots=True, kw_only=True)
class StreamSettings:
    """Settings of a stream.

    Attributes:
        speed: Share of the planned speed, from 0.01 to 1.
        ramp_s: Time in which that share is reached, and in which an interrupted motion comes to rest on its path.
        heartbeat_timeout_s: Longest time without a new report of the controller.
        late_s: Longest time by which a period may begin late, whether the program was paused or the controller
            answered slowly.
        following_error_rad: Greatest distance of a measured revolute joint from its set point.
        following_error_m: Greatest distance of a prismatic one.

    Raises:
        DefinitionError: A value is out of range.
    """

    speed: float = 0.1
    ramp_s: float = 0.5
    heartbeat_timeout_s: float = 0.1
    late_s: float = 0.05
    following_error_rad: float = 0.1
    following_error_m: float = 0.05

    def __post_init__(self) -> None:
        if not _LEAST_SPEED <= self.speed <= 1.0:
            raise DefinitionError(
                f"the speed of a driver must be from {100 * _LEAST_SPEED:g} % to 100 %, got {100 * self.speed:g} %"
            )
        times_s = (self.ramp_s, self.heartbeat_timeout_s, self.late_s)
        if not min(*times_s, self.following_error_rad, self.following_error_m) > 0.0:
            raise DefinitionError("times and the following error of a stream must be positive")


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """One period of a stream.

    Attributes:
        time_s: Time of the measurement, from the first one.
        phase: Name of the segment.
        measured: What the controller reports.
        commanded: The set point in force at that time, sent in the period before.
    """

    time_s: float
    phase: str
    measured: Estimate
    commanded: SetPoint


@dataclass(frozen=True, slots=True, kw_only=True)
class StreamResult:
    """Result of a stream.

    Attributes:
        outcome: How it ended.
        detail: Why, in one line; empty if it was completed.
        sent: Number of set points that were sent.
        samples: One for each period.
    """

    outcome: StreamOutcome
    detail: str
    sent: int
    samples: tuple[Sample, ...]


def stream(
    driver: Driver,
    task: TimedTask,
    guard: Guard,
    clock: StreamClock,
    settings: StreamSettings,
    *,
    is_interrupted: Callable[[], bool] = lambda: False,
) -> StreamResult:
    """Run a task on a driver, which is stopped and disconnected afterwards in every case.

    Args:
        driver: The robot, not connected.
        task: The task.
        guard: Fresh limits with the period of the driver's rate.
        clock: Time.
        settings: Speed and tolerances.
        is_interrupted: Read once in each period; if true, the motion comes to rest on its path. A `KeyboardInterrupt`
            after that stops the robot at once; the result has what it did until then.

    Raises:
        DriverError: The robot cannot be connected; nothing has moved.
        KeyboardInterrupt: It came while `is_interrupted` was false; the robot is stopped.
    """
    try:
        driver.connect()
        run = _Stream(driver, task, guard, clock, settings, is_interrupted)
        try:
            outcome, detail = run.run()
        except DriverError as error:
            outcome, detail = StreamOutcome.FAULT, str(error)
        except KeyboardInterrupt:
            if not is_interrupted():
                _stop(driver)
                raise
            outcome, detail = StreamOutcome.INTERRUPTED, f"interrupted again in {run.phase}, and stopped at once"
        except BaseException:
            _stop(driver)
            raise
        try:
            _stop(driver)
        except KeyboardInterrupt:
            if not is_interrupted():
                raise
            outcome = StreamOutcome.INTERRUPTED if outcome is StreamOutcome.COMPLETED else outcome
        except DriverError as error:
            outcome = StreamOutcome.FAULT if outcome is StreamOutcome.COMPLETED else outcome
            detail = "; ".join(filter(None, (detail, f"the stop was not confirmed: {error}")))
        return StreamResult(outcome=outcome, detail=detail, sent=run.sent, samples=tuple(run.samples))
    finally:
        driver.disconnect()


def _stop(driver: Driver) -> None:
    """Stop the robot, whatever signal arrives meanwhile."""
    try:
        driver.stop()
    except KeyboardInterrupt:
        driver.stop()
        raise


class _Stream:
    """State of one stream."""

    def __init__(
        self,
        driver: Driver,
        task: TimedTask,
        guard: Guard,
        clock: StreamClock,
        settings: StreamSettings,
        is_interrupted: Callable[[], bool],
    ) -> None:
        self._driver, self._task, self._guard = driver, task, guard
        self._clock, self._settings, self._is_interrupted = clock, settings, is_interrupted
        self._period_s = 1.0 / driver.rate_hz
        self._cursor = TaskCursor(task, self._period_s)
        self._stamp, self._stamped_s, self._in_calls_s = 0.0, 0.0, 0.0
        self.sent = 0
        self.samples: list[Sample] = []

    def run(self) -> tuple[StreamOutcome, str]:
        """The periods until the task is complete or something is not as planned."""
        begun_s = due_s = self._clock.now_s()
        estimate = self._driver.read()
        self._stamp, self._stamped_s = estimate.stamp, begun_s
        reason = estimate.fault or self._guard.begin(estimate.positions_rad, self._task.start_rad)
        if reason:
            return (StreamOutcome.FAULT if estimate.fault else StreamOutcome.REFUSED), reason
        still = (0.0,) * len(self._task.start_rad)
        point = SetPoint(positions_rad=self._task.start_rad, velocities_rad_s=still, gripper=self._first_gripper())
        phase, is_braking = self._cursor.segment.name, False
        while True:
            now_s = self._clock.now_s()
            self.samples.append(Sample(time_s=now_s - begun_s, phase=phase, measured=estimate, commanded=point))
            failure = self._failure(estimate, point, now_s=now_s, due_s=due_s)
            if failure is not None:
                return failure
            if self._cursor.is_finished:
                return StreamOutcome.COMPLETED, ""
            is_braking = is_braking or self._is_interrupted()
            if is_braking and (self._cursor.segment.motion is None or self._cursor.rate <= 0.0):
                return StreamOutcome.INTERRUPTED, f"interrupted in {self._cursor.segment.name}"
            phase = self._cursor.segment.name
            chosen = self._next_point(0.0 if is_braking else self._settings.speed)
            if isinstance(chosen, str):
                return StreamOutcome.REFUSED, chosen
            point, called_s = chosen, self._clock.now_s()
            self._driver.send(point)
            self.sent += 1
            # After a stall the grid is moved: points that make up for it would move the robot faster than planned.
            due_s = (now_s if now_s - due_s > self._period_s else due_s) + self._period_s
            self._in_calls_s = self._clock.now_s() - called_s
            self._clock.wait_until(due_s)
            called_s = self._clock.now_s()
            estimate = self._driver.read()
            self._in_calls_s += self._clock.now_s() - called_s

    @property
    def phase(self) -> str:
        """Name of the phase that runs."""
        return self._cursor.segment.name

    def _first_gripper(self) -> GripperState:
        return self._cursor.segment.gripper

    def _next_point(self, target: float) -> SetPoint | str:
        """The next set point at the rate nearest to the target that the guard admits; otherwise its reason."""
        step = self._settings.speed * self._period_s / self._settings.ramp_s
        reason = ""
        for rate in rate_candidates(self._cursor.rate, target, step):
            positions = self._cursor.candidate(rate)
            reason = self._guard.check(positions)
            if not reason:
                gripper = self._cursor.segment.gripper
                self._cursor.advance(rate)
                velocities = self._guard.admit(positions)
                return SetPoint(positions_rad=positions, velocities_rad_s=velocities, gripper=gripper)
        return reason

    def _failure(
        self, estimate: Estimate, point: SetPoint, *, now_s: float, due_s: float
    ) -> tuple[StreamOutcome, str] | None:
        settings = self._settings
        if estimate.stamp != self._stamp:
            self._stamp, self._stamped_s = estimate.stamp, now_s
        late_ms, silent_ms = 1e3 * (now_s - due_s), 1e3 * (now_s - self._stamped_s)
        late_limit_ms, in_calls_ms = 1e3 * settings.late_s, 1e3 * self._in_calls_s
        if late_ms > late_limit_ms + _ROUNDING_MS:
            allowed = f"at most {late_limit_ms:.0f} ms are allowed"
            # The controller answered slowly, unless the period was late without that.
            if late_ms - in_calls_ms <= late_limit_ms:
                detail = (
                    f"the controller took {in_calls_ms:.0f} ms to answer, which made a period {late_ms:.0f} ms late"
                )
                return StreamOutcome.HEARTBEAT_LOST, f"{detail}, at most {late_limit_ms:.0f} ms are allowed"
            detail = f"a period began {late_ms:.0f} ms late, at most {late_limit_ms:.0f} ms are allowed"
            return StreamOutcome.LATE, detail
        allowed_ms = 1e3 * settings.heartbeat_timeout_s
        if silent_ms > allowed_ms + _ROUNDING_MS:
            detail = f"the controller has not reported for {silent_ms:.0f} ms, at most {allowed_ms:.0f} ms are allowed"
            return StreamOutcome.HEARTBEAT_LOST, detail
        if estimate.fault:
            return StreamOutcome.FAULT, estimate.fault
        reported = {len(estimate.positions_rad), len(estimate.velocities_rad_s)}
        if reported != {len(point.positions_rad)}:
            return StreamOutcome.FAULT, f"the robot reports {' and '.join(map(str, sorted(reported)))} joints"
        for index, (measured, wanted) in enumerate(
            zip(estimate.positions_rad, point.positions_rad, strict=True), start=1
        ):
            # Not a number is a following error too.
            limits = self._guard.limits
            unit = limits.unit_of(limits.names[index - 1])
            most = settings.following_error_m if unit == "m" else settings.following_error_rad
            if not abs(measured - wanted) <= most:
                allowed = f"at most {most:g} {unit} are allowed"
                detail = f"joint {index} is {abs(measured - wanted):.3g} {unit} from its set point, {allowed}"
                return StreamOutcome.FOLLOWING_ERROR, detail
        return None
