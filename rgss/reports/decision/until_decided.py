"""Result of replication until decided in sentences, with what remains open."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.counted import counted
from rgss.decision import UntilDecided
from rgss.reports.decision.conclusion import share_of_draws
from rgss.reports.decision.words import ids_text
from rgss.tradeoff.robustness import DRAWS
from rgss.tradeoff.sequential import MOST_FORECAST, Forecast, Reason

_ROUND_TO = 50


def until_decided_summary(result: UntilDecided) -> str:
    """Result in one line.

    Args:
        result: The result of the replication.
    """
    share_percent = 100.0 * result.total / (len(result.trials) * result.rule.cap)
    chosen = "no variant" if result.variant is None else f"variant {result.variant}"
    others = len(set(result.contenders) - {result.variant})
    nearly = f", {others} of the others may equal it within {result.rule.margin:g}" if others else ""
    ended = {
        Reason.DECIDED: f"decided at an error rate of {result.rule.error_rate:g}{nearly}",
        Reason.CAP: f"cap reached with {len(result.contenders)} contenders",
        Reason.BUDGET: f"budget of {result.rule.budget} trials{_reserve(result)} spent",
        Reason.NO_VALUE: f"ended, as no trial gives a value of {' or '.join(result.valueless)}",
    }[result.reason]
    inconclusive = f"; inconclusive: {', '.join(result.open_requirements)}" if result.open_requirements else ""
    return (
        f"{chosen}: {ended}, probability of good selection {share_of_draws(result.probability, DRAWS)}{inconclusive}; "
        f"{result.total} trials in {result.looks} looks, "
        f"{share_percent:.0f} % of the cap of {result.rule.cap} for each variant"
    )


def _reserve(result: UntilDecided) -> str:
    spent, most = result.reserve_spent, result.rule.reserve
    return f" and {spent} of a reserve of {most}" if most is not None and spent else ""


def open_paragraph(result: UntilDecided, *, command: str) -> str:
    """Open questions at the end of replication, what would settle them, and the command; empty if decided.

    Args:
        result: The result of the replication.
        command: The command that goes on, to which an option is appended.
    """
    if result.reason is Reason.DECIDED:
        return ""
    if result.reason is Reason.NO_VALUE:
        return _no_value(result)
    return " ".join([*_open(result), _advice(result, command)])


def _no_value(result: UntilDecided) -> str:
    limited = f", which {' and '.join(result.unobserved)} limit{'' if result.unobserved[1:] else 's'}"
    what = f"{' and '.join(result.valueless)}{limited if result.unobserved else ''}"
    trials = f"{counted(result.total, 'trial')}, of which {result.succeeded or 'none'} succeeded"
    remedy = (
        "Trials at this fidelity do not observe it, so that more of them do not help; another fidelity or another "
        "measure does."
        if result.succeeded
        else "'rgss measure' counts the reasons of the failures."
    )
    return f"Without a value of {what}, no variant can be chosen. There are {trials}. {remedy}"


def _open(result: UntilDecided) -> Iterator[str]:
    if result.unobserved:
        yield (
            f"No trial so far gives a value that {' or '.join(result.unobserved)} limits, so that no variant can be "
            "chosen. Where trials at this fidelity do not observe it, more of them do not help."
        )
        return
    if result.variant is None:
        yield (
            "No variant meets every requirement by its estimates; of "
            f"{_variants(result.contenders)} it is not proven that they miss one."
        )
        return
    parts = []
    if result.unsettled:
        are = "is" if len(result.unsettled) == 1 else "are"
        parts.append(
            f"that {_variants(result.unsettled)} {are} worth at most {result.rule.margin:g} more than variant "
            f"{result.variant}"
        )
    found = result.forecast
    if found is not None and found.requirements:
        needs = ", ".join(f"{name} ({_replicates(count)})" for name, count in sorted(found.requirements.items()))
        ran = result.trials[result.variant]
        parts.append(f"that variant {result.variant}, which has {ran} replicates, meets {needs}")
    elif not parts:
        parts.append(f"that variant {result.variant} keeps every requirement within the slack")
    yield (
        f"Not proven at an error rate of {result.rule.error_rate:g} over all looks, a stricter standard than the "
        f"probability above: {'; '.join(parts)}."
    )


def _replicates(count: int | None) -> str:
    return f"more than {MOST_FORECAST} replicates" if count is None else f"about {count} replicates"


def _variants(ids: tuple[int, ...]) -> str:
    return f"variant {ids[0]}" if len(ids) == 1 else f"variants {ids_text(ids)}"


def _advice(result: UntilDecided, command: str) -> str:
    found = result.forecast
    if found is None:
        return f"To go on where it stopped, type '{command} {_raised(result, result.total)}'."
    if found.trials is None:
        return (
            f"If trials go on as so far, {MOST_FORECAST} replicates do not settle all of it: accept the tie, widen "
            f"until_decided.margin, or go on with '{command} {_raised(result, result.total)}'."
        )
    name, option = "cap" if result.reason is Reason.CAP else "budget", _raised(result, found.trials)
    most = _most_of_a_variant(found)
    if result.reason is not Reason.CAP and most > result.rule.cap:
        # A budget alone would end at the cap; what the pages read ends at that of the study.
        name, option = "budget and until_decided.cap, as no page reads more of a variant", f"{option} --cap {most}"
    return (
        f"If trials go on as so far, some {_rounded(found.trials)} more trials settle the decision"
        f"{_beyond_cap(result, found)}; to go on where it stopped, type "
        f"'{command} {option}', or raise until_decided.{name}."
    )


def _raised(result: UntilDecided, more: int) -> str:
    """Option that allows so many more trials."""
    if result.reason is Reason.CAP:
        return f"--cap {2 * result.rule.cap}"
    return f"--budget {_rounded(result.total + more)}"


def _beyond_cap(result: UntilDecided, found: Forecast) -> str:
    most = _most_of_a_variant(found)
    return f" (up to {most} of a variant, more than the cap of {result.rule.cap})" if most > result.rule.cap else ""


def _most_of_a_variant(found: Forecast) -> int:
    return max([count or 0 for count in (found.accepted, *found.rivals.values())])


def _rounded(trials: int) -> int:
    return max(_ROUND_TO, -(-trials // _ROUND_TO) * _ROUND_TO)
