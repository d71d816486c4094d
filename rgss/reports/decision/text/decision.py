"""Choice, reasons, portfolio and certificate for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.decision.study_decision import SideBySide, StudyDecision
from rgss.reports.decision.conclusion import (
    headline,
    rule_sentence,
    stale_sentence,
    standing_sentence,
    uncertainty_sentences,
)
from rgss.reports.decision.portfolio_sentences import no_portfolio, portfolio_proof
from rgss.reports.decision.sentences import certificate_sentence, notable_checks, reasons
from rgss.reports.decision.text.conflicts import conflict_lines
from rgss.reports.decision.words import score
from rgss.reports.plain_text import aligned_table
from rgss.trace.views import value_in_words
from rgss.tradeoff import PortfolioDecision
from rgss.tradeoff.programs import Certificate


def choice_lines(made: StudyDecision) -> Iterator[str]:
    """The chosen variant beside the runner-up, with reasons; or the conflicts of an infeasible decision."""
    stale = tuple(filter(None, (stale_sentence(made),)))
    if made.comparison is None:
        yield headline(made)
        yield from stale
        yield from conflict_lines(made.decision)
        return
    yield headline(made)
    yield standing_sentence(made)
    yield from stale
    yield rule_sentence(made)
    yield from uncertainty_sentences(made)
    yield ""
    yield from _comparison(made.comparison)
    yield from ("", "Why")
    for reason in reasons(made):
        yield reason.text
        yield from (f"  {detail}" for detail in reason.details)


def certificate_lines(certificate: Certificate) -> Iterator[str]:
    """Lines on the certificate, and on checks that disagree or are by another solver."""
    yield certificate_sentence(certificate)
    yield from notable_checks(certificate.checks)


def portfolio_lines(portfolio: PortfolioDecision) -> Iterator[str]:
    """A portfolio of designs, and the member that serves each study."""
    yield from ("", "Portfolio")
    missing = no_portfolio(portfolio)
    if missing:
        yield missing
        return
    serve = "together serve" if len(portfolio.members) > 1 else "serves"
    yield f"{', '.join(portfolio.members)} {serve} every study; value {value_in_words(portfolio.objective)}."
    rows = [[one.task, one.member, str(one.variant), value_in_words(one.value)] for one in portfolio.assignments]
    yield from aligned_table(["study", "served by", "variant", "value"], rows, right=(2, 3))
    sizes = ", ".join(f"{size}: {value_in_words(best)}" for size, best in enumerate(portfolio.by_size, start=1))
    yield f"Value with at most so many members: {sizes}."
    agrees = portfolio.enumeration_agrees.value
    yield f"Certificate: {portfolio_proof(portfolio)}; enumeration of all portfolios: {agrees}."
    yield from notable_checks(portfolio.checks)


def _comparison(compared: SideBySide) -> list[str]:
    rows = [["variant", "", "", *map(str, compared.variants)]]
    rows += [[row.name, row.unit, "", *map(str, row.cells)] for row in compared.parameters]
    rows += [[row.measure, row.unit, f"{row.weight:.2f}", *map(value_in_words, row.cells)] for row in compared.measures]
    rows.append(["value", "", "", *map(score, compared.values)])
    rows += [[f"{row.place}. {row.name}", "", "", *map(value_in_words, row.cells)] for row in compared.objectives]
    heads = ["chosen", "runner-up"][: len(compared.variants)]
    return aligned_table(["", "unit", "weight", *heads], rows, right=(2, 3, 4))
