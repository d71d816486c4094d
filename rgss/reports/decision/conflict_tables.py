"""Tables on the conflicts of requirements of an infeasible decision, the same for a terminal and for Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from rgss.reports.decision.sentences import noise_sentence, unmeasured_sentence
from rgss.reports.decision.words import UNKNOWN, moved_limit
from rgss.trace.views import share_in_words
from rgss.tradeoff import Conflicts, Decision, LimitChange
from rgss.tradeoff.problem import EVIDENCE_PREFIX

MOST_LISTED = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class ConflictTable:
    """A table with the sentences below it.

    Attributes:
        heads: Names of the columns.
        rows: The rows.
        right: Indices of the columns that are aligned at their right.
        notes: Sentences.
    """

    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    right: tuple[int, ...] = ()
    notes: tuple[str, ...] = ()


def conflict_tables(decision: Decision, conflicts: Conflicts) -> Iterator[ConflictTable]:
    """The variants that each requirement excludes, the minimal conflicts, and the repairs of several limits together.

    Args:
        decision: A decision without a choice.
        conflicts: Its conflicts.
    """
    yield _requirements(decision, conflicts)
    yield _minimal(conflicts)
    yield from _joint_repairs(conflicts)


def unmeasured_headline(decision: Decision) -> str:
    """Reason why nothing is chosen where trials give no value of a measure; empty where they do."""
    unknown = set(decision.unmeasured)
    if not unknown:
        return ""
    other = next(one.variant for one in decision.infeasible if set(one.requirements) <= unknown)
    names = " and ".join(one.removeprefix(EVIDENCE_PREFIX) for one in decision.unmeasured)
    by = "" if decision.counts.alternatives == 1 else f", by variant {other} for one"
    return f"No variant can be chosen: the trials give no value of {names}. All else that is asked is met{by}."


def _requirements(decision: Decision, conflicts: Conflicts) -> ConflictTable:
    repairs = {repair.requirement: repair for repair in conflicts.repairs}
    rows = []
    for count in conflicts.excluded_by:
        repair = repairs[count.requirement]
        cells = (_moved(repair.changes, count.requirement) or UNKNOWN, _winner(repair.winner, repair.unlocked))
        rows.append((count.requirement, decision.demands[count.requirement], str(count.excluded), *cells))
    heads = ("requirement", "demands", "excludes", "enough if alone", "then chosen")
    return ConflictTable(heads=heads, rows=tuple(rows), right=(2,))


def _minimal(conflicts: Conflicts) -> ConflictTable:
    """All minimal conflicts, and the share of resamples of the replicates in which each remains."""
    survival = conflicts.survival
    shares = [] if survival is None else [share_in_words(share) for share in survival.conflicts]
    rows = []
    for place, conflict in enumerate(conflicts.minimal_conflicts[:MOST_LISTED]):
        names = " and ".join(conflict) if len(conflict) > 1 else f"{conflict[0]} alone"
        unmeasured = conflict[0] in conflicts.unmeasured
        rows.append((names, *(["no value"] if unmeasured and shares else shares[place : place + 1])))
    return ConflictTable(
        heads=("no variant meets", *(["survives noise"] if survival is not None else [])),
        rows=tuple(rows),
        right=(1,),
        notes=(
            *_more(len(conflicts.minimal_conflicts), complete=conflicts.complete),
            f"({noise_sentence(survival)[:-1]})",
            *([unmeasured_sentence(conflicts.unmeasured)] if conflicts.unmeasured else []),
        ),
    )


def _joint_repairs(conflicts: Conflicts) -> Iterator[ConflictTable]:
    """Limits that have to move together, if no requirement alone is enough."""
    joint = [repair for repair in conflicts.joint_repairs if len(repair.requirements) > 1]
    if not joint:
        return
    rows = []
    for repair in joint[:MOST_LISTED]:
        if not repair.changes:
            rows.append((", ".join(repair.requirements), "– (evidence is missing, no limit is enough)"))
            continue
        moved = [f"{requirement} {_moved(repair.changes, requirement)}" for requirement in repair.requirements]
        rows.append((", ".join(moved), _winner(repair.winner, repair.unlocked)))
    more = tuple(_more(len(joint), complete=True))
    yield ConflictTable(heads=("enough together", "then chosen"), rows=tuple(rows), notes=more)


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
