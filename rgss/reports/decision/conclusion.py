"""Sentences on the conclusion from the evidence: verdicts on the choice, its probability, ties, more replicates."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rgss.assessment import SeedGroup
from rgss.counted import counted
from rgss.decision.study_decision import Conclusion, DesignStanding, Feasibility, StudyDecision
from rgss.reports.decision.tie_sentences import tie_sentences
from rgss.reports.decision.words import basis_text, share_text, variants_text
from rgss.trace.views import share_in_words
from rgss.tradeoff.robustness import ENOUGH_REPLICATES, FEWEST_AT_THRESHOLD

MOST_NAMED = 8
"""Most requirements of one verdict that are named."""

_UNSEEN = 3.0
"""Expected number of draws of which none is seen with a probability of 5 %, as exp(-3) is 0.05: the rule of three."""


def headline(made: StudyDecision) -> str:
    """Sentences on the choice, and on which designs are shown to meet every requirement.

    Args:
        made: The decision.
    """
    found = made.conclusion
    others = [name for name, ids in (("a test", found.failed.tests), ("a record", found.failed.records)) if ids]
    deciding = " or ".join([", ".join(["a measure", *others[:-1]]), *others[-1:]])
    every = f"every requirement that {deciding} decides" if found.unmeasured else "every requirement"
    name = f"Variant {made.decision.chosen}{', the only one compared,' if made.is_alone else ''}"
    by_estimates = f"{name} is chosen by its estimates"
    feasibility = None if made.decision.chosen is None or found.chosen is None else found.chosen.feasibility
    if feasibility is None:
        whose = "the only one compared does not meet" if made.is_alone else "none meets"
        text = (
            f"No variant is chosen: {whose} every requirement by its {basis_text(shown_feasible=made.shown_feasible)}"
        )
    else:
        text = {
            Feasibility.FEASIBLE: f"{name} is chosen and shown to meet {every}",
            Feasibility.OPEN: f"{by_estimates}, which do not show yet that it meets every requirement",
            Feasibility.INFEASIBLE: f"{by_estimates}, but shown to miss a requirement",
        }[feasibility]
    if made.is_alone:
        parts = [text + _open_by(found, feasibility)]
    else:
        them = "them all" if feasibility is Feasibility.FEASIBLE else every
        parts = [f"{text}{'; ' if feasibility is None else ': '}{_counts(found, them)}"]
    return " ".join((*parts, *_failed(found)))


def _counts(found: Conclusion, every: str) -> str:
    """Numbers of the variants that are shown to meet the requirements, open and infeasible."""
    shown = found.count(Feasibility.FEASIBLE)
    open_, infeasible = found.count(Feasibility.OPEN), found.count(Feasibility.INFEASIBLE)
    by = f" (by {', '.join(found.open_by)})" if found.open_by else ""
    return (
        f"{shown} of {len(found.standings)} {'is' if shown == 1 else 'are'} shown to meet {every}; "
        f"{open_} {'is' if open_ == 1 else 'are'} open{by}, {infeasible} infeasible."
    )


def _open_by(found: Conclusion, feasibility: Feasibility | None) -> str:
    """End of the headline of a single variant: what leaves it open."""
    if not found.open_by:
        return "."
    are = "is" if len(found.open_by) == 1 else "are"
    return f"{'; ' if feasibility is None else ': '}{', '.join(found.open_by)} {are} open."


def _failed(found: Conclusion) -> Iterator[str]:
    """Sentences on the requirements that no design meets, as their tests or records say."""
    if found.failed.tests:
        them = "it" if len(found.failed.tests) == 1 else "them"
        yield f"Tests of {', '.join(found.failed.tests)} failed: no design meets {them}."
    if found.failed.records:
        of, is_one = ", ".join(found.failed.records), len(found.failed.records) == 1
        says, them = ("record of {} says", "it") if is_one else ("records of {} say", "them")
        yield f"The verification {says.format(of)} not met: no design meets {them}."


def rule_sentence(made: StudyDecision) -> str:
    """The rule of the choice."""
    within = "meet every requirement"
    if made.tolerance:
        share = share_text(made.tolerance)
        within = (
            f"miss no threshold on what varies from trial to trial by more than {share} of it, and no other threshold"
        )
    if made.is_alone:
        which = f"it is shown to {within}" if made.shown_feasible else f"its estimates {within}"
        return f"Rule: the variant is chosen if {which}."
    value = "of the highest value" if made.decision.program == "additive" else f"that {made.decision.program} prefers"
    end = "largest" if made.last_of_equals else "smallest"
    with_weight = " with a weight above 0" if made.unweighted else ""
    which = f"that are shown to {within}" if made.shown_feasible else f"whose estimates {within}"
    return (
        f"Rule: of the variants {which}, the one {value} is chosen; of equals one that no other surpasses in the "
        f"quantities of the valued measures{with_weight}, then the {end} id."
    )


def standing_sentence(made: StudyDecision) -> str:
    """The requirements that the choice meets, leaves open, misses and that are not run; empty without a choice.

    Open is what the headline counts as open: inconclusive, or without valid evidence. Not run by trials are those that
    no measure decides, unless a test or a record shows that they are missed.
    """
    chosen = made.conclusion.chosen
    if chosen is None:
        return ""
    open_ = [one + _without(one, chosen) for one in chosen.undecided]
    not_run = [one for one in made.conclusion.unmeasured if one not in chosen.missed]
    why = f", as no measure decides {'it' if len(not_run) == 1 else 'them'}"
    parts = [
        f"{len(named)} {word}" + (f" ({_first_of(named)})" if named else "")
        for named, word in (
            (chosen.met, "met"),
            (open_, "open"),
            (chosen.missed, "missed"),
            (not_run, f"not run by trials{why if not_run else ''}"),
        )
    ]
    return f"Requirements of variant {chosen.variant}: {'; '.join(parts)}."


def stale_sentence(made: StudyDecision) -> str:
    """Requirements with a stale verdict on a design, the command that says why, and the remedy; empty without one."""
    found = made.conclusion
    if not found.stale:
        return ""
    says = "Stale verdicts, which leave designs open, are those on"
    return " ".join((f"{says} {_first_of(found.stale)}.", *found.remedies))


def _first_of(named: Sequence[str]) -> str:
    """The first of some names, and the number of the others."""
    if len(named) <= MOST_NAMED:
        return ", ".join(named)
    return f"{', '.join(named[:MOST_NAMED])} and {len(named) - MOST_NAMED} more"


def _without(requirement: str, chosen: DesignStanding) -> str:
    if requirement in chosen.open:
        return ""
    return " stale" if requirement in chosen.stale else " without valid evidence"


def seeds_sentences(groups: Sequence[SeedGroup]) -> Iterator[str]:
    """The seeds that were read of each variant, with a caution on intervals; empty for fixed replicates.

    Args:
        groups: Variants of equal seeds, the fewest seeds first.
    """
    if not groups:
        return
    yield f"Seeds read: {'; '.join(f'{_seeds_text(one)} of {variants_text(one.variants)}' for one in groups)}."
    if len(groups) > 1 and not any(one.absent for one in groups):
        yield (
            f"Effects of levels are of the {groups[0].replicates} seeds that all variants have; '--replicates "
            f"{groups[0].replicates}' reads these alone."
        )
    if not any(one.added for one in groups):
        return
    yield (
        "Replicates were added where the decision was open; intervals and verdicts allow for it: they hold at any "
        "number of replicates."
    )


def _seeds_text(group: SeedGroup) -> str:
    text = f"{group.first} to {group.last}" if group.first < group.last else f"{group.first}"
    return f"{text} without {', '.join(map(str, group.absent))}" if group.absent else text


def uncertainty_sentences(made: StudyDecision) -> Iterator[str]:
    """Sentences on the probability of the choice, on ties, and on the expected gain of more replicates."""
    found = made.robustness
    weighting = None if found is None else found.analysis.weighting
    if found is None or weighting is None or weighting.uncertainty is None:
        return
    one = weighting.uncertainty
    good = "best"
    if made.practical_margin:
        good = f"the best, or worth less than it by at most the practical margin of {made.practical_margin:g}"
    draws = found.analysis.draws
    feasible = share_of_draws(float(one.feasible[one.chosen]), draws)
    if made.is_alone:
        yield f"Probability that variant {made.decision.chosen} is feasible: {feasible}."
    else:
        yield (
            f"Probability that variant {made.decision.chosen} is feasible and {good}: "
            f"{share_of_draws(one.good, draws)}; that it is feasible: {feasible}; that no variant is feasible: "
            f"{share_of_draws(one.none_feasible, draws)}."
        )
    if made.tolerance:
        yield (
            "Feasible is here what misses no threshold on what varies from trial to trial by more than "
            f"{share_text(made.tolerance)} of it, the tolerance of the choice; verdicts have none. Probability that "
            f"variant {made.decision.chosen} meets every requirement without it: "
            f"{share_of_draws(one.as_required, draws)}."
        )
    if one.scarce:
        follow, were = (
            ("this probability follows", "it was") if made.is_alone else ("these probabilities follow", "they were")
        )
        yield (
            f"At the threshold of {', '.join(one.scarce)}, {counted(made.trials, 'trial')} would have fewer than "
            f"{FEWEST_AT_THRESHOLD:g} failures: so few that {follow} the assumed population of "
            f"designs. In emulated studies of this kind {were} from 0.2 too low to 0.4 too high, and 0.8 too high "
            "where all designs were just below the limit."
        )
    if one.heavy_tailed:
        have = "has" if len(one.heavy_tailed) == 1 else "have"
        yield (
            f"{', '.join(one.heavy_tailed)} {have} rare great values, which fewer than {ENOUGH_REPLICATES} replicates "
            "of the choice or of a tied variant hardly show. In emulated studies of 10 replicates in which 5 % of "
            "times were ten times as long, the first of these probabilities was 0.63 where 0.52 were right."
        )
    if made.is_alone:
        return
    yield from tie_sentences(found, one)
    gains = "; ".join(f"{count} more: {gain:.4f}" for count, gain in one.gains.of_more)
    left_out = (
        " More replicates also narrow the intervals that verdicts need, which is not counted."
        if made.shown_feasible
        else ""
    )
    yield (
        f"Expected gain of value by more replicates of every variant: {gains}; "
        f"by perfect knowledge: {one.gains.perfect:.4f}.{left_out}"
    )


def share_of_draws(share: float, draws: int) -> str:
    """Probability by the share of random draws, such as 94 %; where all or none agree, its 95 % bound.

    Of n draws that all agree, at least 1 - 3/n of the distribution do, with a confidence of 95 %.

    Args:
        share: The share, from 0 to 1.
        draws: Number of draws.
    """
    if 0.0 < share < 1.0 or draws <= 0:
        return share_in_words(share)
    unseen = 100.0 * _UNSEEN / draws
    return f"> {100.0 - unseen:.6g} %" if share >= 1.0 else f"< {unseen:.2g} %"
