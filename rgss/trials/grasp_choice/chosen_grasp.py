"""The chosen grasp in the record of a trial."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace

from rgss.evidence import Metric
from rgss.scenes import ChosenGrasp
from rgss.trials.phase_result import PhaseResult


def with_chosen_grasp(
    results: Iterable[PhaseResult], taken: ChosenGrasp | None, grips: Collection[str]
) -> tuple[PhaseResult, ...]:
    """Phases with the chosen grasp among the metrics of the grasp phase.

    Args:
        results: The phases.
        taken: The chosen grasp; None for a stated grasp, which leaves the phases unchanged.
        grips: Names of the steps that close the hand.
    """
    if taken is None:
        return tuple(results)
    quality: dict[str, Metric] = {"chosen_grasp_opening_m": taken.opening_m, "chosen_grasp_smw_1": taken.quality_1}
    if taken.suction is not None:
        quality = {"chosen_grasp_weight_1": taken.quality_1, "chosen_grasp_room_m": taken.suction.room_m}
    chosen: dict[str, Metric] = {
        "chosen_grasp_rank": taken.rejected + 1,
        "chosen_grasp_candidates": taken.candidates,
        **quality,
        "chosen_grasp_com_distance_m": taken.com_distance_m,
        "chosen_grasp_position_m": taken.tool_in_object.position_m,
        "chosen_grasp_quaternion_1": taken.tool_in_object.quaternion_xyzw,
    }
    return tuple(replace(one, metrics={**one.metrics, **chosen}) if one.phase in grips else one for one in results)
