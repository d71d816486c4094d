"""Decision variables of a program, and the selection of a solution."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from rgss.errors import TradeoffError
from rgss.tradeoff.milp.sums import LinearQuantity
from rgss.tradeoff.problem import Alternative, replicates_of

INTEGRALITY_TOLERANCE = 1e-6
"""Largest distance of a boolean variable from 0 or 1 in an answer that is accepted."""

Row = tuple[float | None, ...]


class Selection(Protocol):
    """Interface of the decision variables that terms depend on.

    A measure takes one of several quantities, each of which has a coefficient; the coefficient of
    the quantity that is selected is linear in the variables.
    """

    @property
    def structure(self) -> Sequence[tuple[str, Any]]:
        """Constraints that make the variables a selection: names and CVXPY constraints."""
        ...

    def quantities(self, measure: str) -> Sequence[float | None]:
        """The quantities of a measure that can be selected; None where it is unknown."""
        ...

    def of_selected(self, measure: str, coefficients: Sequence[float]) -> Any:
        """The coefficient of the selected quantity, as a CVXPY expression.

        Args:
            measure: The measure.
            coefficients: One for each of its `quantities`.
        """
        ...

    def replicates(self, measure: str) -> Sequence[Row]:
        """Replicates of a measure for each of the rows that can be selected."""
        ...

    def of_selected_replicates(self, measure: str, coefficients: Sequence[Sequence[float]]) -> Any:
        """The coefficients of the selected row, as a CVXPY vector with an entry for each replicate.

        Args:
            measure: The measure.
            coefficients: One list for each of its `replicates`, all of one length.
        """
        ...

    def linear_quantity(self, measure: str) -> LinearQuantity | None:
        """The quantity of a measure as a linear expression, where there are too many to list them."""
        ...

    def exclusion(self, alternative: Alternative) -> Any:
        """CVXPY constraint that excludes an alternative from being selected."""
        ...

    def read(self) -> tuple[Alternative, float]:
        """Rows that the solved variables select.

        Returns:
            The alternative, and the largest difference of a variable from selecting exactly it.

        Raises:
            TradeoffError: The variables select no single alternative.
        """
        ...


@dataclass(frozen=True, slots=True, eq=False)
class VariantSelection:
    """One boolean variable for each alternative, exactly one of which is 1.

    Attributes:
        alternatives: The alternatives, in the order of the variables.
        variable: The CVXPY variable, shape (n,).
    """

    alternatives: Sequence[Alternative]
    variable: Any

    @staticmethod
    def of(alternatives: Sequence[Alternative]) -> VariantSelection:
        """New variables for alternatives."""
        import cvxpy

        return VariantSelection(tuple(alternatives), cvxpy.Variable(len(alternatives), boolean=True))

    @property
    def structure(self) -> Sequence[tuple[str, Any]]:
        """Exactly one alternative is selected."""
        import cvxpy

        return (("choose exactly one", cvxpy.sum(self.variable) == 1.0),)

    def quantities(self, measure: str) -> Sequence[float | None]:
        """The quantity of each alternative."""
        return [alternative.measures[measure] for alternative in self.alternatives]

    def of_selected(self, measure: str, coefficients: Sequence[float]) -> Any:  # noqa: ARG002 - one variable serves every measure
        """The coefficient of the selected alternative."""
        import cvxpy
        import numpy as np

        return cvxpy.Constant(np.array(coefficients, dtype=np.float64)) @ self.variable

    def replicates(self, measure: str) -> Sequence[Row]:
        """The replicates of each alternative."""
        return [tuple(replicates_of(alternative, measure)) for alternative in self.alternatives]

    def of_selected_replicates(self, measure: str, coefficients: Sequence[Sequence[float]]) -> Any:  # noqa: ARG002
        """The coefficients of the selected alternative."""
        import cvxpy
        import numpy as np

        return cvxpy.Constant(np.array(coefficients, dtype=np.float64).T) @ self.variable

    def linear_quantity(self, measure: str) -> None:  # noqa: ARG002
        """Quantities of alternatives are always listed."""
        return

    def exclusion(self, alternative: Alternative) -> Any:
        """The variable of an alternative is 0."""
        place = next(at for at, one in enumerate(self.alternatives) if one.variant == alternative.variant)
        return self.variable[place] == 0.0

    def read(self) -> tuple[Alternative, float]:
        """The alternative whose variable is 1."""
        place, error = read_choice(self.variable.value)
        return self.alternatives[place], error


def read_choice(values: Any) -> tuple[int, float]:
    """Index of the single 1 among solved boolean variables, and its numerical error.

    Args:
        values: The solved variables, shape (n,).

    Returns:
        The index of the 1, and the greatest deviation from 1 there and from 0 elsewhere.

    Raises:
        TradeoffError: There is not exactly one 1.
    """
    import numpy as np

    entries = np.asarray(values, dtype=np.float64).reshape(-1)
    place = int(entries.argmax())
    expected = np.zeros_like(entries)
    expected[place] = 1.0
    error = float(np.abs(entries - expected).max())
    if not error <= INTEGRALITY_TOLERANCE:
        raise TradeoffError(
            f"the solver's answer selects no single alternative (off by {error:.3g})",
            hint="the answer is not used; look for measures of extreme magnitude",
        )
    return place, error
