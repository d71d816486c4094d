"""The geometric planners of the pinned OMPL wheel and their parameters, from a stored table.

The table ``ompl_planners.json`` is written by `rgss.motion.planner_introspection` from OMPL's own parameter sets, so
that studies are read and checked without OMPL; a test compares it with the installed wheel.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from importlib import resources
from types import MappingProxyType
from typing import Any


class ParameterType(str, Enum):
    """Type of a planner's parameter."""

    REAL = "real"
    WHOLE = "whole"
    FLAG = "flag"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerParameter:
    """A parameter of a planner as OMPL declares it.

    Attributes:
        name: Its name in OMPL's parameter set.
        type: Its type.
        default: The value of a new planner; a distance of 0 rad is derived from the space when the planner is set up.
        least: The least value by OMPL's range suggestion; minus infinity where there is none.
        greatest: The greatest value by it; infinity where there is none.
    """

    name: str
    type: ParameterType
    default: float
    least: float
    greatest: float

    def problem_of(self, value: float) -> str:
        """The reason against a value of this parameter, in SI; empty if it can be set.

        Args:
            value: The value; 0 or 1 of a flag.
        """
        if self.type is ParameterType.FLAG and value not in (0, 1):
            return f"{self.name} must be true or false, got {value:g}"
        if self.type is ParameterType.WHOLE and value != int(value):
            return f"{self.name} must be a whole number, got {value:g}"
        if not self.least <= value <= self.greatest:
            most = "" if math.isinf(self.greatest) else f" and at most {self.greatest:g}"
            return f"{self.name} must be at least {self.least:g}{most}, got {value:g}"
        return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class OmplPlanner:
    """A geometric planner of OMPL.

    Attributes:
        name: Its class in ``ompl.geometric``, by which it is named everywhere.
        parameters: Its parameters by name.
        optimizing: Whether it improves paths under an optimisation objective.
    """

    name: str
    parameters: Mapping[str, PlannerParameter]
    optimizing: bool


@lru_cache(maxsize=1)
def ompl_planners() -> Mapping[str, OmplPlanner]:
    """The planners of the pinned wheel by name."""
    text = (resources.files("rgss.motion") / "ompl_planners.json").read_text(encoding="utf-8")
    return MappingProxyType({name: _planner(name, entry) for name, entry in json.loads(text)["planners"].items()})


def _planner(name: str, entry: Mapping[str, Any]) -> OmplPlanner:
    parameters = {key: _parameter(key, one) for key, one in entry["parameters"].items()}
    return OmplPlanner(name=name, parameters=MappingProxyType(parameters), optimizing=entry["optimizing"])


def _parameter(name: str, entry: Mapping[str, str]) -> PlannerParameter:
    """A parameter from OMPL's texts; a range suggestion is ``least:greatest``, ``least:step:greatest`` or ``0,1``."""
    suggestion = entry["range"].replace(",", ":").split(":")
    bounded = len(suggestion) > 1
    return PlannerParameter(
        name=name,
        type=ParameterType(entry["type"]),
        default=float(entry["default"]),
        least=float(suggestion[0]) if bounded else -math.inf,
        greatest=float(suggestion[-1]) if bounded else math.inf,
    )
