"""Sensitivity of a decision in the document of the HTML report."""

from __future__ import annotations

from rgss.decision.robustness import not_computed_lines
from rgss.decision.sensitivity import Sensitivity, TornadoBar, TornadoEnd
from rgss.reports.decision.exchange_sentences import (
    exchange_rows,
    exchange_sentences,
    exchange_title,
    worth_sentences,
)
from rgss.reports.decision.meanings import meanings
from rgss.reports.decision.sensitivity_sentences import (
    agreement_sentences,
    beaten_sentences,
    bend_sentences,
    keep_rule,
    kept_groups,
    no_rival_clause,
    range_sentence,
    regret_text,
)
from rgss.reports.decision.words import UNKNOWN, amount, ids_text, score, variants_text
from rgss.reports.plain_numbers import Plain, plain_number


def sensitivity_part(found: Sensitivity | None, *, with_noise: bool) -> Plain | None:
    """Content of the section on sensitivity, as the page writes it; None without a choice.

    Args:
        found: The sensitivity of the decision; None if not analysed.
        with_noise: Whether the draws of the decision's robustness include the noise of the trials.
    """
    if found is None or found.refused:
        return None
    tornado, rule = found.tornado, keep_rule(found)
    return {
        "tornado": None
        if tornado is None
        else {
            "chosen": tornado.chosen,
            "lead": score(tornado.lead),
            "rival": tornado.rival,
            "tied": list(tornado.tied),
            "no_rival": no_rival_clause(tornado) if tornado.lead is None else None,
            "has_leads": tornado.has_leads,
            "rows": [_row(bar) for bar in tornado.moving],
            "still": [bar.id for bar in tornado.still],
            "without_range": list(tornado.without_range),
            "ranges": range_sentence(tornado),
        },
        "bends": list(bend_sentences(found.bends)),
        "exchange": _exchange(found),
        "keep_rule": f"{rule[0].upper()}{rule[1:]}.",
        "kept": [
            {"variants": list(group.variants), "why": group.why, "behind": score(group.behind)}
            for group in kept_groups(found)
        ],
        "beaten": list(beaten_sentences(found)),
        "stakeholders": _stakeholders(found),
        "meanings": list(meanings(with_noise=with_noise)),
        "not_computed": list(not_computed_lines(found.not_computed)),
    }


def _exchange(found: Sensitivity) -> Plain | None:
    exchange = found.exchange
    if exchange is None:
        return None
    rows = [
        {
            "measure": row.measure,
            "quantity": row.quantity,
            "step": row.step,
            "worth": row.worth,
            "variant": row.variant,
            "better": row.better,
        }
        for row in exchange_rows(exchange)
    ]
    return {
        "title": exchange_title(exchange),
        "rows": rows,
        "sentences": list(exchange_sentences(exchange)),
        "reference": exchange.reference,
        "worth": worth_sentences(exchange),
    }


def _row(bar: TornadoBar) -> Plain:
    return {
        "input": bar.id,
        "base": amount(bar.base, bar.unit),
        "range_is": bar.basis.value,
        "ends": [_end(bar, end) for end in (bar.low, bar.high)],
        "numbers": _numbers(bar),
    }


def _numbers(bar: TornadoBar) -> Plain:
    """Numbers of a row without units or signs, for the page's CSV."""
    return {
        "unit": "" if bar.unit == "1" else bar.unit,
        "base": plain_number(bar.base),
        "exact": bar.exact,
        "ends": [
            {
                "value": plain_number(end.value),
                "lead": plain_number(end.lead),
                "feasible": end.feasible,
                "flip": plain_number(end.flip),
            }
            for end in (bar.low, bar.high)
        ],
    }


def _end(bar: TornadoBar, end: TornadoEnd) -> Plain:
    about = "" if bar.exact else "≈ "
    return {
        "value": amount(end.value, bar.unit),
        "lead": score(end.lead) if end.feasible else "infeasible",
        "wins": variants_text(end.winners),
        "flip": UNKNOWN if end.flip is None else about + amount(end.flip, bar.unit),
    }


def _stakeholders(found: Sensitivity) -> Plain | None:
    agreement = found.agreement
    if agreement is None:
        return None
    return {
        "within": found.accept_within,
        "rows": [
            {
                "name": view.name,
                "chooses": ids_text(found.variants[row] for row in view.best),
                "value": score(view.best_value),
                "accepts": ids_text(found.variants[row] for row in view.accepted),
                "regret": regret_text(view, agreement),
            }
            for view in agreement.views
        ],
        "sentences": list(agreement_sentences(found)),
    }
