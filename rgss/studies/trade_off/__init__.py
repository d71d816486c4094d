"""The ``trade_off`` section of a study: values, weights, programs and their places in the file."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.trade_off.anchored_programs import AnchoredEpsilonConstraint, AnchoredProgram
    from rgss.studies.trade_off.demands import BoundChoice, RequirementBound, RiskChoice
    from rgss.studies.trade_off.document import PortfolioEntry, TradeOffEntry
    from rgss.studies.trade_off.places import TradeOffPlaces
    from rgss.studies.trade_off.reading import read_trade_off
    from rgss.studies.trade_off.sections import TradeOff
    from rgss.studies.trade_off.sensitivity import SensitivityChoice, StatedRange
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
