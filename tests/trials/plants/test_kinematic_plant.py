"""The motion model against the closed form of a damped oscillator; what it cannot know is not in its record."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rgss.evidence import Fidelity
from rgss.scenes import Joint, load_gripper, load_scene
from rgss.scenes.gripper import Gripper
from rgss.trials.pieces.run import run_trial
from rgss.trials.plants.control import ControlSettings
from rgss.trials.plants.kinematic_plant import JointResponse, KinematicPlant
from rgss.trials.reference import Reference
from tests.fixtures.eight_states import Phase, step_of

ROOT = Path(__file__).parents[3]
STEP_S = 1.0 / 240.0
# How each joint takes part in a motion, so that one wrong column shows.
SHARES = np.array([1.0, -0.5, 0.25, 2.0, 0.0, -1.5])
KNOWN = {
    "success",
    "phases_completed",
    "phases_total",
    "planning_time_s",
    "planning_checks",
    "path_length_m",
    "motion_time_s",
    "task_time_s",
    "attempt_time_s",
    "grasp_cycle_time_s",
    "peak_joint_speed_ratio",
    "fastest_joint",
    "path_clearance_min_m",
    "manipulability_min_m3",
    "peak_tool_speed_m_s",
    "peak_tool_acceleration_m_s2",
    "tracking_error_m",
}
JOINTS = tuple(
    Joint(
        name=f"joint_{number}",
        lower_rad=-4.0,
        upper_rad=4.0,
        speed_rad_s=2.0 if number == 4 else 8.0,
        acceleration_rad_s2=10.0,
        torque_n_m=50.0,
    )
    for number in range(1, 7)
)


class Tool:
    """A tool whose coordinates are the angles of three joints in metres; it keeps the configurations it was given."""

    def __init__(self, columns=(0, 1, 2)):
        self.columns = list(columns)
        self.seen = np.zeros((0, 6))

    def tool_position(self, configurations_rad):
        self.seen = np.array(configurations_rad)
        return self.seen[:, self.columns]


def gripper_with(**changes):
    values = {
        "geometry": load_gripper(ROOT / "scenes" / "grippers" / "kg-3.yaml"),
        "base_mass_kg": 0.4,
        "finger_mass_kg": 0.3,
        "finger_velocity_m_s": 0.04,
        "finger_force_n": 10.0,
        "friction": 0.7,
    }
    return Gripper(**(values | changes))


class Grips:
    """One object, round which the hand opens to a radius."""

    def __init__(self, radius_m):
        self.radius_m = radius_m

    def view_of(self, step):
        scene = load_scene(ROOT / "scenes" / "restaurant.yaml")
        shape = replace(scene.workpiece.shape, radius_m=self.radius_m)
        return replace(scene, workpiece=replace(scene.workpiece, shape=shape))


def plant_with(tool=None, *, step_s=STEP_S, response=None, radius_m=0.035, control=None, **gripper):
    return KinematicPlant(
        tool or Tool(),
        JOINTS,
        gripper_with(**gripper),
        Grips(radius_m),
        control or ControlSettings(),
        step_s=step_s,
        response=response,
    )


def reference_from(angle, duration_s, step_s=STEP_S):
    """The targets of a motion of one angle over time, in which each joint has its share."""
    times = np.arange(round(duration_s / step_s) + 1) * step_s
    positions = angle(times)[:, None] * SHARES
    tool_m = positions[:, :3]
    return Reference(
        positions_rad=positions,
        velocities_rad_s=np.diff(positions, axis=0) / step_s,
        tool_m=tool_m,
        load_m_s2=np.full(len(times) - 1, 9.81),
        arc_m=np.zeros((len(times) - 1, 3)),
        peak_tool_speed_m_s=0.0,
        peak_tool_acceleration_m_s2=0.0,
    )


def deviation(response, reference, step_s=STEP_S):
    """Where the joints were, less where they should have been, for the first joint; and the phase's result."""
    tool = Tool()
    result = plant_with(tool, step_s=step_s, response=response).move(step_of(Phase.LIFT), reference)
    rows = len(tool.seen)
    ends = np.repeat(reference.positions_rad[-1:], rows, axis=0)
    wanted = np.vstack([reference.positions_rad, ends])[:rows]
    found = tool.seen - wanted
    assert found == pytest.approx(found[:, :1] * SHARES, abs=1e-12)
    return found[:, 0], result


def ramp(speed_rad_s):
    return lambda times: speed_rad_s * times


def wave(amplitude_rad, frequency_rad_s):
    return lambda times: amplitude_rad * (1.0 - np.cos(frequency_rad_s * times))


@pytest.mark.parametrize("omega", [20.0, 60.0, 150.0])
def test_a_ramp_is_followed_as_a_critically_damped_joint_does(omega):
    # The start of a ramp is a pulse of acceleration over one step; the answer to a step of acceleration is known.
    speed = 0.4
    found, _ = deviation(JointResponse(natural_frequency_rad_s=omega), reference_from(ramp(speed), 0.5))
    times = np.arange(121) * STEP_S

    def step_answer(t):
        late = np.maximum(t, 0.0)
        return (1.0 - (1.0 + omega * late) * np.exp(-omega * late)) / omega**2

    closed = -(speed / STEP_S) * (step_answer(times) - step_answer(times - STEP_S))
    assert found[:121] == pytest.approx(closed, abs=1e-12)


def test_the_ramp_tends_to_its_limit_of_short_steps():
    # With ever shorter steps the pulse becomes a jump of speed: e = -v t exp(-ω t).
    response, speed, worst = JointResponse(natural_frequency_rad_s=60.0), 0.4, []
    for step in (STEP_S / 2, STEP_S / 8, STEP_S / 32):
        found, _ = deviation(response, reference_from(ramp(speed), 0.25, step), step)
        times = np.arange(round(0.25 / step) + 1) * step
        worst.append(float(np.max(np.abs(found[: len(times)] + speed * times * np.exp(-60.0 * times)))))
    assert worst[1] < worst[0] / 3.4
    assert worst[2] < worst[1] / 3.8


@pytest.mark.parametrize("zeta", [0.4, 1.0, 2.5])
@pytest.mark.parametrize("frequency_rad_s", [3.0, 25.0])
def test_a_wave_is_followed_as_the_equation_integrated_by_another_hand(zeta, frequency_rad_s):
    response = JointResponse(natural_frequency_rad_s=50.0, damping_ratio=zeta)
    reference = reference_from(wave(0.3, frequency_rad_s), 1.0)
    found, _ = deviation(response, reference)
    velocity = np.diff(reference.positions_rad[:, 0]) / STEP_S
    acceleration = np.diff(np.concatenate([[0.0], velocity])) / STEP_S
    state, expected = np.zeros(2), [0.0]
    for value in acceleration:
        state = solve_ivp(
            lambda _, e, u: [e[1], -u - 2 * zeta * 50.0 * e[1] - 50.0**2 * e[0]],
            (0.0, STEP_S),
            state,
            args=(value,),
            rtol=1e-9,
            atol=1e-13,
        ).y[:, -1]
        expected.append(state[0])
    assert found[: len(expected)] == pytest.approx(np.array(expected), abs=1e-8)


@pytest.mark.parametrize("rate_hz", [240.0, 960.0])
def test_a_wave_differs_from_the_continuous_equation_by_half_a_step(rate_hz):
    # A mean acceleration that is held over a step comes half a step late, which the deviation then does too.
    step, omega, amplitude, frequency = 1.0 / rate_hz, 50.0, 0.3, 12.0
    found, _ = deviation(
        JointResponse(natural_frequency_rad_s=omega), reference_from(wave(amplitude, frequency), 1.0, step), step
    )
    times = np.arange(round(rate_hz) + 1) * step
    exact = solve_ivp(
        lambda t, e: [e[1], -amplitude * frequency**2 * math.cos(frequency * t) - 2 * omega * e[1] - omega**2 * e[0]],
        (0.0, times[-1]),
        np.zeros(2),
        t_eval=times,
        rtol=1e-10,
        atol=1e-13,
    ).y
    largest = float(np.max(np.abs(found[: len(times)] - exact[0])))
    assert largest < 0.75 * step * float(np.max(np.abs(exact[1])))


def test_a_constant_acceleration_is_trailed_by_its_share_of_the_stiffness():
    found, _ = deviation(JointResponse(natural_frequency_rad_s=80.0), reference_from(lambda t: 0.5 * 2.0 * t**2, 1.0))
    assert found[200] == pytest.approx(-2.0 / 80.0**2, rel=1e-6)


def test_a_move_lasts_until_its_end_is_reached():
    # Braking to the end leaves the joints a / ω² beyond it, from where they come back.
    omega, braking, reached = 8.0, 2.0, 1e-3
    response = JointResponse(natural_frequency_rad_s=omega, reached_rad=reached)
    found, result = deviation(response, reference_from(lambda t: braking * (t - 0.5 * t**2), 1.0))
    greatest = float(np.max(np.abs(SHARES)))
    assert found[240] == pytest.approx(braking / omega**2, rel=0.03)
    assert abs(found[-1]) * greatest <= reached
    assert np.all(np.abs(found[240:-1]) * greatest > reached)
    assert result.duration_s == pytest.approx((len(found) - 1) * STEP_S, abs=1e-12)
    # (1 + ω t) exp(-ω t) falls to reached / (greatest a / ω²) at ω t = 6.1.
    assert result.duration_s == pytest.approx(1.0 + 6.1 / omega, abs=0.03)
    assert (result.failure, result.detail, result.phase) == (None, "", Phase.LIFT)


def test_a_move_that_ends_where_it_should_takes_its_own_time():
    _, result = deviation(None, reference_from(lambda t: 0.1 * np.sin(math.pi * t / 2.0) ** 2, 1.0))
    assert result.duration_s == pytest.approx(1.0, abs=1e-12)


def test_the_wait_for_the_end_is_bounded():
    response = JointResponse(natural_frequency_rad_s=10.0, reached_rad=0.0)
    _, result = deviation(response, reference_from(ramp(0.4), 0.5))
    assert 0.5 < result.duration_s < 0.5 + 2.0 + 2 * STEP_S


def test_a_move_knows_how_the_tool_went_and_no_more():
    omega, speed = 60.0, 0.4
    _, result = deviation(JointResponse(natural_frequency_rad_s=omega), reference_from(ramp(speed), 0.5))
    assert set(result.metrics) == {
        "tracking_error_m",
        "peak_tool_speed_m_s",
        "peak_tool_acceleration_m_s2",
        "peak_joint_speed_ratio",
        "fastest_joint",
    }
    # The fourth joint turns twice as far as the first, and its limit is 2 rad/s.
    assert result.metrics["fastest_joint"] == 4
    assert result.metrics["peak_joint_speed_ratio"] == pytest.approx(speed * (1 + math.exp(-2)), rel=0.01)
    along = float(np.linalg.norm(SHARES[:3]))
    # Of e = -v t exp(-ω t): greatest at 1/ω; the joint is fastest at 2/ω, by v exp(-2) too fast.
    assert result.metrics["tracking_error_m"] == pytest.approx(along * speed / (omega * math.e), rel=0.02)
    assert result.metrics["peak_tool_speed_m_s"] == pytest.approx(along * speed * (1 + math.exp(-2)), rel=0.01)
    assert 0.0 < result.metrics["peak_tool_acceleration_m_s2"] < along * speed / STEP_S


def test_the_deviation_is_of_the_tool_also_after_the_last_target():
    # The joints swing past the end: the greatest deviation comes after the last target.
    response = JointResponse(natural_frequency_rad_s=8.0, damping_ratio=0.1)
    found, result = deviation(response, reference_from(lambda t: 2.0 * t**4, 0.5))
    assert int(np.argmax(np.abs(found))) > 120
    along = float(np.linalg.norm(SHARES[:3]))
    assert result.metrics["tracking_error_m"] == pytest.approx(along * float(np.max(np.abs(found))), rel=1e-9)


def test_the_hand_takes_the_time_of_the_fingers_travel():
    control = replace(ControlSettings(), firm_grasp_s=0.08)
    plant = plant_with(radius_m=0.030, control=control)
    closed, opened = plant.grip(step_of(Phase.GRASP)), plant.release(step_of(Phase.PLACE))
    assert closed.duration_s == pytest.approx(0.040 / 0.04 + 0.08)
    assert opened.duration_s == pytest.approx(0.040 / 0.04)
    assert (closed.phase, closed.metrics) == (Phase.GRASP, {})
    assert (opened.phase, opened.metrics) == (Phase.PLACE, {"opening_s": opened.duration_s})


def test_the_fingers_travel_no_further_than_their_stroke():
    plant = plant_with(radius_m=0.010, finger_velocity_m_s=0.02)
    assert plant.release(step_of(Phase.PLACE)).duration_s == pytest.approx(0.048 / 0.02)


def test_moves_do_not_depend_on_those_before():
    reference = reference_from(wave(0.3, 5.0), 1.0)
    plant = plant_with()
    plant.start((0.0,) * 6)
    first = plant.move(step_of(Phase.LIFT), reference)
    plant.move(step_of(Phase.LIFT), reference_from(ramp(3.0), 0.2))
    plant.grip(step_of(Phase.GRASP))
    assert plant.move(step_of(Phase.LIFT), reference) == first


@pytest.mark.engine
def test_a_record_has_no_value_that_this_fidelity_cannot_know(spec_of):
    spec = replace(spec_of(1), fidelity=Fidelity.KINEMATIC)
    record = run_trial(spec)
    assert (record.success, record.fidelity) == (True, Fidelity.KINEMATIC)
    assert {name for name, value in record.metrics.items() if value is not None} == KNOWN
    allowed = {
        "tracking_error_m",
        "peak_tool_speed_m_s",
        "peak_tool_acceleration_m_s2",
        "peak_joint_speed_ratio",
        "fastest_joint",
        "path_clearance_min_m",
        "manipulability_min_m3",
        "opening_s",
    }
    assert {name for phase in record.phases for name in phase.metrics} == allowed
    # The joints overshoot by less than the tool speed may be exceeded.
    assert record.metrics["peak_tool_speed_m_s"] <= 1.01 * spec.tool_speed_m_s
