"""The driver of Universal Robots arms: reading by the real SDK from a server of the protocol, motion on doubles."""

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.drivers import GripperState, SetPoint, StreamOutcome, StreamSettings, UrDriver, UrSettings, stream
from rgss.errors import DefinitionError, DriverError
from tests.drivers.conftest import Robot, guard, limits, pick_task
from tests.fixtures.processes import wait_until

READY = {"robot_mode": 7, "safety_mode": 1, "safety_status_bits": 1}


class Arm:
    """The three interfaces of one robot that follows at once."""

    def __init__(self, mode=7, safety=1):
        self.mode, self.safety = mode, safety
        self.q, self.time_s = [0.0] * 6, 0.0
        self.calls = []
        self.refused = ()
        self.is_emergency = self.is_protective = False
        self.is_connected = True

    def getRobotMode(self):  # noqa: N802 - the SDK\'s name
        return self.mode

    def getSafetyMode(self):  # noqa: N802 - the SDK\'s name
        return self.safety

    def getActualQ(self):  # noqa: N802 - the SDK\'s name
        return self.q

    def getActualQd(self):  # noqa: N802 - the SDK\'s name
        return [0.0] * 6

    def getTimestamp(self):  # noqa: N802 - the SDK\'s name
        self.time_s += 0.008
        return self.time_s

    def isEmergencyStopped(self):  # noqa: N802 - the SDK\'s name
        return self.is_emergency

    def isProtectiveStopped(self):  # noqa: N802 - the SDK\'s name
        return self.is_protective

    def isConnected(self):  # noqa: N802 - the SDK\'s name
        return self.is_connected

    def _note(self, name, *arguments):
        self.calls.append((name, *arguments))
        return name not in self.refused

    def setWatchdog(self, min_frequency):  # noqa: N802 - the SDK\'s name
        return self._note("setWatchdog", min_frequency)

    def servoJ(self, q, speed, acceleration, period, lookahead, gain):  # noqa: N802 - the SDK\'s name
        self.q = q
        return self._note("servoJ", speed, acceleration, period, lookahead, gain)

    def servoStop(self, a):  # noqa: N802 - the SDK\'s name
        return self._note("servoStop", a)

    def stopScript(self):  # noqa: N802 - the SDK\'s name
        self._note("stopScript")

    def setStandardDigitalOut(self, output, level):  # noqa: N802 - the SDK\'s name
        return self._note("setStandardDigitalOut", output, level)

    def disconnect(self):
        self._note("disconnect")


def _driver(arm, **settings):
    return UrDriver(
        "ur10.example",
        settings=UrSettings(**settings),
        open_receive=lambda *_: arm,
        open_control=lambda *_: arm,
        open_io=lambda *_: arm,
    )


def _point(gripper=GripperState.OPEN):
    return SetPoint(positions_rad=(0.1,) * 6, velocities_rad_s=(0.0,) * 6, gripper=gripper)


def _stream(arm, **settings):
    driver = _driver(arm, **settings)
    return stream(driver, pick_task(6), guard(limits(6), 125.0), Robot(()), StreamSettings(speed=1.0))


def test_a_task_runs_through_the_calls_of_the_sdk():
    arm = Arm()
    result = _stream(arm, gripper_output=3)
    assert (result.outcome, result.detail) == (StreamOutcome.COMPLETED, "")
    outputs = [call for call in arm.calls if call[0] == "setStandardDigitalOut"]
    assert outputs == [("setStandardDigitalOut", 3, False), ("setStandardDigitalOut", 3, True)]
    assert arm.calls[0] == ("setWatchdog", 10.0)
    assert arm.calls.count(("servoJ", 0.0, 0.0, 0.008, 0.1, 300.0)) == result.sent
    assert [call[0] for call in arm.calls[-5:]] == ["servoStop", "stopScript", *["disconnect"] * 3]


@pytest.mark.parametrize(
    ("name", "detail"),
    [
        ("is_emergency", "the robot is emergency stopped"),
        ("is_protective", "the robot is protective stopped"),
    ],
)
def test_a_stopped_robot_is_a_fault(name, detail):
    arm = Arm()
    setattr(arm, name, True)
    result = _stream(arm)
    assert (result.outcome, result.detail, result.sent) == (StreamOutcome.FAULT, detail, 0)
    arm.is_emergency = arm.is_protective = arm.is_connected = False
    driver = _driver(arm)
    driver.connect()
    assert driver.read().fault == "the connection to the robot is closed"


@pytest.mark.parametrize(
    ("changed", "detail"),
    [
        ({"safety": 5}, "the robot is in safety mode 5, neither normal (1) nor reduced (2)"),
        ({"mode": 3}, "the robot is in mode 3, not running (mode 7)"),
    ],
)
def test_a_safeguard_stop_or_a_robot_switched_off_on_the_way_is_a_fault(changed, detail):
    arm = Arm()
    moves = arm.servoJ

    def moving(*arguments):
        taken = moves(*arguments)
        if len(arm.calls) == 20:
            vars(arm).update(changed)
        return taken

    arm.servoJ = moving
    result = _stream(arm)
    assert (result.outcome, result.detail) == (StreamOutcome.FAULT, detail)
    assert ("servoStop", 2.0) in arm.calls


@pytest.mark.parametrize(
    ("arm", "message"),
    [
        (Arm(mode=5), r"the robot is in mode 5, not running \(mode 7\)"),
        (Arm(safety=3), "the robot is in safety mode 3, neither normal"),
    ],
)
def test_no_program_is_started_on_a_robot_that_is_not_ready(arm, message):
    with pytest.raises(DriverError, match=message):
        _driver(arm).connect()
    assert arm.calls == []


@pytest.mark.parametrize("call", ["servoJ", "setStandardDigitalOut"])
def test_a_refused_call_ends_the_stream(call):
    arm = Arm()
    arm.refused = (call,)
    result = _stream(arm)
    assert (result.outcome, result.sent) == (StreamOutcome.FAULT, 0)
    assert result.detail == f"the UR controller refused {call} (see the log on the teach pendant)"
    assert [c[0] for c in arm.calls[-5:-3]] == ["servoStop", "stopScript"]


def test_the_program_is_ended_although_the_stop_was_refused():
    arm = Arm()
    arm.refused = ("servoStop",)
    result = _stream(arm)
    assert result.outcome is StreamOutcome.FAULT
    assert "the stop was not confirmed: the UR controller refused servoStop" in result.detail
    assert "stopScript" in [call[0] for call in arm.calls]


def test_what_the_sdk_raises_is_an_error_of_the_driver():
    arm = Arm()

    def fail(*_):
        raise RuntimeError("RTDE control script is\nnot running!")

    driver = UrDriver("x", open_receive=lambda *_: arm, open_control=fail, open_io=lambda *_: arm)
    with pytest.raises(DriverError, match="no RTDE control interface at x: RTDE control script is not running!"):
        driver.connect()
    driver = _driver(arm)
    driver.connect()
    arm.servoJ = arm.getActualQ = fail
    with pytest.raises(DriverError, match="the UR controller did not take servoJ"):
        driver.send(_point())
    with pytest.raises(DriverError, match="the UR controller does not report its joints"):
        driver.read()


def test_nothing_can_be_sent_unconnected():
    with pytest.raises(DriverError, match="the UR controller is not connected"):
        _driver(Arm()).send(_point())
    with pytest.raises(DriverError, match="the UR controller is not connected"):
        _driver(Arm()).read()


@pytest.mark.parametrize("module", ["rtde_control", "rtde_receive", "rtde_io"])
def test_a_missing_sdk_is_one_line(monkeypatch, module):
    arm = Arm()
    monkeypatch.setitem(sys.modules, module, None)
    doubles = {"rtde_control": "open_control", "rtde_receive": "open_receive", "rtde_io": "open_io"}
    given = {option: (lambda *_: arm) for name, option in doubles.items() if name != module}
    with pytest.raises(DefinitionError) as caught:
        UrDriver("ur10.example", **given).connect()
    assert str(caught.value) == "the driver ur needs ur-rtde, which is not installed (pip install 'rgss[ur]')"


@pytest.mark.parametrize(
    ("module", "interface", "doubles"),
    [
        ("rtde_control", "RTDEControlInterface", "setWatchdog servoJ servoStop stopScript disconnect"),
        ("rtde_io", "RTDEIOInterface", "setStandardDigitalOut disconnect"),
        (
            "rtde_receive",
            "RTDEReceiveInterface",
            "getRobotMode getSafetyMode getActualQ getActualQd getTimestamp isEmergencyStopped isConnected disconnect",
        ),
    ],
)
def test_the_sdk_has_what_the_double_has(module, interface, doubles):
    real = getattr(importlib.import_module(module), interface)
    for name in doubles.split():
        assert name in vars(Arm)
        # The binding has no signature but in its docstring: one argument is self.
        first = getattr(real, name).__doc__.splitlines()[0]
        taken = first.partition("(")[2].rpartition(")")[0].replace("list[float]", "list").count(",")
        code = getattr(Arm, name).__code__
        assert taken >= code.co_argcount - 1, first
    if interface == "RTDEControlInterface":
        assert real.servoJ.__doc__.startswith("servoJ(self: rtde_control.RTDEControlInterface, arg0: list[float]")


class Server:
    """The server of the protocol in a process of its own."""

    def __init__(self):
        # Each test process has a loopback address of its own, since the port is fixed.
        self.address = f"127.{1 + os.getpid() % 250}.{os.getpid() // 250 % 250}.7"
        script = Path(__file__).with_name("rtde_server.py")
        self._process = subprocess.Popen(
            [sys.executable, str(script), self.address], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self._process.stdout.readline() == "listening\n"

    def change(self, **values):
        self._process.stdin.write(json.dumps(values) + "\n")
        self._process.stdin.flush()
        assert self._process.stdout.readline() == "changed\n"

    def end(self):
        return json.loads(self._process.communicate()[0])


def test_the_real_sdk_reads_a_server_of_the_protocol():
    server, arm = Server(), Arm()
    joints = [0.1, -1.2, 1.3, -0.4, 0.5, 2.6]
    server.change(**READY, actual_q=joints, actual_qd=[0.01] * 6)
    driver = UrDriver(server.address, open_control=lambda *_: arm, open_io=lambda *_: arm)
    try:
        driver.connect()
        first = driver.read()
        assert first.positions_rad == pytest.approx(joints)
        assert first.velocities_rad_s == pytest.approx((0.01,) * 6)
        assert first.fault == ""
        wait_until(lambda: driver.read().stamp > first.stamp)
        server.change(safety_status_bits=1 << 2)
        wait_until(lambda: driver.read().fault == "the robot is protective stopped")
        server.change(safety_status_bits=1 << 7)
        wait_until(lambda: driver.read().fault == "the robot is emergency stopped")
    finally:
        driver.disconnect()
        told = server.end()
    assert told["unknown"] == []
    assert "".join(told["requests"]).startswith("V")
    assert told["requests"].count("O") == told["requests"].count("S") == 1


def test_the_real_sdk_finds_a_robot_that_is_not_running():
    server = Server()
    server.change(**{**READY, "robot_mode": 3})
    driver = UrDriver(server.address)
    try:
        with pytest.raises(DriverError, match="the robot is in mode 3, not running"):
            driver.connect()
    finally:
        driver.disconnect()
        server.end()


def test_the_real_sdk_finds_nobody():
    with pytest.raises(DriverError, match=r"no RTDE receive interface at 127\.0\.0\.1: .* \(check the address"):
        UrDriver("127.0.0.1").connect()


def test_a_connection_that_fails_to_close_does_not_hide_the_outcome():
    arm = Arm()

    def closing():
        arm.calls.append(("disconnect",))
        raise RuntimeError("boost: broken pipe")

    arm.disconnect = closing
    result = _stream(arm)

    assert result.outcome is StreamOutcome.COMPLETED
    assert arm.calls.count(("disconnect",)) == 3


def test_the_program_on_the_robot_is_stopped_if_the_rest_of_the_connection_fails():
    arm = Arm()
    arm.refused = ("setWatchdog",)
    with pytest.raises(DriverError, match="the UR controller refused setWatchdog"):
        _stream(arm)

    names = [call[0] for call in arm.calls]
    assert names.index("servoStop") < names.index("stopScript") < names.index("disconnect")


def test_modes_that_cannot_be_read_are_an_error_of_the_driver():
    arm = Arm()
    arm.getRobotMode = lambda: 1 / 0
    with pytest.raises(DriverError, match="the UR controller does not report its modes: division by zero"):
        _stream(arm)


def test_velocities_of_other_joints_are_a_fault():
    arm = Arm()
    arm.getActualQd = lambda: [0.0] * 5
    result = _stream(arm)

    assert (result.outcome, result.detail) == (StreamOutcome.FAULT, "the robot reports 5 and 6 joints")
