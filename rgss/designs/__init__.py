"""Design space: parameters, levels and ranges, components, rules and variants."""

from rgss.designs.catalogue import CatalogueModel, load_catalogue
from rgss.designs.choosing import picked, value_columns
from rgss.designs.compatibility import Condition, Limit, Rule
from rgss.designs.components import Catalogue, Component, Role, SourcedValue
from rgss.designs.constraints import Constraint
from rgss.designs.design_values import COMPONENT_PREFIX, DESIGN_PREFIX, numbers, source_units, sources
from rgss.designs.document import DesignSpaceModel
from rgss.designs.factors import Factor, Level, Span
from rgss.designs.loading import load_design_space
from rgss.designs.parameters import DesignParameter, ParameterKind, ParameterValue, format_value, si_unit
from rgss.designs.sampling import SamplingMethod
from rgss.designs.set_findings import written_values
from rgss.designs.settable import (
    BASE_POSITION,
    BASE_YAW,
    PLANNER_PREFIX,
    PLANNER_QUANTITIES,
    Application,
    SettableQuantity,
)
from rgss.designs.settable_quantities import SETTABLE_QUANTITIES
from rgss.designs.space import DesignSpace
from rgss.designs.tables import variant_rows, variants_csv
from rgss.designs.variants import DesignVariant
