"""Task program: execution of the steps of a task in order, on a plant of any fidelity."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from rgss.tasks import MoveStep, TaskProgram
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants import Plant
from rgss.trials.reference import Reference


def run_program(
    plant: Plant,
    references: Mapping[str, Reference],
    *,
    task: TaskProgram,
    checkpoint: Callable[[], None] | None = None,
) -> tuple[PhaseResult, ...]:
    """Run the steps in order until one fails or has no targets.

    A step depends only on earlier ones, so that a trial that ends earlier, because a planner found no path in time, has
    the same results for the shared phases.

    Args:
        plant: The plant, not yet started.
        references: Targets of the moves; the program ends before the first move without targets.
        task: The task. Steps before its first move run at the configuration in which that begins.
        checkpoint: Callback before each phase; it may block, or end the program by raising.

    Returns:
        The phases that ran, in order.
    """
    first = references.get(task.moves[0].name)
    if first is None:
        return ()
    plant.start(tuple(first.positions_rad[0].tolist()))
    results: list[PhaseResult] = []
    for step in task.steps:
        if checkpoint is not None:
            checkpoint()
        if not isinstance(step, MoveStep):
            result = step.run(plant)
        elif step.name in references:
            result = plant.move(step, references[step.name])
        else:
            break
        results.append(result)
        if result.failure is not None:
            break
    return tuple(results)
