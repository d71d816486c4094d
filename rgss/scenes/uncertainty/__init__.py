"""Uncertainty: distributions of the quantities that vary from trial to trial, and the draws of a seed."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.uncertainty.declaration import NOTHING_UNCERTAIN, Correlation, Uncertainty, UncertainValue
    from rgss.scenes.uncertainty.distributions import Constant, Discrete, LogNormal, Normal, TruncatedNormal, Uniform
    from rgss.scenes.uncertainty.document import CaseEntry, CorrelationEntry, DistributionEntry, QuantityName
    from rgss.scenes.uncertainty.drawing import draws_of, white_noise
    from rgss.scenes.uncertainty.object_findings import unknown_objects
    from rgss.scenes.uncertainty.quantities import (
        QUANTITIES,
        Application,
        EntersAt,
        UncertainQuantity,
    )
    from rgss.scenes.uncertainty.quantity_names import (
        draw_column,
        in_order,
        object_quantity_name,
        object_quantity_of_column,
        quantity_of,
    )
    from rgss.scenes.uncertainty.reading import read_uncertainty
    from rgss.scenes.uncertainty.workload import ONE_WORKLOAD, Case, Workload
    from rgss.scenes.uncertainty.workload_reading import read_workload
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
