"""Ranges of inputs: stated, elicited, or a share of the value."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import replace

from rgss.decision.sensitivity.inputs import RangeBasis
from rgss.errors import DocumentError, QuantityError
from rgss.findings import Finding, Severity
from rgss.quantities import parse_quantity
from rgss.studies.trade_off import SensitivityChoice, StatedRange


class RangeBook:
    """The ranges of a study; an input takes its own, and what is left over is a mistake.

    Attributes:
        choice: Ranges of inputs for which none is stated.
    """

    def __init__(self, choice: SensitivityChoice, places: Sequence[Finding]) -> None:
        """Take the section of the study's file.

        Args:
            choice: The section.
            places: For each stated range a finding at its place.
        """
        self.choice = choice
        self._stated = {one.input: one for one in choice.ranges}
        self._places = {one.input: place for one, place in zip(choice.ranges, places, strict=True)}
        self._findings: list[Finding] = []
        self._known: list[str] = []

    def stated(self, name: str, unit: str, base: float) -> tuple[float, float] | None:
        """The stated range of an input; None where there is none, or it is wrong.

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
        if not low <= base <= high:
            message = f"{name} is {base:g}{'' if unit == '1' else ' ' + unit}, outside of its range {low:g} to {high:g}"
            self._report(one, message, "give a low and a high end with the value of the study between them")
            return None
        return low, high

    def range_of(
        self, name: str, unit: str, base: float, spread: float, *, least: float | None = None, most: float | None = None
    ) -> tuple[float, float, RangeBasis]:
        """The stated range of an input, or a spread around its value, cut to what it can be.

        Args:
            name: The input.
            unit: Its unit.
            base: Its value.
            spread: Change to either side where no range is stated.
            least: The least that it can be.
            most: The most that it can be.
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
        """True if a range is stated for an input that has not taken it yet."""
        return name in self._stated

    def check(self, others: Iterable[str] = ()) -> None:
        """Check that every stated range is of an input, and right.

        Args:
            others: Inputs that have no range because they decide nothing.

        Raises:
            DocumentError: One is not; with every problem in its place in the study's file.
        """
        ignored = set(others)
        for one in self._stated.values():
            if one.input not in ignored:
                near = difflib.get_close_matches(one.input, self._known, n=3)
                hint = f"did you mean {' or '.join(near)}?" if near else f"such as {', '.join(self._known[:4])}"
                self._report(one, f"unknown input {one.input!r} of the decision", hint)
        if self._findings:
            raise DocumentError(sorted(self._findings))

    def _report(self, one: StatedRange, message: str, hint: str) -> None:
        self._findings.append(replace(self._places[one.input], severity=Severity.ERROR, message=message, hint=hint))
