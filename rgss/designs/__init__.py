"""Design parameters, their levels and ranges, the components behind them, and the variants they make."""

from rgss.designs.catalogue import load_catalogue
from rgss.designs.compatibility import Condition, Limit, Rule
from rgss.designs.components import Catalogue, Component, Role, SourcedValue
from rgss.designs.constraints import Constraint
from rgss.designs.factors import Factor, Level, Span
from rgss.designs.loading import load_design_space
from rgss.designs.parameters import DesignParameter, ParameterKind
from rgss.designs.picking import picked
from rgss.designs.sampling import Sample, SamplingMethod
from rgss.designs.sources import source_units, sources
from rgss.designs.space import DesignSpace, ExcludedCombination
from rgss.designs.tables import variant_rows, variants_csv
from rgss.designs.variants import DesignVariant

__all__ = [
    "Catalogue",
    "Component",
    "Condition",
    "Constraint",
    "DesignParameter",
    "DesignSpace",
    "DesignVariant",
    "ExcludedCombination",
    "Factor",
    "Level",
    "Limit",
    "ParameterKind",
    "Role",
    "Rule",
    "Sample",
    "SamplingMethod",
    "SourcedValue",
    "Span",
    "load_catalogue",
    "load_design_space",
    "picked",
    "source_units",
    "sources",
    "variant_rows",
    "variants_csv",
]
