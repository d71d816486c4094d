"""Lifecycle of a simulation: initialise, execute, pause, resume, shut down."""

from __future__ import annotations

import threading
from enum import Enum
from types import TracebackType

from rgss.errors import SimulationError
from rgss.evidence import TrialRecord
from rgss.trials.monitors import StepObserver
from rgss.trials.pieces import Pieces, TrialSpec


class SimulationState(str, Enum):
    """State of a simulation."""

    CREATED = "created"
    READY = "ready"
    RUNNING = "running"
    PAUSED = "paused"
    FINISHED = "finished"
    SHUT_DOWN = "shut_down"


class Simulation:
    """Trial that can be paused; a context manager that always shuts down.

    `pause`, `resume` and `shut_down` may be called from another thread or from an observer while `execute` runs. A
    pause takes effect between two steps, which in the kinematic model are whole phases, and does not change results.
    """

    def __init__(self, spec: TrialSpec, *, observer: StepObserver | None = None) -> None:
        """Prepare a trial without computing anything.

        Args:
            spec: The trial.
            observer: Callback after each physics step in contact.
        """
        self._spec = spec
        self._pieces = Pieces(observer=observer, checkpoint=self._wait_while_paused)
        self._lock = threading.Lock()
        self._may_run = threading.Event()
        self._may_run.set()
        self._state = SimulationState.CREATED
        self._executing = False

    @property
    def state(self) -> SimulationState:
        """State of the simulation."""
        return self._state

    def __enter__(self) -> Simulation:
        self.initialise()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.shut_down()

    def initialise(self) -> None:
        """Read the scene into the models and plan and time every move.

        Raises:
            SimulationError: The simulation was initialised before.
        """
        with self._lock:
            self._require(SimulationState.READY, SimulationState.CREATED)
        self._pieces.prepare(self._spec)
        with self._lock:
            if self._state is SimulationState.CREATED:
                self._state = SimulationState.READY

    def execute(self) -> TrialRecord:
        """Run the task; blocks while paused.

        Returns:
            The record, which is independent of pauses.

        Raises:
            SimulationError: The simulation is not initialised, has run, or was shut down meanwhile.
        """
        with self._lock:
            if self._executing or self._state is not SimulationState.PAUSED:
                self._require(SimulationState.RUNNING, SimulationState.READY)
                self._state = SimulationState.RUNNING
            self._executing = True
        try:
            record = self._pieces.record(self._spec)
            self._wait_while_paused()
        except _ShutDownError:
            raise SimulationError(
                "the simulation was shut down before the task was complete", hint="create a new simulation to run it"
            ) from None
        except BaseException:
            self.shut_down()
            raise
        with self._lock:
            if self._state is not SimulationState.SHUT_DOWN:
                self._state = SimulationState.FINISHED
        return record

    def pause(self) -> None:
        """Pause between two steps until `resume`.

        Raises:
            SimulationError: The simulation is neither initialised nor running.
        """
        with self._lock:
            self._require(SimulationState.PAUSED, SimulationState.RUNNING, SimulationState.READY)
            self._state = SimulationState.PAUSED
            self._may_run.clear()

    def resume(self) -> None:
        """Continue after a pause.

        Raises:
            SimulationError: The simulation is not paused.
        """
        with self._lock:
            self._require(SimulationState.RUNNING, SimulationState.PAUSED)
            self._state = SimulationState.RUNNING if self._executing else SimulationState.READY
            self._may_run.set()

    def shut_down(self) -> None:
        """End the simulation, even in the middle of the task, and close the world; calling twice is allowed."""
        with self._lock:
            self._state = SimulationState.SHUT_DOWN
            self._may_run.set()

    def _wait_while_paused(self) -> None:
        self._may_run.wait()
        if self._state is SimulationState.SHUT_DOWN:
            raise _ShutDownError

    def _require(self, state: SimulationState, *before: SimulationState) -> None:
        """Require a state from which a transition is allowed; the lock must be held."""
        if self._state not in before:
            allowed = " or ".join(_shown(allowed) for allowed in before)
            raise SimulationError(
                f"a simulation that is {_shown(self._state)} cannot become {_shown(state)}",
                hint=f"it must be {allowed}",
            )


class _ShutDownError(Exception):
    """Signal that unwinds the task, so that its world is closed."""


def _shown(state: SimulationState) -> str:
    return state.value.replace("_", " ")
