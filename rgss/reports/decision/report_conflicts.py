"""Conflicts of an infeasible decision, with their repairs, in the document of the HTML report."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence

from rgss.reports.decision.sentences import nearest_sentence, noise_sentence, unmeasured_sentence
from rgss.reports.decision.words import moved_limit
from rgss.reports.plain_numbers import Plain
from rgss.trace.views import rounded_away, share_in_words
from rgss.tradeoff import Conflicts, Decision, JointRepair, LimitChange

MOST_CONFLICTS_LISTED = 12
"""Most conflicts, and most repairs, that are listed."""


def conflict_part(decision: Decision) -> Plain | None:
    """Requirements that cannot be met together, with the probability, and the repairs.

    Returns:
        None if a variant is feasible. Otherwise the conflicts with the probability that each remains
        when the replicates are resampled (None with one replicate), the repairs of all of them, the repair
        by each requirement alone, and the nearest variant.
    """
    conflicts = decision.conflicts
    if conflicts is None:
        return None
    survival = conflicts.survival
    shares: Sequence[float | None] = (
        [None] * len(conflicts.minimal_conflicts) if survival is None else survival.conflicts
    )
    alone = {one.requirement: one for one in conflicts.repairs}
    return {
        "conflicts": [
            {
                "requirements": list(conflict),
                "survives": share,
                "unmeasured": conflict[0] in conflicts.unmeasured,
            }
            for conflict, share in zip(conflicts.minimal_conflicts, shares, strict=True)
        ][:MOST_CONFLICTS_LISTED],
        "more_conflicts": max(0, len(conflicts.minimal_conflicts) - MOST_CONFLICTS_LISTED),
        "complete": conflicts.complete,
        "joint": [_joint(one) for one in _easiest_first(conflicts)[:MOST_CONFLICTS_LISTED]],
        "more_joint": max(0, len(conflicts.joint_repairs) - MOST_CONFLICTS_LISTED),
        "requirements": [
            {
                "requirement": one.requirement,
                "demand": decision.demands[one.requirement],
                "excludes": one.excluded,
                "changes": [_change(change) for change in alone[one.requirement].changes]
                if one.requirement in alone
                else [],
                "unlocked": alone[one.requirement].unlocked if one.requirement in alone else 0,
                "winner": alone[one.requirement].winner if one.requirement in alone else None,
            }
            for one in conflicts.excluded_by
        ],
        "example": _example(conflicts),
        "noise": f"{noise_sentence(conflicts.survival)} {unmeasured_sentence(conflicts.unmeasured)}".strip(),
        "nearest": {"variant": conflicts.nearest.variant, "requirements": list(conflicts.nearest.requirements)},
    }


def conflict_reasons(decision: Decision) -> Iterator[str]:
    """Conflicts in sentences: the most probable one, the smallest repair of all, the nearest variant."""
    conflicts = decision.conflicts
    if conflicts is None:
        return
    survival = conflicts.survival
    for place, conflict in enumerate(conflicts.minimal_conflicts[:MOST_CONFLICTS_LISTED]):
        demands = ", ".join(decision.demands[one] for one in conflict)
        if conflict[0] in conflicts.unmeasured:
            yield f"Nothing is known to meet {conflict[0]} ({demands}). {unmeasured_sentence(conflict)}"
            continue
        text = f"Nothing meets {conflict[0]}" if len(conflict) == 1 else f"{_listed(conflict)} cannot be met together"
        sure = (
            "" if survival is None else f"; so it still is in {share_in_words(survival.conflicts[place])} of resamples"
        )
        yield f"{text} ({demands}){sure}."
    for repair in _easiest_first(conflicts)[:1]:
        if not repair.changes:
            continue
        moved = _listed([f"{one.requirement} to {_needed(one)}" for one in repair.changes])
        feasible = f"{repair.unlocked} variants are feasible, and " if repair.unlocked > 1 else ""
        together = " together" if len(repair.changes) > 1 else ""
        chosen = "" if repair.winner is None else f"; then {feasible}variant {repair.winner} is chosen"
        yield f"The smallest repair: {moved}{together}{chosen}."
    yield nearest_sentence(decision, conflicts)


def _easiest_first(conflicts: Conflicts) -> list[JointRepair]:
    """Repairs that resolve everything, by ascending largest relative change; unknown ones last."""

    def largest(repair: JointRepair) -> float:
        if not repair.changes:
            return float("inf")
        return max(float("inf") if one.relative is None else one.relative for one in repair.changes)

    return sorted(conflicts.joint_repairs, key=largest)


def _joint(repair: JointRepair) -> Plain:
    return {
        "requirements": list(repair.requirements),
        "changes": [_change(change) for change in repair.changes],
        "unlocked": repair.unlocked,
        "winner": repair.winner,
    }


def _change(change: LimitChange) -> Plain:
    return {
        "requirement": change.requirement,
        "demand": change.demand,
        "needed": _needed(change),
        "relative": "" if change.relative is None else share_in_words(change.relative),
    }


def _needed(change: LimitChange) -> str:
    return moved_limit(change.limit, change.needed, change.unit)


def _example(conflicts: Conflicts) -> str:
    """Command that tries the smallest repair of all conflicts; empty if there is none."""
    first = next((one for one in _easiest_first(conflicts) if one.changes), None)
    if first is None:
        return ""
    tried = [
        f"{one.requirement}.threshold={rounded_away(one.limit, one.needed, one.unit):.12g}"
        + ("" if one.unit == "1" else f" {one.unit}")
        for one in first.changes
    ]
    return " ".join(["rgss", "trade", *(f"--what-if {shlex.quote(one)}" for one in tried)])


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
