"""Ranges over which the inputs of a decision are moved."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rgss.findings import Finding
from rgss.studies.trade_off.document import SensitivityEntry
from rgss.studies.trade_off.places import SECTION, TradeOffPlaces

LEAST_TOLERANCE = 0.02
"""A bent value function with a smaller risk tolerance is a step."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StatedRange:
    """Range of one input.

    Attributes:
        input: Name of the input, as ``--what-if`` takes it, or ``shape.MEASURE``.
        low: The low end, with its unit.
        high: The high end, with its unit.
        rationale: Why so; may be empty.
        place: A finding at its place in the file, of which messages on it take the place.
    """

    input: str
    low: str
    high: str
    rationale: str
    place: Finding


@dataclass(frozen=True, slots=True, kw_only=True)
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
        ranges: Stated ranges.
    """

    weights: float = 0.25
    anchors: float = 0.10
    thresholds: float = 0.10
    assumptions: float = 0.25
    risk_tolerance: float = 0.3
    keep_within: float | None = None
    ranges: tuple[StatedRange, ...] = ()


def read_sensitivity(places: TradeOffPlaces, entry: SensitivityEntry | None) -> SensitivityChoice:
    """Read the section, with a finding for each mistake.

    Args:
        places: Takes the findings.
        entry: The section; None where the study has none.
    """
    if entry is None:
        return SensitivityChoice()
    at = (*SECTION, "sensitivity")
    for key in ("weights", "anchors", "thresholds", "assumptions"):
        share = getattr(entry, key)
        if not 0.0 <= share < 1.0:
            places.report(
                "sensitivity", f"{key} must be from 0 to below 1, got {share:g}", (*at, key), hint="such as 0.25"
            )
    if not (math.isfinite(entry.risk_tolerance) and entry.risk_tolerance >= LEAST_TOLERANCE):
        message = f"risk_tolerance must be at least {LEAST_TOLERANCE:g}, got {entry.risk_tolerance:g}"
        places.report("sensitivity", message, (*at, "risk_tolerance"), hint="a share of the range, such as 0.3")
    if entry.keep_within is not None and not 0.0 <= entry.keep_within <= 1.0:
        message = f"keep_within must be from 0 to 1, got {entry.keep_within:g}"
        places.report("sensitivity", message, (*at, "keep_within"), hint="a difference of value, such as 0.02")
    seen: set[str] = set()
    ranges = []
    for index, one in enumerate(entry.ranges):
        if one.input in seen:
            message = f"{one.input!r} has two ranges"
            places.report("sensitivity", message, (*at, "ranges", index, "input"), hint="keep one")
        seen.add(one.input)
        ranges.append(
            StatedRange(
                input=one.input,
                low=one.low,
                high=one.high,
                rationale=one.rationale or "",
                place=places.finding("sensitivity", "", (*at, "ranges", index, "input")),
            )
        )
    return SensitivityChoice(
        weights=entry.weights,
        anchors=entry.anchors,
        thresholds=entry.thresholds,
        assumptions=entry.assumptions,
        risk_tolerance=entry.risk_tolerance,
        keep_within=entry.keep_within,
        ranges=tuple(ranges),
    )
