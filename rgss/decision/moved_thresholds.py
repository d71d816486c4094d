"""Trade-off of a study with moved thresholds of requirements, and with what is anchored on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from rgss.decision.preference_model import anchored_measures, program_of, risks_of, value_function_of
from rgss.errors import DefinitionError, TradeoffError
from rgss.studies import Project
from rgss.tradeoff import Conflicts, JointRepair, LimitChange, Repair, TradeProblem
from rgss.tradeoff.infeasibility import winner_among
from rgss.tradeoff.problem import EvidenceTable, tabulated
from rgss.tradeoff.programs import violations


def with_thresholds(project: Project, thresholds: Mapping[str, float]) -> Project:
    """The project with other thresholds of some requirements.

    Args:
        project: The project.
        thresholds: By requirement, the threshold in the unit of its measure.
    """
    system = tuple(
        replace(
            one,
            criterion=replace(
                one.criterion, threshold=thresholds[one.id], unit=project.measures.measure(one.criterion.measure).unit
            ),
        )
        if one.id in thresholds and one.criterion is not None
        else one
        for one in project.requirements.system
    )
    return replace(project, requirements=replace(project.requirements, system=system))


def problem_with_thresholds(
    project: Project, problem: TradeProblem, table: EvidenceTable, thresholds: Mapping[str, float]
) -> TradeProblem:
    """The trade-off with other thresholds of some requirements; the tolerance and what is anchored on them follow.

    Args:
        project: The project with its study.
        problem: Its trade-off.
        table: The evidence of the trade-off.
        thresholds: By requirement, the threshold as it is required, in the unit of its measure.

    Raises:
        DefinitionError: A threshold lies beyond the other end of a value function that is anchored on it.
        TradeoffError: It lies at that end, or a value is not defined for another reason.
    """
    moved = with_thresholds(project, thresholds)
    functions = tuple(value_function_of(moved, valued) for valued in moved.study.trade_off.valued)
    tolerance = project.study.trade_off.tolerance
    return replace(
        problem,
        alternatives=table,
        thresholds=tuple(
            replace(one, value=thresholds[one.requirement], required=None).tolerated(
                0.0 if one.required is None else tolerance
            )
            if one.requirement in thresholds
            else one
            for one in problem.thresholds
        ),
        value_functions=functions,
        risks=risks_of(moved),
        program=program_of(moved, functions),
        levels=None,
    )


def with_moved_winners(project: Project, problem: TradeProblem, conflicts: Conflicts) -> Conflicts:
    """The conflicts with repairs that name the choice by the values that hold at the limits they need.

    Where a repair moves a limit on which a value is anchored, the value moves too.

    Args:
        project: The project with its study.
        problem: Its trade-off.
        conflicts: Its conflicts, with repairs whose choice is by the present values.

    Returns:
        The conflicts; a repair names no choice where a value is not defined at the limit that it needs.
    """
    anchored = anchored_measures(project)
    table = tabulated(problem.alternatives)

    def winner(repair: Repair | JointRepair) -> int | None:
        if not any(change.requirement in anchored for change in repair.changes):
            return repair.winner
        try:
            moved = problem_with_thresholds(project, problem, table, _needed(repair.changes))
        except (DefinitionError, TradeoffError):
            return None
        feasible = np.asarray(~violations(moved, table).any(axis=1), dtype=np.bool_)
        return winner_among(moved, table, feasible, last_of_equals=project.study.trade_off.last_of_equals)

    return replace(
        conflicts,
        repairs=tuple(replace(one, winner=winner(one)) for one in conflicts.repairs),
        joint_repairs=tuple(replace(one, winner=winner(one)) for one in conflicts.joint_repairs),
    )


def _needed(changes: Sequence[LimitChange]) -> dict[str, float]:
    """The threshold that each requirement needs; of two limits that follow one requirement, the looser."""
    needed: dict[str, LimitChange] = {}
    for change in changes:
        known = needed.get(change.requirement)
        if known is None or abs(change.needed - change.limit) > abs(known.needed - known.limit):
            needed[change.requirement] = change
    return {requirement: change.needed for requirement, change in needed.items()}
