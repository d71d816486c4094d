"""A study's decision under other numbers, weights, limits or simulations."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.decision.what_if.known_suppositions import suppose_known
    from rgss.decision.what_if.modelling import model_settings
    from rgss.decision.what_if.numbers import (
        COST,
        ModelNumber,
        assumed_numbers,
        measures_with,
        symbols_of,
        variant_with,
    )
    from rgss.decision.what_if.readings import Reading, deciding_readings
    from rgss.decision.what_if.remeasured import measured_in
    from rgss.decision.what_if.scenario import Change, Scenario
    from rgss.decision.what_if.shapes import ALL, SHAPE
    from rgss.decision.what_if.simulated import simulated_numbers
    from rgss.decision.what_if.trial_evidence import ScenarioEvidenceReader
    from rgss.decision.what_if.unknown_input import nearest_names
    from rgss.decision.what_if.what_if import PRICES, suppose
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
