"""Sentences on the sensitivity of a decision that its pages share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rgss.decision.sensitivity import BentEnd, BentValue, Sensitivity, Tornado
from rgss.reports.decision.words import UNKNOWN, amount, moves_text, score, variants_text
from rgss.tradeoff.robustness import KeptAlternative, KeptFor, StakeholderAgreement, StakeholderView

_ALL_TOGETHER = "all together"


@dataclass(frozen=True, slots=True, kw_only=True)
class KeptGroup:
    """Designs that are kept for the same reason.

    Attributes:
        variants: Their ids.
        why: The reason, in words.
        behind: Difference to the value of the best at the study's weights.
    """

    variants: tuple[int, ...]
    why: str
    behind: float


def keep_rule(found: Sensitivity) -> str:
    """Rule by which a design is worth keeping, without a capital and a full stop.

    Args:
        found: The sensitivity, with the margin of the rule; 0 if the study states none.
    """
    weights = "elicited weights" if found.bounded_weights else "weights"
    if found.keep_margin == 0.0:
        return f"best for some {weights}"
    return f"within {found.keep_margin:g} of the best for some {weights}, and no other ahead by more at all weights"


def kept_groups(found: Sensitivity) -> tuple[KeptGroup, ...]:
    """The designs worth keeping, those that do not differ together, the best at the study's weights first."""
    groups: dict[tuple[str, float], list[KeptAlternative]] = {}
    for one in found.kept or ():
        if one.is_kept:
            groups.setdefault((_why(found, one), round(one.behind, 9)), []).append(one)
    made = [
        KeptGroup(variants=tuple(found.variants[one.row] for one in members), why=why, behind=behind)
        for (why, behind), members in groups.items()
    ]
    return tuple(sorted(made, key=lambda group: group.behind))


def beaten_sentences(found: Sensitivity) -> Iterator[str]:
    """One sentence for each design that beats designs which are not kept."""
    beaten: dict[tuple[KeptFor, tuple[int, ...]], list[int]] = {}
    for one in found.kept or ():
        if not one.is_kept:
            rivals = tuple(found.variants[row] for row in one.beaten_by)
            beaten.setdefault((one.reason, rivals), []).append(found.variants[one.row])
    for (reason, rivals), variants in sorted(beaten.items(), key=lambda one: (one[0][1], one[0][0].value)):
        others = variants_text(variants, counted=True)
        if reason is KeptFor.DOMINATED:
            yield f"Variant {rivals[0]} is at least as good at all weights as {others}."
        else:
            several = " or ".join(map(str, rivals))
            yield f"At any weights one of variants {several} beats {others} by more than the margin."


def bend_sentences(bends: Sequence[BentValue]) -> Iterator[str]:
    """Sentences on the effect of bent value functions on the choice."""
    if not bends:
        return
    for bend in bends:
        for end, word in ((bend.convex, "convex"), (bend.concave, "concave")):
            if end.flip is not None:
                yield _flip(bend, end, word)
    steady: dict[tuple[float, float], list[str]] = {}
    for bend in bends:
        if not bend.flips:
            ends = (bend.convex.curvature, bend.concave.curvature)
            steady.setdefault(ends, []).append(bend.measure or _ALL_TOGETHER)
    for (low, high), names in steady.items():
        bent = (
            f"to a risk tolerance of {1.0 / high:.2g} of the range, convex or concave"
            if high == -low
            else f"with a curvature from {low:.2g} to {high:.2g}"
        )
        if len(names) == 1:
            yield f"Bent {bent}, {_bent(names[0])} not change the choice."
        else:
            yield f"Bent {bent}, these value functions do not change the choice: {', '.join(names)}."


def range_sentence(tornado: Tornado) -> str:
    """Sentence on the sources of the ranges."""
    stated = sum(bar.basis.value in ("stated", "cut_stated") for bar in tornado.bars)
    elicited = sum(bar.basis.value == "elicited" for bar in tornado.bars)
    shares = len(tornado.bars) - stated - elicited
    cut = [bar.id for bar in tornado.bars if bar.basis.value.startswith("cut_")]
    smaller = f" Nearer, since beyond it a value function is not defined: {', '.join(cut)}." if cut else ""
    convention = "a share of the value or of the distance of its ends, or a curvature: a convention and no evidence"
    sources = ((stated, "stated"), (elicited, "elicited"), (shares, f"by default {convention}"))
    named = [(number, source) for number, source in sources if number]
    if len(named) == 1:
        return f"Every range is {named[0][1]}.{smaller}"
    (first, source), *rest = named
    others = "".join(f", {number} {source}" for number, source in rest)
    return f"Of the ranges {first} {'is' if first == 1 else 'are'} {source}{others}.{smaller}"


def agreement_sentences(found: Sensitivity) -> Iterator[str]:
    """Sentences on what all stakeholders accept, and on the compromise."""
    agreement = found.agreement
    if agreement is None:
        return
    accepted = [found.variants[row] for row in agreement.accepted_by_all]
    yield (
        f"All accept {variants_text(accepted)}."
        if accepted
        else f"No design is within {found.accept_within:g} of every stakeholder's best value."
    )
    yield from _not_judged(found, agreement)
    if not agreement.compromise:
        yield "There is no compromise: no feasible variant is known in every measure that stakeholders weigh."
        return
    compromise = [found.variants[row] for row in agreement.compromise]
    whose = " and ".join(agreement.most_regretful)
    regret = (
        "nobody has a regret"
        if agreement.largest_regret <= 1e-9
        else f"nobody's regret exceeds {score(agreement.largest_regret)} ({whose})"
    )
    yield f"Compromise by least largest regret: {variants_text(compromise)}; {regret}."
    best = max(float(agreement.borda[row]) for row in range(len(found.variants)) if agreement.borda[row] >= 0.0)
    leaders = [found.variants[row] for row in range(len(found.variants)) if agreement.borda[row] >= best - 1e-9]
    yield f"By ranks (mean Borda score {best:.2f}): {variants_text(leaders)}."


def regret_text(view: StakeholderView, agreement: StakeholderAgreement) -> str:
    """A stakeholder's regret of the compromise, or a dash without one."""
    return score(float(view.regrets[agreement.compromise[0]])) if agreement.compromise else UNKNOWN


def _not_judged(found: Sensitivity, agreement: StakeholderAgreement) -> Iterator[str]:
    """The feasible designs that a stakeholder cannot judge, for which they are not compared over all."""
    for view in agreement.views:
        if view.unknown:
            variants = variants_text([found.variants[row] for row in view.unknown])
            yield f"{view.name} cannot judge {variants}, of which a measure with a weight is unknown."


def _why(found: Sensitivity, one: KeptAlternative) -> str:
    if one.reason is KeptFor.BEST_AS_STATED:
        return "best at the study's weights"
    weights = one.weights if one.weights is not None else found.weights
    before, after = (dict(zip(found.measures, each.tolist(), strict=True)) for each in (found.weights, weights))
    if one.reason is KeptFor.BEST_FOR_SOME:
        return f"best with {moves_text(before, after)}"
    where = "" if one.behind <= found.keep_margin else f" with {moves_text(before, after)}"
    return f"within {found.keep_margin:g} of the best{where}"


def _bent(name: str) -> str:
    """Subject and verb of a sentence on bent value functions: one of a measure, or all."""
    return "all value functions together do" if name == _ALL_TOGETHER else f"the value function of {name} does"


def _flip(bend: BentValue, end: BentEnd, word: str) -> str:
    what = f"the value function of {bend.measure}" if bend.measure else "all value functions together"
    tolerance = (
        "" if end.flip_tolerance is None else f" beyond a risk tolerance of {end.flip_tolerance:.2g} of the range"
    )
    half = "" if end.flip_halfway is None else f" (half of the value at {amount(end.flip_halfway, bend.unit)})"
    lets = "lets" if bend.measure else "let"
    return f"Bent {word}{tolerance}{half}, {what} {lets} {variants_text(end.flip_winners)} win."


def tied_by_weights_sentence(variants: tuple[int, ...]) -> str:
    """Sentence on variants that are worth as much as the choice at the weights of the study alone."""
    are, they = ("is", "it is") if len(variants) == 1 else ("are", "they are")
    names = variants_text(variants)
    return (
        f"At these weights alone {names} {are} worth as much: the least move of weights towards what {they} better in "
        "changes the choice."
    )


def no_rival_clause(tornado: Tornado) -> str:
    """Clause on a choice without a lead over another design: it is alone, or all feasible designs are tied with it."""
    if tornado.tied:
        tied = f"{variants_text(tornado.tied)} {'is' if len(tornado.tied) == 1 else 'are'}"
        return f"every other feasible design is tied with variant {tornado.chosen}: {tied} worth as much"
    return f"variant {tornado.chosen} has no feasible rival, and so no lead"
