"""Hints on the failures of a trial: what to change, and in which file."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.evidence import TrialRecord
    from rgss.studies import Project


def failure_hint(record: TrialRecord, project: Project) -> str:
    """What to change after a failure, with the files; empty for failures whose detail says it.

    Args:
        record: The record of a trial that failed.
        project: The project.
    """
    from rgss.evidence import Failure

    study = project.study
    if record.failure is Failure.PLANNING_LIMIT:
        return (
            f"give the planner more time (what sets planning.time_limit in {study.design_space}), try another planner "
            f"there, lower planning.clearance in {study.label}, or move bodies apart in {study.scene}"
        )
    if record.failure is Failure.TRACKING_ERROR:
        if "torque limit" in record.failure_detail:
            return (
                f"lower the tool's speed (what sets robot.tool_speed in {study.design_space}) or the joints' "
                "accelerations in the robot's file; check the joints' torques there and the masses with rgss robot FILE"
            )
        if "after the move" in record.failure_detail:
            return (
                f"state a larger control.position_tolerance or control.settling_limit in {study.label}, or stiffer "
                "gains there; an object heavier than the controller's model leaves such an error"
            )
        return (
            f"raise physics.solver_iterations or physics.rate in {study.label}, lower the tool's speed (what sets "
            f"robot.tool_speed in {study.design_space}), or state a larger control.tracking_limit in {study.label}"
        )
    return ""
