"""Ranges over which the inputs of a decision are moved."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Dimensionless, Identifier, Text
from rgss.findings import Finding
from rgss.tradeoff import AnchoredValue, QuantityField

if TYPE_CHECKING:
    from rgss.studies.trade_off.places import TradeOffPlaces

LEAST_TOLERANCE = 0.02
"""A bent value function with a smaller risk tolerance is a step."""

_SECTION = ("trade_off", "sensitivity")


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class StatedRange:
    """Range of one input.

    Attributes:
        input: Name of the input, as ``--what-if`` takes it.
        low: The low end, with its unit.
        high: The high end, with its unit.
        rationale: The reason.
    """

    input: Text
    low: QuantityField
    high: QuantityField
    rationale: Text | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class SensitivityChoice:
    """Range of each kind of input for which none is stated.

    Attributes:
        weights: Change of a weight, as a share of it.
        anchors: Change of an end of a value function, as a share of the range from worst to best.
        thresholds: Change of a threshold, as a share of it.
        assumptions: Change of an assumed number, as a share of it.
        risk_tolerance: The least risk tolerance, as a share of the range from worst to best, with which value
            functions are bent.
        keep_within: Distance from the best up to which a design is worth keeping; None for the practical margin.
        priced_in: Measure in which differences of the others are paid; None for the first one in money, or the one
            with the greatest weight.
        ranges: Stated ranges.
    """

    weights: Dimensionless = 0.25
    anchors: Dimensionless = 0.10
    thresholds: Dimensionless = 0.10
    assumptions: Dimensionless = 0.25
    risk_tolerance: Dimensionless = 0.3
    keep_within: Dimensionless | None = None
    priced_in: Identifier | None = None
    ranges: tuple[StatedRange, ...] = ()


def check_sensitivity(
    places: TradeOffPlaces, choice: SensitivityChoice, valued: Sequence[AnchoredValue], deciding: Sequence[str]
) -> tuple[Finding, ...]:
    """Check the section, with a finding for each mistake.

    Args:
        places: Takes the findings.
        choice: The section.
        valued: The value functions of the study.
        deciding: The measures with a weight above 0; none if the weights are wrong.

    Returns:
        For each stated range a finding at its input, which gives later messages their place.
    """
    for key in ("weights", "anchors", "thresholds", "assumptions"):
        share = getattr(choice, key)
        if not 0.0 <= share < 1.0:
            places.report(
                "sensitivity", f"{key} must be from 0 to below 1, got {share:g}", (*_SECTION, key), hint="such as 0.25"
            )
    if not (math.isfinite(choice.risk_tolerance) and choice.risk_tolerance >= LEAST_TOLERANCE):
        message = f"risk_tolerance must be at least {LEAST_TOLERANCE:g}, got {choice.risk_tolerance:g}"
        places.report("sensitivity", message, (*_SECTION, "risk_tolerance"), hint="a share of the range, such as 0.3")
    if choice.keep_within is not None and not 0.0 <= choice.keep_within <= 1.0:
        message = f"keep_within must be from 0 to 1, got {choice.keep_within:g}"
        places.report("sensitivity", message, (*_SECTION, "keep_within"), hint="a difference of value, such as 0.02")
    priced = choice.priced_in
    targets = [one.measure for one in valued if not one.is_monotone]
    if priced is not None and deciding and (priced not in deciding or priced in targets):
        why = "has a target" if priced in targets else "has no weight"
        names = ", ".join(name for name in deciding if name not in targets)
        hint = f"name one of {names}" if names else "leave it out: all measures have targets"
        places.report("sensitivity", f"priced_in: {priced!r} {why}", (*_SECTION, "priced_in"), hint=hint)
    inputs = [one.input for one in choice.ranges]
    at = [(*_SECTION, "ranges", index, "input") for index in range(len(inputs))]
    for index, name in enumerate(inputs):
        if name in inputs[:index]:
            places.report("sensitivity", f"{name!r} has two ranges", at[index], hint="keep one")
    return tuple(places.finding("sensitivity", "", place) for place in at)
