"""Table of the modelling assumptions: present value, alternative, and the choice under it, in words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rgss.counted import counted
from rgss.decision.assumptions import AssumptionOutcome
from rgss.decision.study_decision import StudyDecision
from rgss.reports.decision.words import UNKNOWN, ids_text

ASSUMPTION_HEADS = ("assumption", "taken as", "instead", "then chosen", "changes the choice")
_FIDELITY = "fidelity"
_READING = "reading."


@dataclass(frozen=True, slots=True, kw_only=True)
class AssumptionRow:
    """A row of the table.

    Attributes:
        title: The assumption in words.
        cells: Its cells, under `ASSUMPTION_HEADS`.
        changes: True if the choice changes; None if that is not known.
        sentence: What is supposed in place of what, and what is then chosen; empty if that is not known.
    """

    title: str
    cells: tuple[str, ...]
    changes: bool | None
    sentence: str = ""


def assumption_rows(made: StudyDecision) -> tuple[AssumptionRow, ...]:
    """The rows of the table, in the order of the questions."""
    return tuple(
        AssumptionRow(
            title=one.question.title,
            cells=(
                one.question.about,
                one.taken_as or UNKNOWN,
                one.question.alternative,
                _choice(one),
                _change(one, made.decision.chosen),
            ),
            changes=None if one.is_same is None else not one.is_same,
            sentence=_sentence(one, made.decision.chosen),
        )
        for one in made.assumptions
    )


def assumption_sentences(made: StudyDecision) -> Iterator[str]:
    """Summary of the table, the command that completes it, and the decision at a lower fidelity."""
    if not made.assumptions:
        return
    known = [one for one in made.assumptions if one.is_same is not None]
    changing = dict.fromkeys((one.question.title, one.question.about) for one in known if not one.is_same)
    if changing:
        yield f"The choice depends on {', '.join(_named(*one) for one in changing)}."
    elif known:
        yield "No assumption whose trials are known changes the choice."
    missing = [one for one in made.assumptions if one.missing]
    if missing:
        trials = sum(one.missing for one in missing)
        yield (
            f"{len(missing)} of {len(made.assumptions)} rows need trials that were not run, {trials} in all: "
            f"'{made.trade_command}' with --what-if \"{missing[0].question.supposition}\" --run runs those of one row, "
            "with --run alone those of all."
        )
    yield from _fidelity_sentences(made)


def _named(title: str, about: str) -> str:
    """An assumption in words, with its name for ``--what-if``."""
    kind = "the reading of " if about.startswith(_READING) else ""
    return f"{kind}“{title}” ({about})" if title else about


def _fidelity_sentences(made: StudyDecision) -> Iterator[str]:
    for one in made.assumptions:
        if one.question.about != _FIDELITY:
            continue
        here, other = one.taken_as, one.question.alternative
        if one.reason:
            if here:
                yield f"Whether {other} trials decide as {here} trials do cannot be known: {one.reason}."
            continue
        if one.missing:
            yield (
                f"Whether {other} trials decide as {here} trials do is not known: {counted(one.missing, 'trial')} "
                f"{'was' if one.missing == 1 else 'were'} not run; '{made.trade_command}' with --what-if "
                f'"{one.question.supposition}" --run runs them.'
            )
            yield from _motion_sentence(one, made.decision.chosen)
            continue
        gained, lost = one.otherwise
        ends = (
            f"{gained + lost} of {one.trials} trials end otherwise ({gained} succeed only as {other} trials, "
            f"{lost} only as {here} trials)"
        )
        if not one.is_same:
            why = f"; {here} trials exclude that by {', '.join(one.excluded_by)}" if one.excluded_by else ""
            then = "nothing" if one.chosen is None else f"variant {one.chosen}"
            yield f"{other.capitalize()} trials decide otherwise, and choose {then}{why}; {ends}."
        elif gained + lost:
            meet = f"meet every requirement{' within the tolerance' if made.tolerance else ''}"
            own = f"{one.otherwise_of_choice or 'none'} of these are trials of the chosen design"
            yield (
                f"{other.capitalize()} trials decide as {here} trials do, although {ends}: {own}. By their estimates "
                f"{one.feasible} designs {meet} in {other} trials, {made.decision.counts.feasible} in {here} "
                "trials."
            )
            yield from _motion_sentence(one, made.decision.chosen)
            yield from _admitted_sentence(one, made.decision.chosen)
        else:
            yield f"{other.capitalize()} trials decide as {here} trials do, because all {one.trials} trials end alike."


def _motion_sentence(one: AssumptionOutcome, chosen: int | None) -> Iterator[str]:
    """The failures that the other fidelity cannot share, for it shares those of planning and timing."""
    found, here = one.in_motion, one.taken_as
    if found is None:
        return
    shared = f"planning and timing, and the failures there, are the same in {one.question.alternative} trials"
    if not found.count:
        yield f"None of the {found.trials} {here} trials fails in motion; {shared}."
        return
    kinds = ", ".join(f"{kind.value.replace('_', ' ')} {count}" for kind, count in found.by_kind.items())
    own = "" if chosen is None else f", {found.of_choice or 'none'} of them of variant {chosen}"
    yield (
        f"Of the {found.trials} {here} trials {found.count} {'fails' if found.count == 1 else 'fail'} in motion "
        f"({kinds}){own}; {shared}."
    )


def _admitted_sentence(one: AssumptionOutcome, chosen: int | None) -> Iterator[str]:
    """The reason why designs that only the other fidelity admits do not win."""
    found, other = one.admitted, one.question.alternative
    if found is None or found.gain >= 0.0 or found.measure is None:
        return
    which = (
        f"The one design that only {other} trials admit, variant {found.best},"
        if found.count == 1
        else f"The best of the {found.count} designs that only {other} trials admit, variant {found.best},"
    )
    yield (
        f"{which} is worth {-found.gain:.4f} less than variant {chosen} there: it loses {found.loss:.4f} by "
        f"{found.measure}."
    )


def _choice(one: AssumptionOutcome) -> str:
    if one.reason:
        return f"no answer: {one.reason}"
    if one.missing:
        return f"needs {one.missing} of {one.trials} trials"
    if one.chosen is None:
        return "nothing is feasible"
    others = ids_text(tuple(variant for variant in one.ties if variant != one.chosen))
    return f"variant {one.chosen}{f' ({others} as good)' if others else ''}, {one.feasible} feasible"


def _sentence(one: AssumptionOutcome, former: int | None) -> str:
    if one.is_same is None:
        return ""
    question, others = one.question, ids_text(tuple(variant for variant in one.ties if variant != one.chosen))
    as_good = f", and {others} as good" if others else ""
    then = "no variant is feasible" if one.chosen is None else f"variant {one.chosen} is chosen{as_good}"
    misses = f"; variant {former} misses {' and '.join(one.missed_by_choice)}" if one.missed_by_choice else ""
    return f"{question.title}: {question.instead} instead of {one.before}. Then {then}{misses}."


def _change(one: AssumptionOutcome, former: int | None) -> str:
    if one.is_same is None:
        return UNKNOWN
    if one.is_unseparated:
        return f"not shown: variant {one.chosen} is not separated from the choice"
    if one.is_same:
        return "no"
    misses = f", as {former} misses {' and '.join(one.missed_by_choice)}" if one.missed_by_choice else ""
    return f"yes, to {'nothing' if one.chosen is None else f'variant {one.chosen}'}{misses}"
