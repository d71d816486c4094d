"""Sentences on the choice of a portfolio."""

from __future__ import annotations

from rgss.trace.views import value_in_words
from rgss.tradeoff import DecisionStatus, PortfolioDecision


def no_portfolio(portfolio: PortfolioDecision) -> str:
    """Reason why there is no portfolio; empty if there is one.

    Args:
        portfolio: The choice of a portfolio.
    """
    if portfolio.objective is not None:
        return ""
    if portfolio.status is DecisionStatus.UNDECIDED:
        return f"No portfolio that serves every study was found{_cut(portfolio)}; there may be one."
    return (
        f"No portfolio of this size serves every study; unserved by itself: {', '.join(portfolio.unserved) or 'none'}."
    )


def portfolio_proof(portfolio: PortfolioDecision) -> str:
    """Sentence on the proof that a portfolio is best, or on the bound of the gap.

    Args:
        portfolio: The choice of a portfolio.
    """
    if portfolio.status is DecisionStatus.BEST_FOUND:
        gap = value_in_words(portfolio.gap)
        return f"best found, not proven best: another one can be better by at most {gap}{_cut(portfolio)}"
    return (
        "proven best" if portfolio.cut is None else f"proven best; of fewer members not every value is{_cut(portfolio)}"
    )


def _cut(portfolio: PortfolioDecision) -> str:
    return "" if portfolio.cut is None else f" ({portfolio.cut.value})"
