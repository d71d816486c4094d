"""Selection of designs by filters, and the names and values of filters and rules."""

from rgss.designs.choosing.filter_names import FilterNames, NamedValues, respelt
from rgss.designs.choosing.filter_values import value_columns
from rgss.designs.choosing.picking import picked
