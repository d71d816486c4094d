"""Driver of Universal Robots arms through ur-rtde: servoJ, with the gripper on a digital output.

Calls are those of ur-rtde 1.6. No robot was available: reading was run against a server that speaks RTDE's protocol
on the loopback, motion against doubles only.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rgss.drivers.driver import Estimate, GripperState, SetPoint
from rgss.drivers.sdk_modules import close_sdk, import_sdk, sdk_errors
from rgss.errors import DriverError

_RUNNING_MODE = 7
_MOVING_SAFETY_MODES = (1, 2)
"""Normal and reduced, of RTDE's ``safety_mode``."""

_WATCHDOG_HZ = 10.0
_STOP_RAD_S2 = 2.0
_UNUSED = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class UrSettings:
    """Settings of a driver of Universal Robots arms.

    Attributes:
        rate_hz: Rate of the set points: at most 125 Hz on CB3 controllers, 500 Hz on e-Series.
        gripper_output: Standard digital output that closes the gripper while it is high.
        lookahead_s: Smoothing of servoJ, 0.03 to 0.2 s.
        gain: Proportional gain of servoJ, 100 to 2000.
    """

    rate_hz: float = 125.0
    gripper_output: int = 0
    lookahead_s: float = 0.1
    gain: float = 300.0


class UrDriver:
    """An arm of Universal Robots at an address, moved by set points of its joints."""

    name = "ur"

    def __init__(
        self,
        address: str,
        *,
        settings: UrSettings | None = None,
        open_receive: Callable[[str, float], Any] | None = None,
        open_control: Callable[[str, float], Any] | None = None,
        open_io: Callable[[str], Any] | None = None,
    ) -> None:
        """Take the address; nothing is opened.

        Args:
            address: Name or IP address of the controller.
            settings: Rate, output and servo settings.
            open_receive: Opens ur-rtde's ``RTDEReceiveInterface``; by default, that of the installed SDK.
            open_control: Opens ``RTDEControlInterface``, which starts a program on the robot.
            open_io: Opens ``RTDEIOInterface``.
        """
        self._address, self._settings = address, settings or UrSettings()
        self._open_receive = open_receive or _open_receive
        self._open_control = open_control or _open_control
        self._open_io = open_io or _open_io
        self._receive: Any = None
        self._control: Any = None
        self._io: Any = None
        self._gripper: GripperState | None = None

    @property
    def rate_hz(self) -> float:
        """Rate of the set points."""
        return self._settings.rate_hz

    def connect(self) -> None:
        """Connect; the set-point program is started only if the robot is ready to move.

        Raises:
            DefinitionError: The SDK is not installed.
            DriverError: The connection failed, or the robot is not ready.
        """
        self._receive = self._open("RTDE receive", self._open_receive, self._address, self.rate_hz)
        with sdk_errors("the UR controller does not report its modes"):
            mode, safety = self._receive.getRobotMode(), self._receive.getSafetyMode()
        if mode != _RUNNING_MODE:
            raise DriverError(_not_running(mode), hint="power it on and release its brakes")
        if safety not in _MOVING_SAFETY_MODES:
            raise DriverError(_not_moving(safety), hint="resolve it on the teach pendant")
        self._control = self._open("RTDE control", self._open_control, self._address, self.rate_hz)
        try:
            self._io = self._open("RTDE input and output", self._open_io, self._address)
            # The controller stops the program by itself if no set point arrives any more.
            self._call(self._control, "setWatchdog", _WATCHDOG_HZ)
        except BaseException:
            # The set-point program runs on the robot already.
            with contextlib.suppress(DriverError):
                self.stop()
            raise

    def read(self) -> Estimate:
        """The last package of the controller; the stamp is its time."""
        receive = self._opened(self._receive)
        with sdk_errors("the UR controller does not report its joints"):
            return Estimate(
                positions_rad=tuple(receive.getActualQ()),
                velocities_rad_s=tuple(receive.getActualQd()),
                gripper=self._gripper or GripperState.NEUTRAL,
                stamp=receive.getTimestamp(),
                fault=self._fault(),
            )

    def send(self, point: SetPoint) -> None:
        """One call of ``servoJ``; the output is set where the gripper changes."""
        settings = self._settings
        if point.gripper is not self._gripper:
            is_closed = point.gripper is GripperState.CLOSED
            self._call(self._io, "setStandardDigitalOut", settings.gripper_output, is_closed)
            self._gripper = point.gripper
        # Speed and acceleration are not used by servoJ.
        servo = (_UNUSED, _UNUSED, 1.0 / settings.rate_hz, settings.lookahead_s, settings.gain)
        self._call(self._control, "servoJ", list(point.positions_rad), *servo)

    def stop(self) -> None:
        """Decelerate from servoJ and end the program on the robot; the output keeps its state."""
        try:
            self._call(self._control, "servoStop", _STOP_RAD_S2)
        finally:
            self._call(self._control, "stopScript")

    def disconnect(self) -> None:
        """Close the connections that are open."""
        for interface in (self._control, self._io, self._receive):
            if interface is not None:
                close_sdk(interface.disconnect)
        self._control = self._io = self._receive = None

    def _fault(self) -> str:
        receive = self._receive
        if receive.isEmergencyStopped():
            return "the robot is emergency stopped"
        if receive.isProtectiveStopped():
            return "the robot is protective stopped"
        if not receive.isConnected():
            return "the connection to the robot is closed"
        mode, safety = receive.getRobotMode(), receive.getSafetyMode()
        # After a safeguard stop the robot would go on by itself, at a set point far from where it stopped.
        if safety not in _MOVING_SAFETY_MODES:
            return _not_moving(safety)
        return "" if mode == _RUNNING_MODE else _not_running(mode)

    def _open(self, what: str, opener: Callable[..., Any], *arguments: Any) -> Any:
        with sdk_errors(f"no {what} interface at {self._address}", hint="check the address and remote control"):
            return opener(*arguments)

    def _opened(self, interface: Any) -> Any:
        if interface is None:
            raise DriverError("the UR controller is not connected", hint="call connect first")
        return interface

    def _call(self, interface: Any, name: str, *arguments: Any) -> None:
        with sdk_errors(f"the UR controller did not take {name}"):
            accepted = getattr(self._opened(interface), name)(*arguments)
        # Calls without an answer return None.
        if accepted is False:
            raise DriverError(f"the UR controller refused {name}", hint="see the log on the teach pendant")


def _not_running(mode: int) -> str:
    return f"the robot is in mode {mode}, not running (mode {_RUNNING_MODE})"


def _not_moving(safety: int) -> str:
    return f"the robot is in safety mode {safety}, neither normal (1) nor reduced (2)"


def _open_receive(address: str, rate_hz: float) -> Any:
    return import_sdk("rtde_receive", distribution="ur-rtde", extra="ur").RTDEReceiveInterface(address, rate_hz)


def _open_control(address: str, rate_hz: float) -> Any:
    return import_sdk("rtde_control", distribution="ur-rtde", extra="ur").RTDEControlInterface(address, rate_hz)


def _open_io(address: str) -> Any:
    return import_sdk("rtde_io", distribution="ur-rtde", extra="ur").RTDEIOInterface(address)
