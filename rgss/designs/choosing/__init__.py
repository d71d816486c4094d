"""Names and values by which filters and rules choose among designs, and the choice itself."""

from rgss.designs.choosing.filter_names import FilterNames, NamedValues, respelt
from rgss.designs.choosing.picking import picked
