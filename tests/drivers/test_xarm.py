"""The driver of UFACTORY arms, on a double whose calls have the signatures of the real SDK."""

import importlib
import inspect
import sys

import pytest

from rgss.drivers import GripperState, SetPoint, StreamOutcome, StreamSettings, XarmDriver, stream
from rgss.errors import DefinitionError, DriverError
from tests.drivers.conftest import Robot, guard, pick_task


class Api:
    """A controller that follows at once; it reports seven values, as the real one does, whatever its axes are."""

    def __init__(self, axis=3):
        self.connected, self.axis, self.error_code = True, axis, 0
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
    assert {"connected", "axis", "error_code"} <= set(dir(_real()))


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


def test_a_refused_call_names_its_code():
    api = Api()
    driver = _connected(api)
    api.codes["set_servo_angle_j"] = 9
    with pytest.raises(DriverError, match="the xArm controller refused set_servo_angle_j with code 9"):
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


def test_an_arm_that_was_enabled_is_stopped_if_the_connection_fails():
    api = Api()
    api.codes["set_mode"] = 9
    with pytest.raises(DriverError, match="refused set_mode with code 9"):
        _stream(api)

    assert [options or arguments for name, arguments, options in api.calls if name == "set_state"] == [(4,)]
