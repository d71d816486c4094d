"""Motion of the arm under its controller, as the target of contact physics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rgss.tasks import TaskProgram
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants import DynamicPlant
from rgss.trials.program import run_program
from rgss.trials.reference import Reference, ToolPositions, reference_along

Array = NDArray[np.float64]

_OF_THE_ARM = (
    "peak_joint_torque_n_m",
    "peak_joint_torque_ratio",
    "peak_joint_speed_ratio",
    "peak_joint_utilisation",
    "most_loaded_joint",
    "fastest_joint",
    "governing_joint",
    "joint_work_j",
    "joint_net_work_j",
    "joint_saturated_s",
    "tracking_error_m",
)
"""Metrics of a move that only the arm's dynamics give, since contact physics drives the joints as commanded."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ControlledMotion:
    """Motion of the arm under its controller.

    Attributes:
        references: Joint motion of each move that ran, the one that failed too, as targets of contact physics.
        results: Result of each phase in the arm's dynamics, by name.
    """

    references: Mapping[str, Reference]
    results: Mapping[str, PhaseResult]

    def joined(self, contact: tuple[PhaseResult, ...]) -> tuple[PhaseResult, ...]:
        """Results of contact physics, supplemented by those of the arm's dynamics.

        A failure of the arm under its controller is reported unless contact physics failed in an earlier phase: what
        happens to the object in the same one is a consequence.

        Args:
            contact: The phases in contact, in order.
        """
        found: list[PhaseResult] = []
        for result in contact:
            own = self.results[result.phase]
            shown = {name: own.metrics[name] for name in _OF_THE_ARM if name in own.metrics}
            joined = replace(result, metrics={**result.metrics, **shown})
            if own.failure is not None:
                also = "" if result.failure is None or result.detail == own.detail else f"; in contact {result.detail}"
                return (*found, replace(joined, failure=own.failure, detail=f"{own.detail}{also}"))
            found.append(joined)
            if result.failure is not None:
                return tuple(found)
        after = list(self.results.values())[len(found) :]
        return (*found, *after[:1]) if after and after[0].failure is not None else tuple(found)


def controlled_motion(
    plant: DynamicPlant,
    references: Mapping[str, Reference],
    *,
    task: TaskProgram,
    tool: ToolPositions,
    step_s: float,
    gravity_m_s2: float,
) -> ControlledMotion:
    """Motion of the arm under its controller, with the object as a load.

    Contact forces on object and fingers do not act on the arm: its joints are driven along this motion.

    Args:
        plant: The arm with its controller, not yet started.
        references: Targets of the moves.
        task: The task.
        tool: Kinematics of the tool.
        step_s: Length of a physics step.
        gravity_m_s2: Magnitude of gravity.
    """
    results = {result.phase: result for result in run_program(plant, references, task=task)}
    followed: dict[str, Reference] = {}
    at: Array | None = None
    for phase, positions in plant.followed.items():
        # While the hand closes or opens the joints settle further; the move begins at their position in contact
        # physics.
        joined = positions if at is None else positions + _fading(at - positions[0], len(positions))
        followed[phase] = reference_along(joined, tool, step_s=step_s, gravity_m_s2=gravity_m_s2)
        at = joined[-1]
    return ControlledMotion(references=followed, results=results)


def _fading(offset: Array, count: int) -> Array:
    """Offset (n,) that decays to zero over (count, n) positions, with continuous speed at both ends."""
    share = np.linspace(0.0, 1.0, count)
    fade: Array = (1.0 - share**2 * (3.0 - 2.0 * share))[:, None] * offset
    return fade
