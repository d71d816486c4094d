"""The ``trade_off`` section of a study: values, weights, programs and their places in the file."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.trade_off.document import TradeOffEntry
    from rgss.studies.trade_off.places import TradeOffPlaces
    from rgss.studies.trade_off.programs import as_aim
    from rgss.studies.trade_off.reading import read_trade_off
    from rgss.studies.trade_off.sections import (
        Anchor,
        BoundChoice,
        PortfolioChoice,
        ProgramChoice,
        RequirementAnchor,
        RiskChoice,
        TradeOff,
        ValuedMeasure,
    )
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)

__all__ = [
    "Anchor",
    "BoundChoice",
    "PortfolioChoice",
    "ProgramChoice",
    "RequirementAnchor",
    "RiskChoice",
    "TradeOff",
    "TradeOffEntry",
    "TradeOffPlaces",
    "ValuedMeasure",
    "as_aim",
    "read_trade_off",
]
