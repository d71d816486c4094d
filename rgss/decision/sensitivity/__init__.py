"""Sensitivity of a decision: tornado, bent values, exchange rates, kept designs, stakeholders, flat weights."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.decision.sensitivity.analysis import Sensitivity, analyse_sensitivity
    from rgss.decision.sensitivity.bends import BentEnd, BentValue
    from rgss.decision.sensitivity.exchange_rates import BetterDesign, ExchangeRate, ExchangeRates, Worth
    from rgss.decision.sensitivity.flat_weights import FlatRemedy, FlatWeight
    from rgss.decision.sensitivity.inputs import InputKind, RangeBasis
    from rgss.decision.sensitivity.tornado import Tornado, TornadoBar, TornadoEnd
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
