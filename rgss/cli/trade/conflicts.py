"""Why nothing can be chosen, in the language of requirements, and what would mend it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from rgss.cli.trade.words import moved_limit, percent

if TYPE_CHECKING:
    from rgss.tradeoff import Conflicts, ConflictSurvival, Decision, LimitChange

MOST_LISTED = 6


def print_conflicts(decision: Decision) -> None:
    """Show what each requirement excludes, what cannot be met together, and the cheapest repairs."""
    print("No variant meets every requirement.")
    conflicts = decision.conflicts
    if conflicts is None:
        return
    _print_requirements(decision, conflicts)
    print()
    _print_minimal(conflicts)
    _print_joint_repairs(conflicts)
    nearest = conflicts.nearest
    print(f"\nNearest: variant {nearest.variant}, which violates {', '.join(nearest.requirements)}.")


def _print_requirements(decision: Decision, conflicts: Conflicts) -> None:
    from rgss.cli.output import print_table

    repairs = {repair.requirement: repair for repair in conflicts.repairs}
    rows = []
    for count in conflicts.excluded_by:
        repair = repairs[count.requirement]
        cells = [
            _moved(repair.changes, count.requirement) or "–",
            _winner(repair.winner, repair.unlocked),
        ]
        rows.append([count.requirement, decision.demands[count.requirement], str(count.excluded), *cells])
    print_table(["requirement", "asks for", "excludes", "enough if alone", "then chosen"], rows, right=(2,))


def _print_minimal(conflicts: Conflicts) -> None:
    """All minimal conflicts, and whether each is still there when the replicates are drawn anew."""
    from rgss.cli.output import print_table

    survival = conflicts.survival
    shares = [] if survival is None else [percent(share) for share in survival.conflicts]
    rows = []
    for place, conflict in enumerate(conflicts.minimal_conflicts[:MOST_LISTED]):
        told = " and ".join(conflict) if len(conflict) > 1 else f"{conflict[0]} alone"
        rows.append([told, *shares[place : place + 1]])
    heads = ["no variant meets", *(["survives noise"] if survival is not None else [])]
    print_table(heads, rows, right=(1,))
    _print_more(len(conflicts.minimal_conflicts), complete=conflicts.complete)
    print(_noise(survival))


def _noise(survival: ConflictSurvival | None) -> str:
    if survival is None:
        return "(whether this survives noise takes two replicates of each variant to tell)"
    draws = f"all {survival.resamples}" if survival.exact else f"{survival.resamples:,}"
    return (
        f"(noise: how probably it is so still, by {draws} resamples of the replicates; "
        f"nothing is feasible in {percent(survival.nothing_feasible)})"
    )


def _print_joint_repairs(conflicts: Conflicts) -> None:
    """What has to move together, where no requirement alone is enough."""
    from rgss.cli.output import print_table

    joint = [repair for repair in conflicts.joint_repairs if len(repair.requirements) > 1]
    if not joint:
        return
    rows = []
    for repair in joint[:MOST_LISTED]:
        if not repair.changes:
            rows.append([", ".join(repair.requirements), "– (evidence is missing, no limit is enough)"])
            continue
        moved = [f"{requirement} {_moved(repair.changes, requirement)}" for requirement in repair.requirements]
        rows.append([", ".join(moved), _winner(repair.winner, repair.unlocked)])
    print()
    print_table(["enough together", "then chosen"], rows)
    _print_more(len(joint), complete=True)


def _moved(changes: Iterable[LimitChange], requirement: str) -> str:
    return " and ".join(_needed(change) for change in changes if change.requirement == requirement)


def _needed(change: LimitChange) -> str:
    return moved_limit(change.limit, change.needed, change.unit)


def _winner(variant: int | None, unlocked: int) -> str:
    if variant is None:
        return "–"
    return f"variant {variant}" + (f" of {unlocked} feasible" if unlocked > 1 else "")


def _print_more(count: int, *, complete: bool) -> None:
    more = count - MOST_LISTED
    if more > 0 or not complete:
        print(f"And {more if complete else 'many'} more (--json has them).")
