"""Declaration of uncertainty: distributions and correlations of quantities."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes.uncertainty.distributions import Distribution


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertainValue:
    """A quantity with its distribution.

    Attributes:
        quantity: Name of an entry of `rgss.scenes.uncertainty.QUANTITIES`.
        distribution: The distribution of its draws, in the quantity's unit.
    """

    quantity: str
    distribution: Distribution


@dataclass(frozen=True, slots=True, kw_only=True)
class Correlation:
    """Gaussian copula of correlated quantities.

    Attributes:
        quantities: Their names.
        matrix: Correlations of the normal scores, a row for each quantity.
    """

    quantities: tuple[str, ...]
    matrix: tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Uncertainty:
    """Uncertain quantities of a scene or a study.

    Attributes:
        values: The uncertain quantities; the order has no effect.
        correlations: Groups of correlated quantities; a quantity is in at most one.
    """

    values: tuple[UncertainValue, ...] = ()
    correlations: tuple[Correlation, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the uncertain quantities."""
        return tuple(one.quantity for one in self.values)

    def overridden_by(self, other: Uncertainty) -> Uncertainty:
        """Merge with another uncertainty, which takes precedence.

        Args:
            other: The uncertainty with precedence. Each of its groups replaces those that share a quantity with it.
        """
        theirs = set(other.names)
        grouped = {name for group in other.correlations for name in group.quantities}
        return Uncertainty(
            values=(*(one for one in self.values if one.quantity not in theirs), *other.values),
            correlations=(
                *(group for group in self.correlations if grouped.isdisjoint(group.quantities)),
                *other.correlations,
            ),
        )


NOTHING_UNCERTAIN = Uncertainty()
"""No uncertainty."""
