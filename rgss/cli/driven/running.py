"""A trial's motion on a driver, rehearsed first."""

from __future__ import annotations

import argparse
import math
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rgss.cli.driven.real_drivers import real_driver
from rgss.errors import DefinitionError, DriverError

if TYPE_CHECKING:
    from rgss.drivers import Driver, Rehearsal, RobotLimits, StreamClock, StreamResult, TimedTask
    from rgss.scenes import Robot
    from rgss.tasks import TaskProgram
    from rgss.trials import TrialSpec


def run_driven(options: argparse.Namespace, spec: TrialSpec) -> int:
    """Rehearse the task of a trial; run it on the simulated robot, or on a real one with ``--go``.

    Returns:
        0 if the rehearsal or the run is complete, 130 if it was interrupted, 3 if it ended otherwise.

    Raises:
        DefinitionError: The folder of the recording does not exist, or the driver has no arms with such joints.
        DriverError: The task was refused, or the robot cannot be connected.
        MotionError: A move was not planned or timed.
    """
    from rgss.cli.driven.driver_options import speed_of
    from rgss.cli.driven.timed_task import timed_task
    from rgss.cli.main import CLEAN, INTERRUPTED, RUN_FAILED
    from rgss.cli.output import print_json
    from rgss.documents import write_output
    from rgss.drivers import Guard, StreamOutcome, StreamSettings, limits_of, recording_csv, rehearse, stream
    from rgss.trials import cell_of, conditions_of, plan_of, timing_of

    settings = StreamSettings(speed=speed_of(options))
    if options.recording is not None and not options.recording.absolute().parent.is_dir():
        raise DefinitionError(f"{options.recording} cannot be written: there is no such folder", hint="create it")
    cell = cell_of(spec)
    _require_drivable(options.driver, cell.scene.robot)
    _require_neutral(options.driver, spec.task)
    plan = plan_of(spec)
    task = timed_task(spec, plan, timing_of(spec, plan))
    limits = limits_of(cell.scene.robot.joints, tool_speed_m_s=conditions_of(spec).tool_speed_m_s)
    driver, clock = _driver(options, spec, task)
    rehearsal = rehearse(task, limits, cell.arm, settings, rate_hz=driver.rate_hz)
    shown = {"driver": driver.name, "speed": settings.speed, **_rehearsal_as_json(rehearsal, limits)}
    if not options.json:
        _show_rehearsal(rehearsal, limits, driver.name, settings.speed)
    if rehearsal.refusal:
        raise DriverError(f"the task was refused, nothing was sent: {rehearsal.refusal}")
    if driver.name != "simulated" and not options.go:
        if options.json:
            print_json({**shown, "outcome": None})
        else:
            print("A rehearsal: nothing was sent. Bring the robot to the start, clear its space, then add --go.")
        return CLEAN
    with _interrupt_flag() as is_interrupted:
        guard = Guard(limits, cell.arm, period_s=1.0 / driver.rate_hz)
        result = stream(driver, task, guard, clock, settings, is_interrupted=is_interrupted)
        if options.recording is not None:
            # A signal while it is written must not lose what the robot has done.
            is_interrupted.ends_waiting = False
            recorded = f"variant {spec.variant} by rgss run --driver {driver.name}, {result.outcome.value}"
            robot = cell.scene.robot.id
            content = recording_csv(result.samples, limits.names, robot=robot, recorded=recorded, slides=limits.slides)
            write_output(options.recording, content)
    if options.json:
        print_json({**shown, **_result_as_json(result, limits)})
    else:
        _show_result(result, limits)
    if result.outcome is StreamOutcome.COMPLETED:
        return CLEAN
    return INTERRUPTED if result.outcome is StreamOutcome.INTERRUPTED else RUN_FAILED


def _require_drivable(driver: str, robot: Robot) -> None:
    """Check that arms of a driver have joints such as those of the robot.

    Raises:
        DefinitionError: They have another number, or none that slides.
    """
    from rgss.scenes import JointKind

    real = real_driver(driver)
    if real is None:
        return
    least, most = real.fewest_joints, real.most_joints
    sliding = sum(joint.kind is not JointKind.REVOLUTE for joint in robot.joints)
    if sliding or not least <= len(robot.joints) <= most:
        numbers = f"{least}" if least == most else f"{least} to {most}"
        slide = f", {sliding} of which slide{'' if sliding > 1 else 's'}" if sliding else ""
        raise DefinitionError(
            f"driver {driver} moves arms of {numbers} joints that turn; {robot.id} has {len(robot.joints)}{slide}",
            hint="use --driver simulated",
        )


def _require_neutral(driver: str, task: TaskProgram) -> None:
    """Check that a driver has the neutral state if the task sets it.

    Raises:
        DefinitionError: It has not.
    """
    from rgss.tasks import NeutralStep

    real = real_driver(driver)
    step = next((one for one in task.steps if isinstance(one, NeutralStep)), None)
    if real is not None and real.without_neutral and step is not None:
        raise DefinitionError(
            f"driver {driver} {real.without_neutral}; {step.name} sets it to neutral",
            hint="use --driver simulated, or leave the step out",
        )


def _driver(options: argparse.Namespace, spec: TrialSpec, task: TimedTask) -> tuple[Driver, StreamClock]:
    """The driver that the options name, not yet connected, and its clock."""
    from rgss.drivers import MonotonicClock, SimulatedDriver
    from rgss.tasks import HandAction
    from rgss.trials import cell_of, conditions_of, with_grasp_of
    from rgss.trials.plants import GripSequence

    real = real_driver(options.driver)
    if real is not None:
        return real.made(options, spec), MonotonicClock()
    conditions = conditions_of(spec)
    scene = with_grasp_of(conditions.true_scene, cell_of(spec))
    gripper = conditions.true_gripper
    sequence = GripSequence(spec.task, scene, gripper.geometry)
    simulated = SimulatedDriver(
        scene,
        gripper,
        spec.settings.physics,
        start_rad=task.start_rad,
        grips=[sequence.view_of(step) for step in spec.task.steps if step.hand is HandAction.CLOSES],
    )
    return simulated, simulated


class _InterruptFlag:
    """Flag that Ctrl-C and termination set.

    Attributes:
        ends_waiting: Whether the second signal raises a `KeyboardInterrupt`.
    """

    def __init__(self) -> None:
        self.ends_waiting = True
        self._received = 0

    def __call__(self) -> bool:
        """True if a signal came."""
        return self._received > 0

    def note(self, _number: int, _frame: object) -> None:
        """Handle a signal."""
        self._received += 1
        if self._received == 2 and self.ends_waiting:
            raise KeyboardInterrupt


@contextmanager
def _interrupt_flag() -> Iterator[_InterruptFlag]:
    """Turn Ctrl-C, termination and the loss of the terminal into a flag: the robot is brought to rest before the end.

    The second one interrupts what the program waits for, such as a call of an SDK that does not return, and the robot
    is stopped at once. Further ones are ignored: they must not interrupt that stop.
    """
    flag = _InterruptFlag()
    previous = {number: signal.signal(number, flag.note) for number in _ending_signals()}
    try:
        yield flag
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)


def _ending_signals() -> Iterator[signal.Signals]:
    yield from (signal.SIGINT, signal.SIGTERM)
    # Under nohup the loss of the terminal is ignored.
    if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:
        yield signal.SIGHUP


def _rehearsal_as_json(rehearsal: Rehearsal, limits: RobotLimits) -> dict[str, Any]:
    return {
        "start_rad": dict(zip(limits.names, rehearsal.start_rad, strict=True)),
        "units": {name: limits.unit_of(name) for name in limits.names},
        "duration_s": rehearsal.duration_s,
        "segments": [
            {
                "phase": segment.name,
                "gripper": segment.gripper.value,
                "duration_s": segment.duration_s,
                "set_points": segment.set_points,
                "peak_speed": segment.peak_speed,
                "peak_acceleration": segment.peak_acceleration,
                "peak_tool_speed_m_s": segment.peak_tool_speed_m_s,
            }
            for segment in rehearsal.segments
        ],
    }


def _show_rehearsal(rehearsal: Rehearsal, limits: RobotLimits, driver: str, speed: float) -> None:
    from rgss.cli.output import number, print_table

    print(f"Driver {driver} at {100 * speed:g} % of the planned speed, {number(rehearsal.duration_s)} s")
    start = ", ".join(
        f"{name} {limits.position_text(name, value, unit=bool(limits.slides))}"
        for name, value in zip(limits.names, rehearsal.start_rad, strict=True)
    )
    print(f"start: {start}" if limits.slides else f"start [deg]: {start}")
    rows = [
        [
            segment.name,
            segment.gripper.value,
            number(segment.duration_s),
            str(segment.set_points),
            number(100 * segment.peak_speed, 3),
            number(100 * segment.peak_acceleration, 3),
            number(segment.peak_tool_speed_m_s, 3),
        ]
        for segment in rehearsal.segments
    ]
    titles = ["phase", "gripper", "time [s]", "set points", "speed [% of limit]", "acceleration [%]", "tool [m/s]"]
    print_table(titles, rows, right=(2, 3, 4, 5, 6))


def _largest_errors(result: StreamResult, limits: RobotLimits) -> dict[str, float]:
    """Greatest following error of the joints by unit, rad or m."""
    found = dict.fromkeys(sorted({limits.unit_of(name) for name in limits.names}, reverse=True), 0.0)
    for sample in result.samples:
        pairs = zip(limits.names, sample.measured.positions_rad, sample.commanded.positions_rad, strict=False)
        for name, measured, commanded in pairs:
            unit = limits.unit_of(name)
            found[unit] = max(found[unit], abs(measured - commanded))
    return found


def _result_as_json(result: StreamResult, limits: RobotLimits) -> dict[str, Any]:
    return {
        "outcome": result.outcome.value,
        "detail": result.detail,
        "sent": result.sent,
        **{f"largest_error_{unit}": error for unit, error in _largest_errors(result, limits).items()},
    }


def _show_result(result: StreamResult, limits: RobotLimits) -> None:
    errors = " and ".join(
        f"{1e3 * error:.3g} mm" if unit == "m" else f"{math.degrees(error):.3g} deg"
        for unit, error in _largest_errors(result, limits).items()
    )
    detail = f": {result.detail}" if result.detail else ""
    print(f"{result.outcome.value}{detail} ({result.sent} set points sent, largest following error {errors})")
