"""Inputs of other studies that a study does not have, and the reasons."""

from __future__ import annotations

from rgss.decision.what_if.trial_settings import WORKLOAD
from rgss.decision.what_if.unknown_input import UnknownSuppositionError
from rgss.designs import SETTABLE_QUANTITIES
from rgss.studies import Project


def absent_input(project: Project, name: str) -> UnknownSuppositionError | None:
    """Error for a name that a supposition could have in another study; None for any other name.

    Args:
        project: The project with its study.
        name: Name of the input that the study does not have.
    """
    if any(one.id == name and one.criterion is None for one in project.requirements.system):
        return UnknownSuppositionError(
            f"--what-if: {name} has no limit to suppose", hint="what has one names its measure under 'criterion'"
        )
    if name.partition(".")[0] == WORKLOAD and not project.workload.cases:
        if project.study.workload.cases:
            return UnknownSuppositionError(
                f"--what-if: {name}: a nominal study uses no workload", hint="suppose uncertainty.nominal=false first"
            )
        return UnknownSuppositionError(
            f"--what-if: {name}: the study has no workload", hint="state its cases under 'workload' of the study"
        )
    quantity = SETTABLE_QUANTITIES.get(name)
    if quantity is None:
        return None
    for role in project.designs.catalogue.roles:
        for owned, target in role.sets.items():
            if target == name:
                return UnknownSuppositionError(
                    f"--what-if: {name}: designs take it from {owned} of their {role.id}",
                    hint=f"suppose catalogue.COMPONENT.{owned}",
                )
    if any(parameter.sets == name for parameter in project.designs.parameters):
        return UnknownSuppositionError(
            f"--what-if: {name}: designs set it, and it cannot be supposed for all of them together",
            hint="compare the designs: 'rgss variants' lists their values",
        )
    default = f"; its value is that of {quantity.default}" if quantity.default else ""
    return UnknownSuppositionError(
        f"--what-if: {name}: no design sets it{default}",
        hint=f"change it in its file, or let a parameter of the designs set it ('sets: {name}')",
    )
