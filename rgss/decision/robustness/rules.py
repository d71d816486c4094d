"""Variants that the rules of a design space allow at another value of a number."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.assessment import VariantMeasures
from rgss.decision.what_if import ModelNumber, variant_with
from rgss.designs import Constraint, Limit, Rule, numbers
from rgss.studies import Project

Allowed = Callable[[float], NDArray[np.bool_]]


def allowed_variants(project: Project, measured: Sequence[VariantMeasures], number: ModelNumber) -> Allowed:
    """Function from a value of a number to the mask of allowed variants, shape (n,)."""
    rules = [rule for rule in project.designs.rules if number.component and _names(rule, number)]

    def allowed(value: float) -> NDArray[np.bool_]:
        variants = (variant_with(entry.variant, number, value) for entry in measured)
        return np.array(
            [all(rule.allows(variant.parameters, variant.components) for rule in rules) for variant in variants]
        )

    everyone = np.ones(len(measured), dtype=np.bool_)
    return allowed if rules else (lambda value: everyone)  # noqa: ARG005


def rule_kinks(project: Project, measured: Sequence[VariantMeasures], number: ModelNumber) -> list[float] | None:
    """Values at which a rule starts or stops allowing a variant.

    Returns:
        The values; None if a constraint on the number has no closed-form solution.
    """
    found: set[float] = set()
    for rule in project.designs.rules:
        if not number.component or not _names(rule, number):
            continue
        if not isinstance(rule.require, Limit):
            return None
        for entry in measured:
            known = numbers(entry.variant.parameters, entry.variant.components)
            if {*rule.require.product_of, rule.require.at_most} <= known.keys():
                found.update(_limit_kinks(rule.require, known, number.source))
    return sorted(found)


def _names(rule: Rule, number: ModelNumber) -> bool:
    """True if a rule compares quantities of which a number is a part."""
    if isinstance(rule.require, Limit):
        return number.source in (*rule.require.product_of, rule.require.at_most)
    return isinstance(rule.require, Constraint) and number.source in rule.require.names


def _limit_kinks(limit: Limit, values: Mapping[str, float], source: str) -> list[float]:
    others = math.prod(values[name] for name in limit.product_of if name != source)
    power = limit.product_of.count(source)
    if limit.at_most == source:
        return [] if power else [others]
    if others > 0.0 and values[limit.at_most] >= 0.0:
        return [(values[limit.at_most] / others) ** (1.0 / power)]
    return []
