"""Findings, quantities and anchors at their places in a study's trade-off."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Iterable, Mapping
from functools import cache

from rgss.documents import Document
from rgss.errors import QuantityError
from rgss.findings import Finding
from rgss.measures import Direction, MeasureSet
from rgss.quantities import parse_quantity
from rgss.requirements import RequirementSet
from rgss.tradeoff import Anchor, RequirementAnchor

Place = tuple[str | int, ...]

SECTION: Place = ("trade_off",)


class TradeOffPlaces:
    """Resolves quantities and names of the section at their places, and collects findings.

    Attributes:
        findings: The findings so far.
        units: The unit of each measure.
    """

    def __init__(
        self, document: Document, measures: MeasureSet | None, requirements: Callable[[], RequirementSet | None]
    ) -> None:
        """Read the section of a document.

        Args:
            document: The study's file.
            measures: The project's measures; None if they could not be read, and then no quantity
                of them is checked.
            requirements: Callback that loads the project's requirements when they are first needed; None if
                they could not be read.
        """
        self.findings: list[Finding] = []
        defined = () if measures is None else measures.measures
        self.units: Mapping[str, str] = {measure.id: measure.unit for measure in defined}
        self._document = document
        self._measures_read = measures is not None
        self._better = {measure.id: measure.better for measure in defined}
        self._requirements = cache(requirements)

    def report(self, rule: str, message: str, at: Place, *, hint: str = "") -> None:
        """Record a finding."""
        self.findings.append(self.finding(rule, message, at, hint=hint))

    def finding(self, rule: str, message: str, at: Place, *, hint: str = "") -> Finding:
        """A finding at a place, which is not recorded."""
        return self._document.finding(f"study.{rule}", message, at, hint=hint)

    def knows(self, measure: str, at: Place) -> bool:
        """True if a measure is defined; a finding if it is not."""
        if measure in self.units:
            return True
        if not self._measures_read:
            return False
        hint = _nearest(measure, self.units, "name one of the measures' file")
        self.report("unknown-measure", f"no measure {measure!r} is defined", at, hint=hint)
        return False

    def more_is_better(self, measure: str) -> bool | None:
        """Preferred direction of a measure; None if the measures' file states none."""
        better = self._better[measure]
        return None if better is Direction.NONE else better is Direction.HIGHER

    def quantity(self, text: str, measure: str, at: Place) -> float | None:
        """A quantity in a measure's unit; a finding and None if it is none."""
        try:
            return parse_quantity(text, self.units[measure])
        except QuantityError as error:
            self.report("quantity", error.message, at, hint=error.hint)
            return None

    def anchor(self, entry: RequirementAnchor | str, measure: str, at: Place) -> Anchor | None:
        """A quantity, or one that a requirement gives; a finding and None if it is neither."""
        if isinstance(entry, str):
            return self.quantity(entry, measure, at)
        if not (math.isfinite(entry.times) and entry.times > 0.0):
            message = f"times must be greater than 0, got {entry.times:g}"
            self.report("anchor", message, (*at, "times"), hint="give a positive number")
            return None
        return entry if self.threshold(entry.requirement, measure, at) is not None else None

    def quantity_of(self, anchor: Anchor, measure: str) -> float:
        """The quantity of an anchor that was read without a finding."""
        if not isinstance(anchor, RequirementAnchor):
            return anchor
        threshold = self.threshold(anchor.requirement, measure, SECTION)
        return anchor.times * (math.nan if threshold is None else threshold)

    def threshold(self, requirement: str, measure: str | None, at: Place) -> float | None:
        """The threshold of a requirement on a measure, in its unit; a finding and None if it has none.

        Args:
            requirement: The requirement's id.
            measure: The measure that it must bound; None for any.
            at: Where it is named.
        """
        requirements = self._requirements()
        if requirements is None:
            return None
        known = {item.id: item for item in requirements.system}
        if requirement not in known:
            message = f"unknown system requirement {requirement!r}"
            self.report("requirement", message, at, hint=_nearest(requirement, known, "name a system requirement"))
            return None
        criterion = known[requirement].criterion
        if criterion is None:
            message = f"{requirement} has no criterion, so no threshold"
            self.report("requirement", message, at, hint="give a quantity instead")
            return None
        if measure is not None and criterion.measure != measure:
            message = f"{requirement} bounds {criterion.measure}, not {measure}"
            self.report("requirement", message, at, hint="name a requirement on the same measure")
            return None
        if criterion.measure not in self.units:
            return None
        try:
            return criterion.threshold_in(self.units[criterion.measure])
        except QuantityError:
            # The finding on the requirement is reported in its own file.
            return None


def _nearest(name: str, known: Iterable[str], otherwise: str) -> str:
    """A hint for a name that is not known: the nearest that is; another where none is near."""
    near = difflib.get_close_matches(name, list(known), n=1)
    return f"did you mean {near[0]!r}?" if near else otherwise
