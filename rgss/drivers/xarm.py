"""Driver of UFACTORY arms such as the Lite6, through xArm-Python-SDK, in its servo motion mode.

Calls and codes are those of xArm-Python-SDK 1.18. No robot was available: the driver was run by the real SDK against a
server of the controller's protocol, and against doubles.
"""

from __future__ import annotations

import contextlib
import socket
import time
from collections.abc import Callable
from typing import Any

from rgss.drivers.driver import Estimate, GripperState, SetPoint
from rgss.drivers.sdk_modules import close_sdk, import_sdk, prints_to_stderr, sdk_errors
from rgss.errors import DriverError

_SERVO_MODE = 1
_MOTION_STATE = 0
_STOP_STATE = 4
_OK = 0
_NO_ANSWER = 3
_NOT_CONNECTED = -1
_MODE_TIMEOUT_S = 2.0
_STOP_TIMEOUT_S = 1.0
_PRINTING = ("xarm.x3.base", "xarm.core.wrapper.uxbus_cmd_tcp")
"""Modules of the SDK that print when it connects."""
_GRIPPER_CALLS = {
    GripperState.OPEN: "open_lite6_gripper",
    GripperState.CLOSED: "close_lite6_gripper",
    GripperState.NEUTRAL: "stop_lite6_gripper",
}


class XarmDriver:
    """An arm of UFACTORY at an address, moved by set points of its joints."""

    name = "xarm"

    def __init__(
        self,
        address: str,
        *,
        joints: int,
        is_vacuum: bool = False,
        rate_hz: float = 100.0,
        reply_timeout_s: float = 0.05,
        open_api: Callable[[str], Any] | None = None,
    ) -> None:
        """Take the address; nothing is opened.

        Args:
            address: Name or IP address of the controller.
            joints: Number of joints of the task's robot.
            is_vacuum: Whether a vacuum cup is at the tool's outputs, and not the Lite6's gripper. What closes the
                gripper switches a vacuum off.
            rate_hz: Rate of the set points; the SDK recommends 100 to 250 Hz.
            reply_timeout_s: How long a call may wait for the controller while the task runs; the SDK waits 2 s.
            open_api: Opens the SDK's ``XArmAPI``; that of the installed SDK by default.
        """
        self.rate_hz = rate_hz
        self._address, self._joints, self._is_vacuum = address, joints, is_vacuum
        self._reply_timeout_s = reply_timeout_s
        self._open_api = open_api or _open_api
        self._api: Any = None
        self._gripper: GripperState | None = None
        self._last: Estimate | None = None
        self._replies = 0

    def connect(self) -> None:
        """Connect, and enter servo motion mode if the controller reports no error.

        Raises:
            DefinitionError: The SDK is not installed.
            DriverError: The connection failed, an error is pending, the arm has another number of joints, or it
                does not report servo motion mode.
        """
        with sdk_errors(f"no xArm controller answers at {self._address}", hint="check its address and network"):
            self._api = self._open_api(self._address)
        api = self._api
        if not api.connected:
            raise DriverError(
                f"no xArm controller answers at {self._address}", hint="check the address and the network"
            )
        if api.axis != self._joints:
            raise DriverError(
                f"the arm at {self._address} has {api.axis} joints, the task moves {self._joints}",
                hint="run a study whose robot file describes this arm",
            )
        self._require_no_error()
        try:
            self._call("motion_enable", enable=True)
            self._call("set_mode", _SERVO_MODE)
            self._call("set_state", _MOTION_STATE)
            self._await_servo_mode()
            self._set_timeout(self._reply_timeout_s)
        except BaseException:
            with contextlib.suppress(DriverError):
                self.stop()
            raise

    def read(self) -> Estimate:
        """Joint states of the controller; the stamp counts its replies."""
        api = self._opened()
        with sdk_errors("the xArm controller does not report its joints"):
            code, states = api.get_joint_states(is_radian=True, num=2)
            if code == _OK:
                positions, velocities = (tuple(float(value) for value in row[: self._joints]) for row in states[:2])
        if code == _OK:
            self._replies += 1
            fault = f"the controller reports error {api.error_code}" if api.error_code else ""
            self._last = Estimate(
                positions_rad=positions,
                velocities_rad_s=velocities,
                gripper=self._gripper or GripperState.NEUTRAL,
                stamp=float(self._replies),
                fault=fault,
            )
        if self._last is None:
            raise DriverError(f"the controller does not report its joints (get_joint_states: code {code})")
        return self._last

    def send(self, point: SetPoint) -> None:
        """One call of ``set_servo_angle_j``; the gripper is called where its state changes."""
        self._opened()
        if point.gripper is not self._gripper:
            # At once: in the motion queue it would wait behind set points that never end.
            if self._is_vacuum and point.gripper is not GripperState.NEUTRAL:
                self._call("set_vacuum_gripper", point.gripper is GripperState.CLOSED, wait=False, sync=False)
            else:
                self._call(_GRIPPER_CALLS[point.gripper], sync=False)
            self._gripper = point.gripper
        self._call("set_servo_angle_j", list(point.positions_rad), is_radian=True)

    def stop(self) -> None:
        """The controller's own stop; the gripper keeps its state."""
        # Without a longer time limit it may not be confirmed, but it is sent.
        with contextlib.suppress(DriverError):
            self._set_timeout(_STOP_TIMEOUT_S)
        self._call("set_state", _STOP_STATE)

    def disconnect(self) -> None:
        """Close the connection."""
        if self._api is not None:
            close_sdk(self._api.disconnect)
            self._api = None

    def _require_no_error(self) -> None:
        # Asked for: the SDK's own `error_code` is 0 until the controller's first report.
        with sdk_errors("the xArm controller does not report its errors"):
            code, (error, _) = self._api.get_err_warn_code()
        if code != _OK:
            raise DriverError(f"the xArm controller does not report its errors (get_err_warn_code: code {code})")
        if error != 0:
            raise DriverError(
                f"the controller reports error {error}", hint="find its cause and clear it on the arm first"
            )

    def _await_servo_mode(self) -> None:
        """Wait until the controller's reports, of which a few arrive per second, have the mode that was set."""
        end_s = time.monotonic() + _MODE_TIMEOUT_S
        while self._api.mode != _SERVO_MODE:
            if time.monotonic() > end_s:
                raise DriverError(
                    f"the controller reports mode {self._api.mode} instead of servo motion mode ({_SERVO_MODE})",
                    hint="check on the arm that it is enabled and that no other program controls it",
                )
            time.sleep(0.005)

    def _set_timeout(self, timeout_s: float) -> None:
        with sdk_errors("the SDK did not take a time limit of its calls"):
            self._opened().set_timeout(timeout_s)

    def _opened(self) -> Any:
        if self._api is None:
            raise DriverError("the xArm controller is not connected", hint="call connect first")
        return self._api

    def _call(self, name: str, *arguments: Any, **options: Any) -> None:
        method = getattr(self._opened(), name)
        with sdk_errors(f"the xArm controller did not take {name}"):
            code = method(*arguments, **options)
        if code == _NO_ANSWER:
            raise DriverError(f"the xArm controller did not answer {name}", hint="check the network")
        if code == _NOT_CONNECTED:
            raise DriverError(
                f"the connection to the xArm controller is closed, {name} was not sent",
                hint="check the network, and that the controller was not restarted",
            )
        if code != _OK:
            raise DriverError(
                f"the xArm controller refused {name} with code {code}", hint="see the SDK's list of codes"
            )


def _open_api(address: str) -> Any:
    sdk = import_sdk("xarm.wrapper", distribution="xArm-Python-SDK", extra="xarm")
    for module in _PRINTING:
        prints_to_stderr(module)
    # What is not an IP address the SDK takes for a serial port.
    return sdk.XArmAPI(socket.gethostbyname(address), is_radian=True)
