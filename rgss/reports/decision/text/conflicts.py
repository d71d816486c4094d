"""Conflicts of requirements of an infeasible decision, and the cheapest repairs, for a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rgss.reports.decision.sentences import nearest_sentence, noise_sentence, unmeasured_sentence
from rgss.reports.decision.words import UNKNOWN, basis_text, moved_limit
from rgss.reports.plain_text import aligned_table
from rgss.trace.views import share_in_words
from rgss.tradeoff import Conflicts, Decision, LimitChange
from rgss.tradeoff.problem import EVIDENCE_PREFIX

MOST_LISTED = 6


def conflict_lines(decision: Decision, *, shown_feasible: bool) -> Iterator[str]:
    """Lines on the variants that each requirement excludes, on conflicts, and on the cheapest repairs.

    Args:
        decision: A decision without a choice.
        shown_feasible: Whether verdicts decide what is feasible.
    """
    yield headline(decision, shown_feasible=shown_feasible)
    conflicts = decision.conflicts
    if conflicts is None:
        return
    yield from _requirements(decision, conflicts)
    yield ""
    yield from _minimal(conflicts)
    yield from _joint_repairs(conflicts)
    yield from ("", nearest_sentence(decision, conflicts))


def headline(decision: Decision, *, shown_feasible: bool) -> str:
    """Why nothing is chosen, in a sentence.

    Args:
        decision: A decision without a choice.
        shown_feasible: Whether verdicts decide what is feasible.
    """
    unknown, is_alone = set(decision.unmeasured), decision.counts.alternatives == 1
    if not unknown:
        whose = "The only variant does not meet" if is_alone else "No variant meets"
        return f"{whose} every requirement by its {basis_text(shown_feasible=shown_feasible)}."
    other = next(one.variant for one in decision.infeasible if set(one.requirements) <= unknown)
    names = " and ".join(one.removeprefix(EVIDENCE_PREFIX) for one in decision.unmeasured)
    by = "" if is_alone else f", by variant {other} for one"
    return f"No variant can be chosen: the trials give no value of {names}. All else that is asked is met{by}."


def _requirements(decision: Decision, conflicts: Conflicts) -> list[str]:
    repairs = {repair.requirement: repair for repair in conflicts.repairs}
    rows = []
    for count in conflicts.excluded_by:
        repair = repairs[count.requirement]
        cells = [_moved(repair.changes, count.requirement) or UNKNOWN, _winner(repair.winner, repair.unlocked)]
        rows.append([count.requirement, decision.demands[count.requirement], str(count.excluded), *cells])
    heads = ["requirement", "demands", "excludes", "enough if alone", "then chosen"]
    return aligned_table(heads, rows, right=(2,))


def _minimal(conflicts: Conflicts) -> Iterator[str]:
    """All minimal conflicts, and the share of resamples of the replicates in which each remains."""
    survival = conflicts.survival
    shares = [] if survival is None else [share_in_words(share) for share in survival.conflicts]
    rows = []
    for place, conflict in enumerate(conflicts.minimal_conflicts[:MOST_LISTED]):
        names = " and ".join(conflict) if len(conflict) > 1 else f"{conflict[0]} alone"
        unmeasured = conflict[0] in conflicts.unmeasured
        rows.append([names, *(["no value"] if unmeasured and shares else shares[place : place + 1])])
    heads = ["no variant meets", *(["survives noise"] if survival is not None else [])]
    yield from aligned_table(heads, rows, right=(1,))
    yield from _more(len(conflicts.minimal_conflicts), complete=conflicts.complete)
    yield f"({noise_sentence(survival)[:-1]})"
    if conflicts.unmeasured:
        yield unmeasured_sentence(conflicts.unmeasured)


def _joint_repairs(conflicts: Conflicts) -> Iterator[str]:
    """Limits that have to move together, if no requirement alone is enough."""
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
    yield ""
    yield from aligned_table(["enough together", "then chosen"], rows)
    yield from _more(len(joint), complete=True)


def _moved(changes: Iterable[LimitChange], requirement: str) -> str:
    return " and ".join(
        moved_limit(change.limit, change.needed, change.unit) for change in changes if change.requirement == requirement
    )


def _winner(variant: int | None, unlocked: int) -> str:
    if variant is None:
        return UNKNOWN
    return f"variant {variant}" + (f" of {unlocked} feasible" if unlocked > 1 else "")


def _more(count: int, *, complete: bool) -> Iterator[str]:
    more = count - MOST_LISTED
    if more > 0 or not complete:
        yield f"And {more if complete else 'many'} more (--json has them)."
