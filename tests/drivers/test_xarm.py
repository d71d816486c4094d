"""The driver of UFACTORY arms: by the real SDK on a server of the protocol, and on a double with its signatures."""

import contextlib
import importlib
import inspect
import os
import socket
import subprocess
import sys

import pytest

from rgss.drivers import GripperState, SetPoint, StreamOutcome, StreamSettings, XarmDriver, stream
from rgss.errors import DefinitionError, DriverError
from tests.drivers.conftest import Robot, guard, limits, pick_task
from tests.drivers.xarm_server import (
    GET_VERSION,
    LITE6,
    MOTION_ENABLE,
    MOVE_SERVO_JOINT,
    SET_MODE,
    SET_STATE,
    WRITE_TOOL_REGISTER,
    XarmServer,
)
from tests.fixtures.processes import wait_until

# Each test process has a loopback address of its own, since the report's port is fixed.
ADDRESS = f"127.{1 + os.getpid() % 250}.{os.getpid() // 250 % 250}.9"
UNHURRIED_S = 30.0


class Api:
    """A controller that follows at once; it reports seven values, as the real one does, whatever its axes are."""

    def __init__(self, axis=3):
        self.connected, self.axis, self.error_code, self.mode = True, axis, 0, 0
        self.calls = []
        self.codes = {}
        self.angles = [0.0] * 7

    def _note(self, name, *arguments, **options):
        self.calls.append((name, arguments, options))
        return self.codes.get(name, 0)

    def get_joint_states(self, is_radian=None, num=3):
        code = self.codes.get("get_joint_states", 0)
        return code, [list(self.angles), [0.0] * 7]

    def set_servo_angle_j(self, angles, is_radian=None):
        self.angles[: len(angles)] = angles
        return self._note("set_servo_angle_j", tuple(angles), is_radian=is_radian)

    def get_err_warn_code(self):
        return self.codes.get("get_err_warn_code", 0), [self.error_code, 0]

    def set_mode(self, mode):
        code = self._note("set_mode", mode)
        self.mode = self.mode if code else mode
        return code

    def set_timeout(self, timeout):
        self.timeout_s = timeout

    def disconnect(self):
        self._note("disconnect")

    def __getattr__(self, name):
        if not hasattr(_real(), name):
            raise AttributeError(name)
        return lambda *arguments, **options: self._note(name, *arguments, **options)


def _real():
    return importlib.import_module("xarm.wrapper").XArmAPI


def _driver(api, **options):
    return XarmDriver("lite6.example", joints=3, open_api=lambda address: api, **options)


def _connected(api, **options):
    driver = _driver(api, **options)
    driver.connect()
    return driver


def _point(gripper=GripperState.OPEN, positions=(0.1, 0.2, 0.3)):
    return SetPoint(positions_rad=positions, velocities_rad_s=(0.0,) * 3, gripper=gripper)


def _names(api):
    return [name for name, _, _ in api.calls]


def _stream(api):
    clock = Robot((0.0,) * 3)
    return stream(_driver(api), pick_task(), guard(), clock, StreamSettings(speed=1.0))


def test_a_task_runs_through_the_calls_of_the_sdk():
    api = Api()
    result = _stream(api)
    assert (result.outcome, result.detail) == (StreamOutcome.COMPLETED, "")
    names = _names(api)
    assert names[:3] == ["motion_enable", "set_mode", "set_state"]
    assert api.calls[1][1:] == ((1,), {})
    assert [name for name in names if "gripper" in name] == ["open_lite6_gripper", "close_lite6_gripper"]
    assert names.count("set_servo_angle_j") == result.sent
    assert api.calls[-2:] == [("set_state", (4,), {}), ("disconnect", (), {})]


def test_every_call_fits_the_signature_of_the_sdk():
    api = Api()
    _stream(api)
    _connected(api).send(_point(GripperState.NEUTRAL))
    seen = set()
    for name, arguments, options in api.calls:
        inspect.signature(getattr(_real(), name)).bind(None, *arguments, **options)
        seen.add(name)
    assert {"set_servo_angle_j", "stop_lite6_gripper", "close_lite6_gripper", "set_state", "disconnect"} <= seen
    inspect.signature(_real().get_joint_states).bind(None, is_radian=True, num=2)
    inspect.signature(_real().get_err_warn_code).bind(None)
    inspect.signature(_real().set_timeout).bind(None, 0.05)
    assert {"connected", "axis", "error_code", "mode"} <= set(dir(_real()))


class Outputs(Api):
    """A controller whose tool outputs the code of the SDK sets."""

    def __init__(self):
        super().__init__()
        self.outputs = {}

    def __getattr__(self, name):
        if name not in ("open_lite6_gripper", "close_lite6_gripper", "stop_lite6_gripper", "set_vacuum_gripper"):
            return super().__getattr__(name)
        api = _real()(do_not_open=True)
        api._arm.set_tgpio_digital = lambda ionum, value, **_: self.outputs.update({ionum: value}) or 0
        # Checks of the connection decorate the methods.
        inner = inspect.unwrap(getattr(type(api._arm), name))
        return lambda *arguments, **options: inner(api._arm, *arguments, **options)


@pytest.mark.parametrize(
    ("is_vacuum", "state", "outputs"),
    [
        (False, GripperState.CLOSED, {0: 0, 1: 1}),
        (False, GripperState.OPEN, {0: 1, 1: 0}),
        (True, GripperState.CLOSED, {0: 1, 1: 0}),
        (True, GripperState.OPEN, {0: 0, 1: 1}),
        (True, GripperState.NEUTRAL, {0: 0, 1: 0}),
        (False, GripperState.NEUTRAL, {0: 0, 1: 0}),
    ],
)
def test_a_vacuum_is_on_where_a_gripper_would_be_closed(is_vacuum, state, outputs):
    """At the same two outputs the SDK's vacuum is on where its gripper is open."""
    api = Outputs()
    _connected(api, is_vacuum=is_vacuum).send(_point(state))
    assert api.outputs == outputs


def test_the_calls_of_a_vacuum_fit_the_signature_of_the_sdk():
    api = Api()
    driver = _connected(api, is_vacuum=True)
    for state in (GripperState.OPEN, GripperState.CLOSED):
        driver.send(_point(state))
    calls = [call for call in api.calls if call[0] == "set_vacuum_gripper"]
    assert [arguments for _, arguments, _ in calls] == [(False,), (True,)]
    for name, arguments, options in calls:
        inspect.signature(getattr(_real(), name)).bind(None, *arguments, **options)


def test_an_error_on_the_way_is_a_fault():
    api = Api()
    driver = _connected(api)
    api.error_code = 31
    assert driver.read().fault == "the controller reports error 31"


def test_the_stamp_counts_replies():
    api = Api()
    driver = _connected(api)
    first = driver.read()
    api.codes["get_joint_states"] = 3
    assert driver.read() == first
    api.codes.clear()
    assert driver.read().stamp == first.stamp + 1


def test_a_controller_that_never_reports_is_an_error():
    api = Api()
    api.codes["get_joint_states"] = 3
    with pytest.raises(DriverError, match=r"does not report its joints \(get_joint_states: code 3\)"):
        _connected(api).read()


def test_what_the_sdk_raises_is_an_error_of_the_driver():
    def fail(address):
        raise Exception("connect socket failed")

    with pytest.raises(DriverError, match=r"no xArm controller answers at x: connect socket failed \(check its"):
        XarmDriver("x", joints=3, open_api=fail).connect()
    api = Api()
    driver = _connected(api)
    api.set_servo_angle_j = fail
    with pytest.raises(DriverError, match="the xArm controller did not take set_servo_angle_j"):
        driver.send(_point())
    api.get_joint_states = fail
    with pytest.raises(DriverError, match="the xArm controller does not report its joints"):
        driver.read()


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("connected", False, "no xArm controller answers at lite6.example"),
        ("axis", 6, "the arm at lite6.example has 6 joints, the task moves 3"),
        ("error_code", 22, "the controller reports error 22"),
    ],
)
def test_an_arm_that_is_not_ready_is_refused(name, value, message):
    api = Api()
    setattr(api, name, value)
    with pytest.raises(DriverError, match=message):
        _driver(api).connect()
    assert api.calls == []


def test_a_call_that_fails_is_named_by_its_code():
    for code, message in ((9, "refused set_servo_angle_j with code 9"), (-1, "closed, set_servo_angle_j was not sent")):
        api = Api()
        driver = _connected(api)
        api.codes["set_servo_angle_j"] = code
        with pytest.raises(DriverError, match=message):
            driver.send(_point())


def test_nothing_can_be_sent_unconnected():
    with pytest.raises(DriverError, match="the xArm controller is not connected"):
        _driver(Api()).send(_point())


def test_a_missing_sdk_is_one_line(monkeypatch):
    monkeypatch.setitem(sys.modules, "xarm.wrapper", None)
    with pytest.raises(DefinitionError) as caught:
        XarmDriver("lite6.example", joints=6).connect()
    assert str(caught.value) == (
        "the driver xarm needs xArm-Python-SDK, which is not installed (pip install 'rgss[xarm]')"
    )


@pytest.mark.parametrize("states", [[], [["a"] * 7, [0.0] * 7]])
def test_joint_states_that_are_none_are_an_error_of_the_driver(states):
    driver = _connected(Api())
    driver._api.get_joint_states = lambda **_: (0, states)
    with pytest.raises(DriverError, match=r"the xArm controller does not report its joints"):
        driver.read()


@pytest.mark.parametrize("takes_time_limit", [True, False])
def test_an_arm_that_was_enabled_is_stopped_if_the_connection_fails(takes_time_limit):
    api = Api()
    api.codes["set_mode"] = 9
    if not takes_time_limit:
        api.set_timeout = None
    with pytest.raises(DriverError, match="refused set_mode with code 9"):
        _stream(api)

    assert [options or arguments for name, arguments, options in api.calls if name == "set_state"] == [(4,)]


@pytest.fixture
def server(monkeypatch):
    """A Lite6 on the loopback, at a free port instead of the privileged one."""
    with XarmServer(ADDRESS) as made:
        ports = importlib.import_module("xarm.core.config.x_config").XCONF.SocketConf
        monkeypatch.setattr(ports, "TCP_CONTROL_PORT", made.control_port)
        yield made
    # The SDK sets it for the whole process.
    socket.setdefaulttimeout(None)


@pytest.fixture
def arm(server):
    """The driver of the Lite6 on the loopback; a loaded machine may answer late."""
    driver = XarmDriver(ADDRESS, joints=6, reply_timeout_s=UNHURRIED_S)
    yield driver
    driver.disconnect()


def test_the_real_sdk_runs_a_task_on_a_server_of_the_protocol(server, arm):
    result = stream(arm, pick_task(6), guard(limits(6)), Robot((0.0,) * 6), StreamSettings(speed=1.0))

    assert (result.outcome, result.detail) == (StreamOutcome.COMPLETED, "")
    assert len(server.points) == result.sent
    assert server.points[-1] == pytest.approx((0.0,) * 7, abs=1e-6)
    assert max(point[0] for point in server.points) == pytest.approx(0.5, abs=1e-6)
    opened = [GET_VERSION, MOTION_ENABLE, SET_MODE, SET_STATE, WRITE_TOOL_REGISTER, WRITE_TOOL_REGISTER]
    assert [asked for asked in server.requests if asked != MOVE_SERVO_JOINT][: len(opened)] == opened
    assert (server.mode, server.state, server.outputs) == (1, 4, [0, 1])


def test_the_real_sdk_reports_joints_and_errors(server, arm):
    server.angles = [0.1, -0.2, 0.3, -0.4, 0.5, -0.6, 0.0]
    arm.connect()
    first = arm.read()
    assert first.positions_rad == pytest.approx((0.1, -0.2, 0.3, -0.4, 0.5, -0.6))
    assert (first.fault, len(first.velocities_rad_s)) == ("", 6)
    assert arm.read().stamp > first.stamp

    server.error = 31
    wait_until(lambda: arm.read().fault == "the controller reports error 31")
    with pytest.raises(DriverError, match="the xArm controller refused stop_lite6_gripper with code 1"):
        arm.send(_point(GripperState.NEUTRAL, (0.1, -0.2, 0.3, -0.4, 0.5, -0.6)))


def test_the_real_sdk_finds_an_error_before_the_first_report(server, arm):
    server.error = 22
    with pytest.raises(DriverError, match=r"the controller reports error 22 \(find its cause"):
        arm.connect()
    assert server.requests == [GET_VERSION]


def test_an_arm_of_other_joints_is_told_by_the_real_sdk(server, arm):
    server.version = LITE6.replace("6,9", "7,13")
    with pytest.raises(DriverError, match="has 7 joints, the task moves 6"):
        arm.connect()


def reports_joints(driver):
    """True once a reply came within the driver's own time limit, which a loaded machine may miss."""
    with contextlib.suppress(DriverError):
        return driver.read().stamp >= 1.0
    return False


def test_a_controller_that_falls_silent_is_no_report_and_takes_nothing(server):
    driver = XarmDriver(ADDRESS, joints=6)
    driver.connect()
    wait_until(lambda: reports_joints(driver))
    server.is_silent = True
    last = driver.read()
    assert driver.read() == last
    with pytest.raises(DriverError, match=r"the xArm controller did not answer stop_lite6_gripper \(check the net"):
        driver.send(_point(GripperState.NEUTRAL, (0.0,) * 6))
    with pytest.raises(DriverError, match="the xArm controller did not answer"):
        driver.stop()
    driver.disconnect()


def test_a_controller_that_stays_in_another_mode_is_refused_and_stopped(server, arm, monkeypatch):
    monkeypatch.setattr("rgss.drivers.xarm._MODE_TIMEOUT_S", 0.1)
    server.takes_modes = False
    with pytest.raises(DriverError, match=r"the controller reports mode 0 instead of servo motion mode \(1\)"):
        arm.connect()
    assert server.state == 4


# In a process of its own: the SDK keeps the standard output that it finds when it is imported.
ALONE = """
import sys
from rgss.drivers import GripperState, SetPoint, XarmDriver
from rgss.drivers.sdk_modules import import_sdk
import_sdk("xarm.core.config.x_config", distribution="", extra="").XCONF.SocketConf.TCP_CONTROL_PORT = int(sys.argv[2])
driver = XarmDriver(sys.argv[1], joints=6, reply_timeout_s=30.0)
driver.connect()
driver.send(SetPoint(positions_rad=(0.1,) * 6, velocities_rad_s=(0.0,) * 6, gripper=GripperState.OPEN))
driver.disconnect()
print("sent")
"""


def test_nothing_of_the_sdk_reaches_the_standard_output(server):
    command = [sys.executable, "-c", ALONE, ADDRESS, str(server.control_port)]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert (ran.returncode, ran.stdout) == (0, "sent\n"), ran.stderr
    assert "ROBOT_IP" in ran.stderr


def test_a_controller_is_found_by_its_name(server, monkeypatch):
    monkeypatch.setattr(socket, "gethostbyname", {"lite6.example": ADDRESS}.__getitem__)
    driver = XarmDriver("lite6.example", joints=6, reply_timeout_s=UNHURRIED_S)
    driver.connect()
    assert len(driver.read().positions_rad) == 6
    driver.disconnect()


def test_a_name_that_nobody_knows_is_one_line(monkeypatch):
    def unknown(name):
        raise socket.gaierror(-2, "Name or service not known")

    monkeypatch.setattr(socket, "gethostbyname", unknown)
    with pytest.raises(
        DriverError, match=r"no xArm controller answers at lite6.example: .*not known \(check its address"
    ):
        XarmDriver("lite6.example", joints=6).connect()
