"""Robustness of a study's decision: weights, assumptions, effects and noise."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.decision.robustness.assumptions import AssumptionFinding
    from rgss.decision.robustness.cost_box import CostBox
    from rgss.decision.robustness.effect_findings import FactorLevels, MeasureEffects, StudyEffects, leading_factors
    from rgss.decision.robustness.findings import RequirementPrice, Robustness, WeightRobustness
    from rgss.decision.robustness.parts import NotComputed, Part, PartComputer, not_computed_lines
    from rgss.decision.robustness.remeasuring import Remeasuring
    from rgss.decision.robustness.robustness import analyse_robustness
    from rgss.decision.robustness.rules import allowed_variants
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
