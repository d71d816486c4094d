"""Ranges of inputs: stated, elicited, or a share of the value."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from rgss.decision.sensitivity.inputs import RangeBasis
from rgss.decision.what_if import nearest_names
from rgss.errors import DocumentError, QuantityError
from rgss.findings import Finding, Severity
from rgss.quantities import parse_quantity
from rgss.studies.trade_off import SensitivityChoice, StatedRange


class RangeBook:
    """Ranges of a study; each input takes its own, and remaining ones are errors.

    Attributes:
        choice: Ranges of inputs without a stated range.
    """

    def __init__(self, choice: SensitivityChoice, places: Sequence[Finding], *, is_supposed: bool = False) -> None:
        """Create the ranges from the section of the study's file.

        Args:
            choice: The section.
            places: A finding at the place of each stated range.
            is_supposed: Whether suppositions have moved inputs: a range that one leaves then reaches to it.
        """
        self.choice = choice
        self._is_supposed = is_supposed
        self._stated = {one.input: one for one in choice.ranges}
        self._places = {one.input: place for one, place in zip(choice.ranges, places, strict=True)}
        self._findings: list[Finding] = []
        self._known: list[str] = []

    def stated(self, name: str, unit: str, base: float) -> tuple[float, float] | None:
        """The stated range of an input; None if there is none, or if it is wrong.

        Args:
            name: The input.
            unit: Its unit.
            base: Its value in the study, which the range must contain.
        """
        self._known.append(name)
        one = self._stated.pop(name, None)
        if one is None:
            return None
        try:
            low, high = parse_quantity(one.low, unit), parse_quantity(one.high, unit)
        except QuantityError as error:
            self._report(one, f"{name}: {error.message}", error.hint)
            return None
        if self._is_supposed:
            return min(low, base), max(high, base)
        if not low <= base <= high:
            message = f"{name} is {base:g}{'' if unit == '1' else ' ' + unit}, outside of its range {low:g} to {high:g}"
            self._report(one, message, "give a low and a high end with the value of the study between them")
            return None
        return low, high

    def range_of(
        self, name: str, unit: str, base: float, spread: float, *, least: float | None = None, most: float | None = None
    ) -> tuple[float, float, RangeBasis]:
        """The stated range of an input, or a spread around its value, clipped to its possible values.

        Args:
            name: The input.
            unit: Its unit.
            base: Its value.
            spread: Change to either side if no range is stated.
            least: Its least possible value.
            most: Its greatest possible value.
        """
        stated = self.stated(name, unit, base)
        if stated is not None:
            return (*stated, RangeBasis.STATED)
        low, high = base - spread, base + spread
        return (
            low if least is None else max(least, low),
            high if most is None else min(most, high),
            RangeBasis.SHARE,
        )

    def has(self, name: str) -> bool:
        """True if a range is stated for an input and not taken yet."""
        return name in self._stated

    def check(self, others: Iterable[str] = ()) -> None:
        """Check that every stated range belongs to an input and is valid.

        Args:
            others: Inputs without a range because they have no effect.

        Raises:
            DocumentError: One is not, with every problem at its place in the study's file.
        """
        ignored = set(others)
        for one in self._stated.values():
            if one.input not in ignored:
                hint = nearest_names(one.input, self._known)
                self._report(one, f"unknown input {one.input!r} of the decision", hint)
        if self._findings:
            raise DocumentError(sorted(self._findings))

    def _report(self, one: StatedRange, message: str, hint: str) -> None:
        self._findings.append(replace(self._places[one.input], severity=Severity.ERROR, message=message, hint=hint))
