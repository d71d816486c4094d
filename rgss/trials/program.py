"""The task program: the eight states in their order, on a plant of any fidelity."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from rgss.evidence import Phase
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants import Plant
from rgss.trials.reference import Reference


def run_program(
    plant: Plant, references: Mapping[Phase, Reference], *, checkpoint: Callable[[], None] | None = None
) -> tuple[PhaseResult, ...]:
    """Run the phases in order until one fails or has no motion.

    A phase depends on those before it and on nothing after it, so a trial that ends earlier,
    because a planner found no path in time, has the same results for the phases that it shares.

    Args:
        plant: The machine, not yet started.
        references: Targets of the moves; the program ends before the first move that has none.
        checkpoint: Called before each phase; it may wait, or end the program by raising.

    Returns:
        The phases that ran, in order.
    """
    first = references.get(Phase.MOVE_TO_GRASP)
    if first is None:
        return ()
    plant.start(tuple(first.positions_rad[0].tolist()))
    results: list[PhaseResult] = []
    for phase in Phase:
        if checkpoint is not None:
            checkpoint()
        if phase is Phase.GRASP:
            result = plant.grasp()
        elif phase is Phase.PLACE:
            result = plant.place()
        elif phase in references:
            result = plant.move(phase, references[phase])
        else:
            break
        results.append(result)
        if result.failure is not None:
            break
    return tuple(results)
