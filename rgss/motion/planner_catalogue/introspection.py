"""Table of the planners of the installed OMPL; ``python -m`` of this module prints it."""

from __future__ import annotations

import sys
from typing import Any

from rgss.documents import canonical_json
from rgss.motion.engine import Engine, load_engine
from rgss.motion.planner_catalogue.table import ParameterType

_PROBE_JOINTS = 6
_FLAG_RANGE = "0,1"
_FRACTIONS = ("0.5", "2.5", "12.5")


def planner_table() -> dict[str, Any]:
    """Planners of the installed OMPL that can be constructed for an arm's joint space, as plain data.

    Each parameter has OMPL's default and range suggestion, and the type that OMPL's conversion accepts.
    """
    engine = load_engine()
    planners = {}
    for name in sorted(dir(engine.geometric)):
        made = getattr(engine.geometric, name)
        if isinstance(made, type) and issubclass(made, engine.base.Planner):
            planner = _made(engine, made)
            if planner is not None:
                planners[name] = {
                    "optimizing": bool(planner.getSpecs().optimizingPaths),
                    "parameters": _parameters(engine, planner, _made(engine, made)),
                }
    return {"planners": planners}


def _made(engine: Engine, planner: Any) -> Any:
    space = engine.base.RealVectorStateSpace(_PROBE_JOINTS)
    bounds = engine.base.RealVectorBounds(_PROBE_JOINTS)
    bounds.setLow(-1.0)
    bounds.setHigh(1.0)
    space.setBounds(bounds)
    information = engine.base.SpaceInformation(space)
    information.setStateValidityChecker(engine.base.StateValidityCheckerFn(lambda _state: True))
    information.setup()
    try:
        return planner(information)
    except RuntimeError:  # a planner of another kind of space
        return None


def _parameters(engine: Engine, planner: Any, probed: Any) -> dict[str, dict[str, str]]:
    names = engine.util.vectorString()
    planner.params().getParamNames(names)
    found = {}
    for name in names:
        parameter = planner.params()[name]
        entry = {"default": parameter.getValue(), "range": parameter.getRangeSuggestion()}
        found[name] = {**entry, "type": _type_of(probed, name, entry).value}
    return found


def _type_of(planner: Any, name: str, entry: dict[str, str]) -> ParameterType:
    if entry["range"] == _FLAG_RANGE:
        return ParameterType.FLAG
    return ParameterType.REAL if any(_keeps(planner, name, text) for text in _FRACTIONS) else ParameterType.WHOLE


def _keeps(planner: Any, name: str, text: str) -> bool:
    """True if a parameter stores a fraction; an integer parameter truncates it."""
    try:
        return bool(planner.params().setParam(name, text)) and planner.params()[name].getValue() == text
    except RuntimeError:  # a value that the setter refuses
        return False


if __name__ == "__main__":
    sys.stdout.write(canonical_json(planner_table()) + "\n")
