"""Portfolios: few designs that serve many tasks."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.portfolio.checks import PortfolioAim
    from rgss.tradeoff.portfolio.decision import Assignment, PortfolioDecision
    from rgss.tradeoff.portfolio.portfolio import decide_portfolio
    from rgss.tradeoff.portfolio.problem import PortfolioProblem, PortfolioTask
    from rgss.tradeoff.portfolio.work import Cut
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
