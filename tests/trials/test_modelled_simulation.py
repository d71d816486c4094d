"""The life of a simulation, and the state machine that the architecture has of it, are one and the same."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from rgss.errors import SimulationError
from rgss.requirements import StateKind, load_requirements
from rgss.trials import lifecycle
from rgss.trials.lifecycle import Simulation, SimulationState
from tests.fixtures.processes import PATIENCE_S

ORDERS = ("initialise", "execute", "pause", "resume", "shut_down")
BEGUN, NOT_BEGUN = "when the task had begun", "when the task had not begun"
SITUATIONS = {
    "created": ("created", NOT_BEGUN),
    "ready": ("ready", NOT_BEGUN),
    "running": ("running", BEGUN),
    "paused before it runs": ("paused", NOT_BEGUN),
    "paused while it runs": ("paused", BEGUN),
    "finished": ("finished", BEGUN),
    "shut down": ("shut_down", NOT_BEGUN),
}


@pytest.fixture(scope="module")
def machine():
    requirements = load_requirements(Path(__file__).parents[2] / "requirements")
    return requirements.element("STM-simulation").machine


@pytest.fixture
def simulation(monkeypatch):
    """A simulation whose task does what the test puts into `during`, and nothing else."""

    class Pieces:
        def __init__(self, *, observer, checkpoint):
            self.checkpoint = checkpoint

        def prepare(self, spec):
            pass

        def record(self, spec):
            self.checkpoint()
            for each in made.during:
                each()
            return "the record"

    monkeypatch.setattr(lifecycle, "Pieces", Pieces)

    class Directed(Simulation):
        during = ()

    made = Directed("a trial")
    return made


def brought_to(simulation, situation, then):
    """Bring a simulation into a situation, do something there, and leave no thread behind."""
    if situation == "shut down":
        simulation.shut_down()
    elif situation != "created":
        simulation.initialise()
    if situation == "paused before it runs":
        simulation.pause()
    if situation == "finished":
        simulation.execute()
    if situation in ("running", "paused while it runs"):
        first = (simulation.pause,) if situation.startswith("paused") else ()
        # Shut down at the end, because what is paused would never end.
        simulation.during = (*first, then, simulation.shut_down)
        with pytest.raises(SimulationError, match="was shut down before the task was complete"):
            simulation.execute()
    else:
        then()


def ordered(simulation, situation, order):
    """The state after an order; None if it is refused."""
    states = []

    def give():
        # What is executed while it is paused waits.
        waits = order == "execute" and situation == "paused before it runs"
        try:
            if waits:
                waiting = threading.Thread(target=run_to_the_end, args=(simulation,))
                waiting.start()
                waiting.join(0.05)
                states.append(simulation.state.value if waiting.is_alive() else "over")
                simulation.shut_down()
                waiting.join(PATIENCE_S)
                assert not waiting.is_alive()
            elif order == "execute" and situation == "ready":
                simulation.during = (lambda: states.append(simulation.state.value),)
                simulation.execute()
            else:
                getattr(simulation, order)()
                states.append(simulation.state.value)
        except SimulationError:
            states.append(None)

    brought_to(simulation, situation, give)
    return states[0]


def run_to_the_end(simulation):
    with pytest.raises(SimulationError):
        simulation.execute()


def modelled(machine, situation, order):
    """What the model says: the state that an order leads to; None if none does."""
    state, begun = SITUATIONS[situation]
    if (state, order) == ("shut_down", "shut_down"):
        return "shut_down"  # what is over stays over
    found = [
        way.target for way in machine.transitions if way.source == state and way.guard in (order, f"{order}, {begun}")
    ]
    assert len(found) <= 1
    return found[0] if found else None


def test_the_states_are_those_of_the_program(machine):
    states = {state.id for state in machine.states if state.kind is not StateKind.INITIAL}
    assert states == {state.value for state in SimulationState}


def test_every_guard_is_an_order_of_the_user_or_the_end_of_the_task(machine):
    guards = [way.guard for way in machine.transitions if way.source != "described"]
    assert {guard.split(",")[0] for guard in guards} == {*ORDERS, "the task is over"}
    conditions = {guard.partition(", ")[2] for guard in guards}
    assert conditions == {"", BEGUN, NOT_BEGUN}


def test_it_begins_as_it_is_made(machine, simulation):
    (start,) = (state.id for state in machine.states if state.kind is StateKind.INITIAL)
    assert [way.target for way in machine.transitions if way.source == start] == [simulation.state.value]


@pytest.mark.verifies("SYS-022")
@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("situation", SITUATIONS)
def test_an_order_leads_where_the_model_says_or_is_refused(machine, simulation, situation, order):
    assert ordered(simulation, situation, order) == modelled(machine, situation, order)


@pytest.mark.verifies("SYS-022")
def test_when_the_task_is_over_it_is_finished(machine, simulation):
    simulation.initialise()
    assert simulation.execute() == "the record"
    (target,) = (way.target for way in machine.transitions if way.guard == "the task is over")
    assert simulation.state.value == target
