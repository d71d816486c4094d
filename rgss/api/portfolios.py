"""Frame of the designs that serve the studies of a portfolio."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.api.trade_frames import portfolio_frame
from rgss.decision import choose_portfolio, measured_studies
from rgss.evidence import EvidenceStore
from rgss.studies import Project

if TYPE_CHECKING:
    import pandas as pd


def portfolio_of_study(project: Project) -> pd.DataFrame:
    """One row for each study of the portfolio, chosen by each study's own evidence.

    Raises:
        DefinitionError: The study has no portfolio.
        EvidenceError: Trials of one of the studies have no evidence.
        TradeoffError: The choice is ill posed.
    """
    with EvidenceStore.open(project.evidence, create=False) as store:
        measured = measured_studies(project, store)
    return portfolio_frame(choose_portfolio(project, measured))
