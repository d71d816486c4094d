"""A simulation in its user's hands: what may follow what, pausing without a trace, and a world that always closes."""

from __future__ import annotations

import threading
import time
from dataclasses import replace

import pytest

from rgss.errors import DefinitionError, SimulationError
from rgss.evidence import Fidelity, record_digest
from rgss.physics import TorqueArm
from rgss.physics.engine import pybullet
from rgss.trials.lifecycle import Simulation, SimulationState
from rgss.trials.pieces.run import run_trial
from rgss.trials.planning import plan_task
from rgss.trials.timing import TaskTiming
from tests.fixtures.processes import PATIENCE_S

pytestmark = pytest.mark.engine

"""After so long something hangs, however busy the machine is."""


def open_clients() -> int:
    return sum(pybullet().isConnected(client) for client in range(64))


@pytest.fixture(autouse=True)
def no_client_is_left():
    before = open_clients()
    yield
    assert open_clients() == before


@pytest.fixture(scope="module")
def plans():
    """Plans made so far; the same search for every test would be most of their time."""
    return {}


@pytest.fixture(autouse=True)
def plan_once(monkeypatch, plans):
    def cached(cell, planner, *, seed, settings):
        key = (planner, seed, cell.geometry.id, settings)
        if key not in plans:
            plans[key] = plan_task(cell, planner, seed=seed, settings=settings)
        return plans[key]

    monkeypatch.setattr("rgss.trials.planning.plan.plan_task", cached)


@pytest.fixture
def trial(spec_of):
    """Makes a trial of a fidelity."""
    return lambda fidelity=Fidelity.KINEMATIC: replace(spec_of(65), fidelity=fidelity)


class Bystander:
    """Counts the steps and does something at one of them."""

    def __init__(self, at=0, action=None):
        self.steps = 0
        self.at = at
        self.action = action
        self.reached = threading.Event()

    def after_step(self, world, phase, contacts, grip_margin, commanded_force_n):
        self.steps += 1
        if self.steps == self.at:
            self.reached.set()
            if self.action is not None:
                self.action()


class Gate(threading.Event):
    """The event that a simulation waits for between two steps; it says when that is being waited for."""

    def __init__(self):
        super().__init__()
        self.set()
        self.held = threading.Event()

    @classmethod
    def of(cls, simulation):
        gate = simulation._may_run = cls()
        return gate

    def wait(self, timeout=None):
        if not self.is_set():
            self.held.set()
        return super().wait(timeout)

    def wait_until_held(self):
        """Return once the simulation waits between two steps; it makes none before `set`."""
        assert self.held.wait(PATIENCE_S)
        self.held.clear()


class Runner(threading.Thread):
    """Executes a simulation in another thread and keeps what comes of it."""

    def __init__(self, simulation):
        super().__init__(daemon=True)
        self.simulation = simulation
        self.record = None
        self.error = None
        self.start()
        end = time.monotonic() + PATIENCE_S
        while not simulation._executing and self.is_alive():
            assert time.monotonic() < end
            time.sleep(0.001)

    def run(self):
        try:
            self.record = self.simulation.execute()
        except SimulationError as error:
            self.error = error

    def done(self):
        self.join(PATIENCE_S)
        assert not self.is_alive()
        return self


def refusal(action):
    with pytest.raises(SimulationError) as caught:
        action()
    assert "\n" not in str(caught.value)
    return str(caught.value)


def made(spec, state):
    """A simulation in a state."""
    simulation = Simulation(spec)
    if state is not SimulationState.CREATED:
        simulation.initialise()
    if state is SimulationState.PAUSED:
        simulation.pause()
    elif state is SimulationState.FINISHED:
        simulation.execute()
    elif state is SimulationState.SHUT_DOWN:
        simulation.shut_down()
    assert simulation.state is state
    return simulation


@pytest.mark.verifies("SYS-022")
def test_from_the_first_to_the_last_state(trial):
    simulation = Simulation(trial())
    states = [simulation.state]
    simulation.initialise()
    states.append(simulation.state)
    record = simulation.execute()
    states.append(simulation.state)
    simulation.shut_down()
    states.append(simulation.state)
    assert states == [
        SimulationState.CREATED,
        SimulationState.READY,
        SimulationState.FINISHED,
        SimulationState.SHUT_DOWN,
    ]
    assert record.success


@pytest.mark.verifies("SYS-022")
@pytest.mark.parametrize(
    ("state", "action", "text"),
    [
        ("created", "execute", "a simulation that is created cannot become running (it must be ready)"),
        ("created", "pause", "a simulation that is created cannot become paused (it must be running or ready)"),
        ("created", "resume", "a simulation that is created cannot become running (it must be paused)"),
        ("ready", "initialise", "a simulation that is ready cannot become ready (it must be created)"),
        ("ready", "resume", "a simulation that is ready cannot become running (it must be paused)"),
        ("paused", "initialise", "a simulation that is paused cannot become ready (it must be created)"),
        ("paused", "pause", "a simulation that is paused cannot become paused (it must be running or ready)"),
        ("finished", "initialise", "a simulation that is finished cannot become ready (it must be created)"),
        ("finished", "execute", "a simulation that is finished cannot become running (it must be ready)"),
        ("finished", "pause", "a simulation that is finished cannot become paused (it must be running or ready)"),
        ("finished", "resume", "a simulation that is finished cannot become running (it must be paused)"),
        ("shut_down", "initialise", "a simulation that is shut down cannot become ready (it must be created)"),
        ("shut_down", "execute", "a simulation that is shut down cannot become running (it must be ready)"),
        ("shut_down", "pause", "a simulation that is shut down cannot become paused (it must be running or ready)"),
        ("shut_down", "resume", "a simulation that is shut down cannot become running (it must be paused)"),
    ],
)
def test_what_may_not_follow_is_refused_and_changes_nothing(trial, state, action, text):
    simulation = made(trial(), SimulationState(state))
    assert refusal(getattr(simulation, action)) == text
    assert simulation.state is SimulationState(state)


@pytest.mark.parametrize("state", ["created", "ready", "paused", "finished", "shut_down"])
def test_it_may_be_shut_down_at_any_time_and_twice(trial, state):
    simulation = made(trial(), SimulationState(state))
    simulation.shut_down()
    simulation.shut_down()
    assert simulation.state is SimulationState.SHUT_DOWN


def test_a_running_simulation_refuses_to_start_again(trial):
    texts = []

    def try_all():
        texts.append(simulation.state.value)
        texts.extend(refusal(action) for action in (simulation.initialise, simulation.execute, simulation.resume))

    simulation = Simulation(trial(Fidelity.CONTACT), observer=Bystander(5, try_all))
    simulation.initialise()
    assert simulation.execute().success
    assert texts == [
        "running",
        "a simulation that is running cannot become ready (it must be created)",
        "a simulation that is running cannot become running (it must be ready)",
        "a simulation that is running cannot become running (it must be paused)",
    ]


@pytest.mark.verifies("SYS-039")
def test_a_pause_holds_between_two_steps_and_leaves_no_trace(trial):
    spec = trial(Fidelity.CONTACT)
    bystander, may_go_on = Bystander(100), threading.Event()

    def stay_in_the_step():
        may_go_on.wait(PATIENCE_S)
        may_go_on.clear()
        bystander.at += 100

    bystander.action = stay_in_the_step
    with Simulation(spec, observer=bystander) as simulation:
        gate, runner = Gate.of(simulation), Runner(simulation)
        for steps in (100, 200, 300):
            assert bystander.reached.wait(PATIENCE_S)
            bystander.reached.clear()
            simulation.pause()
            may_go_on.set()
            gate.wait_until_held()
            assert (bystander.steps, simulation.state) == (steps, SimulationState.PAUSED)
            assert runner.is_alive()
            simulation.resume()
        bystander.action = None
        may_go_on.set()
        record = runner.done().record
        assert simulation.state is SimulationState.FINISHED
    alone = run_trial(spec)
    assert record_digest(record) == record_digest(alone)
    assert bystander.steps == round(alone.metrics["motion_time_s"] * 240)


def test_an_observer_may_pause(trial):
    bystander = Bystander(50)
    with Simulation(trial(Fidelity.CONTACT), observer=bystander) as simulation:
        bystander.action = simulation.pause
        gate, runner = Gate.of(simulation), Runner(simulation)
        gate.wait_until_held()
        assert (bystander.steps, simulation.state) == (50, SimulationState.PAUSED)
        simulation.resume()
        assert runner.done().record.success


@pytest.mark.parametrize("fidelity", Fidelity)
def test_what_is_paused_before_it_runs_waits_to_be_resumed(trial, fidelity):
    spec = trial(fidelity)
    with Simulation(spec) as simulation:
        gate = Gate.of(simulation)
        simulation.pause()
        runner = Runner(simulation)
        gate.wait_until_held()
        assert runner.is_alive()
        assert simulation.state is SimulationState.PAUSED
        text = "a simulation that is paused cannot become running (it must be ready)"
        assert refusal(simulation.execute) == text
        simulation.resume()
        record = runner.done().record
    assert record_digest(record) == record_digest(run_trial(spec))


def test_what_is_paused_and_resumed_before_it_runs_is_ready(trial):
    with Simulation(trial()) as simulation:
        simulation.pause()
        simulation.resume()
        assert simulation.state is SimulationState.READY
        assert simulation.execute().success


@pytest.mark.verifies("SYS-039")
def test_a_dynamic_simulation_pauses_between_two_steps(trial, monkeypatch):
    spec, steps, step = trial(Fidelity.DYNAMIC), [], TorqueArm.step

    def step_and_pause(machine, torques):
        step(machine, torques)
        steps.append(machine.state())
        if len(steps) == 100:
            simulation.pause()

    with monkeypatch.context() as patch, Simulation(spec) as simulation:
        patch.setattr(TorqueArm, "step", step_and_pause)
        gate, runner = Gate.of(simulation), Runner(simulation)
        gate.wait_until_held()
        assert (len(steps), simulation.state) == (100, SimulationState.PAUSED)
        assert runner.is_alive()
        simulation.resume()
        record = runner.done().record
    assert record_digest(record) == record_digest(run_trial(spec))


def test_shut_down_in_the_middle_ends_the_task_and_closes_the_world(trial):
    before, worlds = open_clients(), []
    bystander = Bystander(50)
    simulation = Simulation(trial(Fidelity.CONTACT), observer=bystander)

    def stop():
        worlds.append(open_clients())
        simulation.shut_down()

    bystander.action = stop
    simulation.initialise()
    text = refusal(simulation.execute)
    assert text == "the simulation was shut down before the task was complete (create a new simulation to run it)"
    assert worlds == [before + 1]
    assert open_clients() == before
    assert bystander.steps == 50
    assert simulation.state is SimulationState.SHUT_DOWN


@pytest.mark.parametrize("fidelity", Fidelity)
def test_shut_down_during_a_pause_ends_the_task(trial, fidelity):
    before = open_clients()
    simulation = Simulation(trial(fidelity))
    simulation.initialise()
    simulation.pause()
    runner = Runner(simulation)
    simulation.shut_down()
    assert runner.done().error.message == "the simulation was shut down before the task was complete"
    assert simulation.state is SimulationState.SHUT_DOWN
    assert open_clients() == before


def test_a_context_shuts_down_also_after_an_error(trial):
    with Simulation(trial()) as simulation:
        assert simulation.state is SimulationState.READY
    assert simulation.state is SimulationState.SHUT_DOWN
    with pytest.raises(RuntimeError, match="stop"), Simulation(trial()) as simulation:
        raise RuntimeError("stop")
    assert simulation.state is SimulationState.SHUT_DOWN


def test_an_observer_that_fails_ends_the_simulation_and_closes_the_world(trial):
    def fail():
        raise RuntimeError("stop")

    before = open_clients()
    simulation = Simulation(trial(Fidelity.CONTACT), observer=Bystander(10, fail))
    simulation.initialise()
    with pytest.raises(RuntimeError, match="stop"):
        simulation.execute()
    assert simulation.state is SimulationState.SHUT_DOWN
    assert open_clients() == before


def test_a_trial_that_cannot_run_ends_the_simulation(trial):
    simulation = Simulation(replace(trial(), planning_limit_s=1e6))
    simulation.initialise()
    with pytest.raises(DefinitionError, match="exceeds the search"):
        simulation.execute()
    assert simulation.state is SimulationState.SHUT_DOWN


def test_what_fails_to_initialise_is_not_ready(trial, monkeypatch):
    simulation = Simulation(trial())
    with monkeypatch.context() as patch:
        patch.setattr(
            "rgss.trials.planning.plan.plan_task", lambda *_, **__: (_ for _ in ()).throw(RuntimeError("no plan"))
        )
        with pytest.raises(RuntimeError, match="no plan"):
            simulation.initialise()
    assert simulation.state is SimulationState.CREATED
    simulation.initialise()
    assert simulation.execute().success


def test_shut_down_while_it_initialises_stays(trial, monkeypatch):
    simulation = Simulation(trial())

    def shut_down(*_, **__):
        simulation.shut_down()
        return TaskTiming(trajectories={}, failures={}, qualities={})

    monkeypatch.setattr("rgss.trials.timing.time_task", shut_down)
    simulation.initialise()
    assert simulation.state is SimulationState.SHUT_DOWN
