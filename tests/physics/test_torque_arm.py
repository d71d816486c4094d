"""The arm under joint torques: energy, weight of what it holds, and a client that is always closed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import SimulationError
from rgss.kinematics import ArmDynamics, gripper_loads, workpiece_load
from rgss.physics import PhysicsSettings, TorqueArm
from rgss.physics.engine import pybullet

pytestmark = pytest.mark.engine

REST = np.zeros(6)
IDLE = [0.0] * 6
GRAVITY_M_S2 = 9.81
# Hanging down and pulled aside: it swings for a second without reaching the end of a joint.
ASIDE_RAD = np.array([0.3, np.pi / 2 - 0.5, 0.3, 0.2, 0.3, 0.0])


def open_clients() -> int:
    return sum(pybullet().isConnected(client) for client in range(64))


@pytest.fixture(autouse=True)
def no_client_is_left():
    before = open_clients()
    yield
    assert open_clients() == before


def arm_of(cell, *, rate_hz=240.0, gravity_m_s2=GRAVITY_M_S2, **robot):
    settings = PhysicsSettings(rate_hz=rate_hz)
    return TorqueArm(replace(cell.scene.robot, **robot), cell.gripper, settings, gravity_m_s2=gravity_m_s2)


def model_of(cell, *, held=False, opening_m=0.07, gravity_m_s2=GRAVITY_M_S2):
    loads = gripper_loads(cell.gripper, opening_m)
    if held:
        loads = (*loads, workpiece_load(cell.scene.workpiece, cell.gripper.geometry.grasp_centre))
    return ArmDynamics(cell.scene.robot, loads, gravity_m_s2=gravity_m_s2)


def mass_matrix(model, q):
    return np.array([model.torques(q, REST, unit) - model.torques(q, REST, REST) for unit in np.eye(6)])


def state_of(machine):
    q, dq = machine.state()
    return np.array(q), np.array(dq)


def swing(cell, rate_hz, gravity_m_s2, *, push_s):
    """Energy after every step of a second without torques, after a push; and the greatest kinetic energy.

    Kinetic energy is by the other engine's mass matrix, potential energy by the work of its weights.
    """
    model = model_of(cell, gravity_m_s2=gravity_m_s2)
    with arm_of(cell, rate_hz=rate_hz, gravity_m_s2=gravity_m_s2) as machine:
        machine.reset(ASIDE_RAD.tolist(), 0.0)
        for _ in range(round(push_s * rate_hz)):
            q, dq = state_of(machine)
            machine.step(model.torques(q, dq, np.array([4.0, 2.0, 2.0, -4.0, 4.0, 8.0])).tolist())
        q, dq = state_of(machine)
        energy, kinetic, potential = [], [0.5 * dq @ mass_matrix(model, q) @ dq], 0.0
        for _ in range(round(rate_hz)):
            machine.step(IDLE)
            last = q
            q, dq = state_of(machine)
            potential += model.torques((last + q) / 2, REST, REST) @ (q - last)
            kinetic.append(0.5 * dq @ mass_matrix(model, q) @ dq)
            energy.append(kinetic[-1] + potential - kinetic[0])
    return np.array(energy), max(kinetic)


@pytest.mark.parametrize(("gravity_m_s2", "push_s"), [(0.0, 0.25), (GRAVITY_M_S2, 0.0)], ids=["pushed", "falling"])
def test_an_arm_without_torques_keeps_its_energy(three_fingers, gravity_m_s2, push_s):
    # The engine's integration is of the first order, so that the error is small and a quarter of it in steps of a
    # quarter; friction, damping or a motor left on would take energy away whatever the step.
    coarse, kinetic = swing(three_fingers, 240.0, gravity_m_s2, push_s=push_s)
    fine, _ = swing(three_fingers, 960.0, gravity_m_s2, push_s=push_s)
    assert kinetic > 2.0
    assert np.max(np.abs(coarse)) < 0.03 * kinetic
    assert np.max(np.abs(fine)) < np.max(np.abs(coarse)) / 3.3


@pytest.mark.parametrize("held", [False, True], ids=["empty", "holding"])
def test_the_torques_of_the_model_hold_the_arm_still(cell, held):
    model = model_of(cell, held=held, opening_m=0.035 if held else 0.07)
    torques = model.torques(cell.grasp_rad, REST, REST).tolist()
    with arm_of(cell) as machine:
        machine.reset(cell.grasp_rad.tolist(), 0.035 if held else 0.0)
        if held:
            machine.attach(cell.scene.workpiece)
        for _ in range(120):
            machine.step(torques)
        q, dq = state_of(machine)
    # An error of the load by a gram would give fifty times as much in this half second.
    assert np.max(np.abs(q - cell.grasp_rad)) < 1e-5
    assert np.max(np.abs(dq)) < 1e-4


def test_what_it_holds_pulls_with_its_weight_until_it_is_let_go(three_fingers):
    cell = three_fingers
    empty, loaded = model_of(cell, opening_m=0.035), model_of(cell, held=True, opening_m=0.035)
    at = cell.grasp_rad
    balance = empty.torques(at, REST, REST)
    weight = loaded.torques(at, REST, REST) - balance
    expected = -np.linalg.solve(mass_matrix(loaded, at), weight)
    assert np.max(np.abs(expected)) > 0.1
    with arm_of(cell) as machine:

        def start():
            machine.reset(at.tolist(), 0.035)
            machine.step(balance.tolist())
            return state_of(machine)[1] * 240.0

        assert start() == pytest.approx(REST, abs=1e-6)
        machine.reset(at.tolist(), 0.035)
        machine.attach(cell.scene.workpiece)
        assert start() == pytest.approx(expected, abs=0.01)
        machine.detach()
        assert start() == pytest.approx(REST, abs=1e-6)
        machine.detach()


def test_what_it_holds_moves_with_the_flange_and_is_gone_afterwards(three_fingers):
    cell = three_fingers
    with arm_of(cell) as machine:
        machine.reset(cell.grasp_rad.tolist(), 0.035)
        engine, client = pybullet(), machine._client
        assert engine.getNumBodies(physicsClientId=client) == 1
        machine.attach(cell.scene.workpiece)
        assert engine.getNumBodies(physicsClientId=client) == 2
        model = model_of(cell, held=True, opening_m=0.035)
        for _ in range(120):
            q, dq = state_of(machine)
            machine.step(model.torques(q, dq, np.array([0.8, 0.4, -0.4, 0.8, 0.8, 1.6])).tolist())
        q, _ = state_of(machine)
        assert np.max(np.abs(q - cell.grasp_rad)) > 0.1
        centre, _ = engine.getBasePositionAndOrientation(machine._held, physicsClientId=client)
        assert cell.arm.tool_pose(q).position_m == pytest.approx(centre, abs=2e-5)
        machine.detach()
        assert engine.getNumBodies(physicsClientId=client) == 1
        assert engine.getNumConstraints(physicsClientId=client) == 0


def test_fingers_stay_where_they_are_put(cell):
    with arm_of(cell) as machine:
        machine.reset(ASIDE_RAD.tolist(), 0.0)
        machine.hold_fingers(0.02)
        for _ in range(60):
            machine.step(IDLE)
        fingers = pybullet().getJointStates(machine._body, machine._fingers, physicsClientId=machine._client)
    assert [finger[0] for finger in fingers] == pytest.approx([0.02] * cell.gripper.geometry.fingers, abs=1e-4)


def test_a_reset_arm_rests_at_its_configuration(three_fingers):
    with arm_of(three_fingers) as machine:
        machine.step([50.0] * 6)
        machine.reset(ASIDE_RAD.tolist(), 0.01)
        q, dq = machine.state()
    assert q == pytest.approx(ASIDE_RAD, abs=1e-12)
    assert dq == (0.0,) * 6


def test_it_opens_one_client_and_closes_it_even_twice(three_fingers):
    before = open_clients()
    with arm_of(three_fingers) as machine:
        assert open_clients() == before + 1
    machine.close()
    assert open_clients() == before


def test_an_exception_in_the_block_closes_the_client(three_fingers):
    before = open_clients()
    with pytest.raises(RuntimeError, match="stop"), arm_of(three_fingers):
        raise RuntimeError("stop")
    assert open_clients() == before


def test_a_broken_urdf_closes_the_client_and_says_why_in_one_line(three_fingers, capfd, monkeypatch):
    monkeypatch.setattr("rgss.physics.torque_arm.assembled_urdf", lambda robot, gripper: "<robot")
    with pytest.raises(SimulationError) as caught:
        arm_of(three_fingers)
    assert caught.value.message.startswith("the physics engine cannot load the robot: ")
    assert "\n" not in str(caught.value)
    assert caught.value.hint == "check its URDF"
    assert capfd.readouterr() == ("", "")


def test_a_refusal_of_the_engine_is_a_simulation_error(three_fingers, monkeypatch):
    def refuse(*_, **__):
        raise pybullet().error("no motors today")

    monkeypatch.setattr(pybullet(), "setJointMotorControlArray", refuse)
    with pytest.raises(SimulationError) as caught:
        arm_of(three_fingers)
    assert (caught.value.message, caught.value.hint) == (
        "the physics engine rejected the arm: no motors today",
        "check the robot",
    )


def test_an_interruption_while_building_closes_the_client(three_fingers, monkeypatch):
    def interrupt(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("rgss.physics.torque_arm.assembled_urdf", interrupt)
    with pytest.raises(KeyboardInterrupt):
        arm_of(three_fingers)
