"""Names of suppositions in words, for readers who do not write them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rgss.decision.what_if import PRICES
from rgss.studies import Project

_NAMES: Mapping[str, str] = MappingProxyType(
    {
        PRICES: "All assumed prices of components",
        "fidelity": "Fidelity of the trials",
        "physics.rate": "Rate of the physics engine",
        "physics.solver_iterations": "Solver iterations of a physics step",
        "planning.charge_per_check": "Planning time charged for a collision check",
        "planning.clearance": "Clearance that a plan must keep",
        "planning.on_unverified": "Reaction to a path that fails its verification",
        "planning.resolution": "Distance between collision checks of a motion",
        "planning.simplification_checks": "Collision checks spent on simplifying a path",
        "planning.simplification_limit": "Limit of the time for simplifying a path",
        "planning.time_limit": "Limit of the planning time of all designs",
        "planning.verification_resolution": "Distance between checks of the verified path",
        "uncertainty.nominal": "Trials without uncertainty and workload",
        "workload": "Cases of the workload",
    }
)
_FLAGS: Mapping[str, str] = MappingProxyType({"true": "yes", "false": "no"})
_PLANNERS = "planning.planners."
AS_STATED = "as stated"
"""The present value of an assumption that is no single number."""


def name_in_words(project: Project, name: str) -> str:
    """Name of a supposed number, setting or reading in words, such as "Goal bias of TRRT".

    Args:
        project: The project with its study.
        name: Its name for ``--what-if``, such as ``planning.planners.TRRT.goal_bias``.
    """
    kind, _, rest = name.partition(".")
    measures = {one.id: one.name for one in project.measures.measures}
    if name in _NAMES:
        return _NAMES[name]
    if kind == "reading":
        return measures.get(rest, rest)
    if kind == "weight":
        return f"Weight of {measures.get(rest, _spaced(rest))}"
    if name.startswith(_PLANNERS):
        planner, _, key = name.removeprefix(_PLANNERS).rpartition(".")
        return f"{_capital(_spaced(key))} of {planner or 'all planners'}"
    if kind == "moves":
        return f"Kind of the move “{_spaced(rest)}”"
    if kind == "uncertainty":
        return f"Distribution of {_spaced(rest)}"
    if kind == "workload":
        case, _, field = rest.rpartition(".")
        return f"{_capital(_spaced(field))} of the workload's case “{_spaced(case)}”"
    if kind == "catalogue":
        component, _, field = rest.rpartition(".")
        titles = {one.id: one.name for one in project.designs.catalogue.components}
        return f"{_capital(_spaced(field))} of {titles.get(component, component)}"
    if name.endswith(".threshold"):
        return f"Limit of {name.removesuffix('.threshold')}"
    constants = {one.id: one.definition for one in project.measures.constants}
    return constants.get(rest, _capital(_spaced(name))).rstrip(".")


def alternative_in_words(name: str, alternative: str) -> str:
    """Alternative value of an assumption in words.

    Args:
        name: The assumption's name for ``--what-if``.
        alternative: The value in the notation of ``--what-if``.
    """
    if name.startswith("reading."):
        return f"read as “{_spaced(alternative)}”"
    if name == PRICES and alternative != "0":
        return f"multiplied by {alternative}"
    return value_in_words(alternative)


def value_in_words(text: str) -> str:
    """Value of an assumption as a reader would say it: "yes" for ``true``; empty if it is no single number."""
    return _FLAGS.get(text, text) or AS_STATED


def _spaced(name: str) -> str:
    return name.replace("_", " ").replace(".", " ")


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
