"""Parameters of OMPL's planners as settable quantities, with their units.

Names and types are those of OMPL's parameter sets; a test compares them with the table of `rgss.motion`, which has the
parameters, defaults and ranges of each planner.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from rgss.designs.parameters import ParameterKind
from rgss.designs.settable.quantity import Application, SettableQuantity

PLANNER_PREFIX = "planning.planner."
"""``sets: planning.planner.<parameter>`` sets a parameter of the design's planner."""

_DISTANCES: Mapping[str, str] = MappingProxyType(
    {
        "frontier_threshold": "Distance in joint space beyond which a new state widens the frontier of TRRT's tree.",
        "pruning_radius": "Distance in joint space within which SST keeps only the best state.",
        "range": "Longest motion in joint space that is added to a tree; 0 rad for OMPL's default.",
        "selection_radius": "Distance in joint space within which SST selects the best state.",
    }
)
_RATIOS: Mapping[str, str] = MappingProxyType(
    {
        "border_fraction": "Share of expansions that begin at the border of the grid of cells.",
        "cost_threshold": "Greatest cost of a motion that TRRT accepts.",
        "dense_delta_fraction": "Interface distance of the dense graph as a share of the space's extent.",
        "epsilon": "Approximation factor of path costs.",
        "estimated_dimension": "Estimated dimension of the free space.",
        "failed_expansion_score_factor": "Factor on the score of a cell after a failed expansion.",
        "frontier_node_ratio": "Greatest ratio of states that refine TRRT's tree to those that widen it.",
        "goal_bias": "Probability that the goal is sampled.",
        "inflation_scaling_parameter": "Scaling of the inflation of heuristics with the number of samples.",
        "init_temperature": "Temperature at which TRRT begins.",
        "initial_inflation_factor": "Inflation of heuristics at first.",
        "min_valid_path_fraction": "Least valid share of a motion for which its valid part is kept.",
        "prune_threshold": "Relative improvement of cost from which states are pruned.",
        "prune_threshold_as_fractional_cost_change": "Relative improvement of cost from which states are pruned.",
        "radius_multiplier": "Factor on the radius within which states are connected.",
        "rejection_variant_alpha": "Factor of the rejection of samples.",
        "rewire_factor": "Factor on the radius or number of neighbours for rewiring.",
        "sparse_delta_fraction": "Visibility range of the sparse graph as a share of the space's extent.",
        "stretch_factor": "Stretch factor of the sparse graph.",
        "temp_change_factor": "Exponent by which TRRT's temperature rises after a rejected transition.",
        "truncation_scaling_parameter": "Scaling of the truncation of searches with the number of samples.",
    }
)
_COUNTS: Mapping[str, str] = MappingProxyType(
    {
        "batch_size": "Samples of a batch.",
        "degree": "Preferred degree of a node of STRIDE's tree of nearest neighbours.",
        "max_degree": "Greatest degree of such a node.",
        "max_failures": "Failures to add a state after which the graph counts as dense enough.",
        "max_nearest_neighbors": "Neighbours to which a milestone is connected.",
        "max_pts_per_leaf": "States of a leaf of STRIDE's tree of nearest neighbours.",
        "min_degree": "Least degree of a node of that tree.",
        "num_samples": "Samples that are drawn before the search.",
        "number_sampling_attempts": "Attempts to draw a sample that may improve the path.",
        "ordering_batch_size": "Samples that are ordered at a time.",
        "rejection_variant": "Variant of the rejection of samples.",
        "samples_per_batch": "Samples of a batch.",
        "set_max_num_goals": "Greatest number of goals.",
    }
)
_FLAGS = (
    "balanced",
    "cache_cc",
    "delay_collision_checking",
    "delay_rewiring_to_first_solution",
    "drop_unconnected_samples_on_prune",
    "extended_fmt",
    "find_approximate_solutions",
    "focus_search",
    "heuristics",
    "informed_sampling",
    "intermediate_states",
    "nearest_k",
    "new_state_rejection",
    "optimality",
    "ordered_sampling",
    "pruned_measure",
    "sample_rejection",
    "stop_on_each_solution_improvement",
    "tree_pruning",
    "update_children",
    "use_admissible_heuristic",
    "use_graph_pruning",
    "use_just_in_time_sampling",
    "use_k_nearest",
    "use_projected_distance",
    "use_strict_queue_ordering",
)


def _quantities() -> Iterator[SettableQuantity]:
    for kind, unit, meanings in (
        (ParameterKind.QUANTITY, "rad", _DISTANCES),
        (ParameterKind.QUANTITY, "1", _RATIOS),
        (ParameterKind.COUNT, "1", _COUNTS),
        (ParameterKind.COUNT, "1", {name: f"1 for OMPL's option {name}, 0 against it." for name in _FLAGS}),
    ):
        for name, meaning in meanings.items():
            yield SettableQuantity(
                name=f"{PLANNER_PREFIX}{name}",
                kind=kind,
                unit=unit,
                meaning=meaning,
                field="planner_settings",
                application=Application.PLANNER_PARAMETER,
                default="planning.planners in the study",
                required=False,
                positive=False,
            )


PLANNER_QUANTITIES: Mapping[str, SettableQuantity] = MappingProxyType({one.name: one for one in _quantities()})
"""Parameters of planners by their name in ``sets``."""
