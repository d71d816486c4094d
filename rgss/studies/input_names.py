"""Inputs of a trial by name, kept so that a later change of one can be reported."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

from rgss.evidence import inputs_digest
from rgss.trials.code import code_of_trials
from rgss.trials.pieces import TrialSpec, to_plain

CODE = "code"
"""Entry with the modules' digests; the others are the user's inputs."""

_NO_INPUTS = ("colour",)
_SHORT = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedInputs:
    """Inputs of a trial other than its variant's number and its seed.

    Attributes:
        digest: Their key in the evidence store.
        values: Plain data; its dotted names are those under which a changed input is reported. A long
            text is represented by a digest.
    """

    digest: str
    values: Mapping[str, Any]


def named_inputs(spec: TrialSpec) -> NamedInputs:
    """The inputs of a trial."""
    return _inputs_of(replace(spec, variant=0, seed=0))


@lru_cache(maxsize=512)
def _inputs_of(spec: TrialSpec) -> NamedInputs:
    robot = spec.scene.robot
    text = hashlib.sha256(robot.urdf.encode("utf-8", "surrogatepass")).hexdigest()[:_SHORT]
    inputs = _without_colours(to_plain(replace(spec, scene=replace(spec.scene, robot=replace(robot, urdf=text)))))
    del inputs["variant"], inputs["seed"]
    del inputs["scene"]["robot"]["calibration"]  # where the control uses it, the controller has it
    for other in inputs["scene"]["others"]:
        del other["grasp"]  # a result of the other inputs
    for name in ("timing", "controller"):
        settings = getattr(spec.settings, name)
        if settings == type(settings)():  # as in `digests_of`, the default is not an input
            del inputs["settings"][name]
    values = {**inputs, CODE: code_of_trials()}
    return NamedInputs(digest=inputs_digest(values), values=values)


def _without_colours(value: Any) -> Any:
    """Only pictures see a colour."""
    if isinstance(value, dict):
        return {key: _without_colours(item) for key, item in value.items() if key not in _NO_INPUTS}
    if isinstance(value, list):
        return [_without_colours(item) for item in value]
    return value
