"""Uncertain inputs of a decision, each with a range and with values and feasibility of the designs as its function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from rgss.tradeoff.robustness import Standing


class InputKind(str, Enum):
    """Kind of an input."""

    WEIGHT = "weight"
    ANCHOR = "anchor"
    THRESHOLD = "threshold"
    ASSUMPTION = "assumption"
    SHAPE = "shape"


class RangeBasis(str, Enum):
    """Source of a range: stated in the study, elicited, or a share of the value by convention.

    A cut one ends where a value that is anchored on the input would be undefined.
    """

    STATED = "stated"
    ELICITED = "elicited"
    SHARE = "share"
    CUT_SHARE = "cut_share"
    CUT_STATED = "cut_stated"

    @property
    def cut(self) -> RangeBasis:
        """Basis of a range that ends before the end it had; an elicited one is of weights, which are always defined."""
        return RangeBasis.CUT_STATED if self is RangeBasis.STATED else RangeBasis.CUT_SHARE


class FlipSearch(str, Enum):
    """Method that finds the value at which a choice changes.

    Attributes:
        KNOWN: It is solved for by the analyses of robustness.
        NESTED: The choice changes at most once on each side: bisection.
        SCANNED: Scan of 64 steps on each side, and bisection.
    """

    KNOWN = "known"
    NESTED = "nested"
    SCANNED = "scanned"


@dataclass(frozen=True, slots=True, kw_only=True)
class Flip:
    """Value of an input at which another design becomes best.

    Attributes:
        value: The value, in the unit of the input.
        winners: The rows that win beyond it; empty if nothing is feasible there.
    """

    value: float
    winners: tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UncertainInput:
    """Input of a decision that is varied from a low to a high value.

    Attributes:
        id: Its name for ``--what-if``.
        kind: Its kind.
        unit: Its unit.
        base: Its value in the study.
        low: The low end of its range.
        high: The high end.
        basis: Source of the range.
        standing: Weighted values and feasibility of the designs at a value of the input.
        exact: True if the nearest flip is certain; a scan may miss a change that reverts within a step.
        search: Search method for the value at which the choice changes.
        known_flips: For KNOWN, the nearest changes below and above the base; None if there is none.
    """

    id: str
    kind: InputKind
    unit: str
    base: float
    low: float
    high: float
    basis: RangeBasis
    standing: Callable[[float], Standing]
    search: FlipSearch
    exact: bool
    known_flips: tuple[Flip | None, Flip | None] = (None, None)
