"""The chosen grasp in the record of a trial."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from rgss.evidence import Metric
from rgss.scenes import ChosenGrasp, Scene
from rgss.tasks import HandAction, TaskProgram, stages_of
from rgss.trials.phase_result import PhaseResult


def with_chosen_grasp(results: Iterable[PhaseResult], scene: Scene, task: TaskProgram) -> tuple[PhaseResult, ...]:
    """Phases with the chosen grasp among the metrics of each grasp phase; a stated grasp leaves them unchanged."""
    taken = scene.grasps if scene.task.candidates is not None else {}
    of_phase = {
        stage.step.name: _metrics(taken[stage.object])
        for stage in stages_of(task, scene.workpiece.id)
        if stage.step.hand is HandAction.CLOSES and stage.object in taken
    }
    return tuple(
        replace(one, metrics={**one.metrics, **of_phase[one.phase]}) if one.phase in of_phase else one
        for one in results
    )


def _metrics(taken: ChosenGrasp) -> dict[str, Metric]:
    quality: dict[str, Metric] = {"chosen_grasp_opening_m": taken.opening_m, "chosen_grasp_smw_1": taken.quality_1}
    if taken.suction is not None:
        quality = {"chosen_grasp_weight_1": taken.quality_1, "chosen_grasp_room_m": taken.suction.room_m}
    return {
        "chosen_grasp_rank": taken.rejected + 1,
        "chosen_grasp_candidates": taken.candidates,
        **quality,
        "chosen_grasp_com_distance_m": taken.com_distance_m,
        "chosen_grasp_position_m": taken.tool_in_object.position_m,
        "chosen_grasp_quaternion_1": taken.tool_in_object.quaternion_xyzw,
    }
