"""Alternatives with their evidence, as objects or as one table."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, overload

from rgss.errors import TradeoffError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternative:
    """Alternative of a trade-off: a design with its evidence.

    Attributes:
        variant: Id of the design variant.
        measures: Its quantity in each measure, in the measure's unit; None if unknown, for instance because no trial
        succeeded.
        samples: Values of each measure in each replicate, in the order of their seeds, in the measure's unit; None if
        missing in a replicate. A measure that depends only on the design needs none.
    """

    variant: int
    measures: Mapping[str, float | None] = field(hash=False)
    samples: Mapping[str, tuple[float | None, ...]] = field(default_factory=dict, hash=False)

    def replicates(self, measure: str) -> tuple[float | None, ...] | None:
        """Quantity of a measure in each replicate; None if it follows from the design alone."""
        return self.samples.get(measure)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples:
    """Quantities of one measure in every replicate of every alternative.

    Attributes:
        values: Quantities, shape (n, r); NaN where a replicate lacks it or was not run.
        ran: Mask of the replicates that were run, shape (n, r).
    """

    values: NDArray[np.float64]
    ran: NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvidenceTable(Sequence[Alternative]):
    """Alternatives as columns, for as many as memory holds; reads like a sequence of them.

    Attributes:
        variants: Ids, shape (n,), ascending.
        measures: The m measures.
        quantities: Known quantities, shape (n, m), in each measure's unit; NaN exactly where it is
            unknown.
        samples: The replicates of each measure that has any.
    """

    variants: NDArray[np.int64]
    measures: tuple[str, ...]
    quantities: NDArray[np.float64]
    samples: Mapping[str, Samples] = field(default_factory=dict)

    @staticmethod
    def of(
        variants: NDArray[np.int64],
        columns: Mapping[str, NDArray[np.float64]],
        *,
        known: Mapping[str, NDArray[np.bool_]] | None = None,
    ) -> EvidenceTable:
        """Table from columns.

        Args:
            variants: Ids, shape (n,), in any order.
            columns: The quantities of each measure, shape (n,).
            known: Mask of known values, shape (n,); all by default. Other entries of the column are ignored.

        Raises:
            TradeoffError: An id is a duplicate, a column has another length, or a known quantity is not finite.
        """
        import numpy as np

        ids = np.asarray(variants, dtype=np.int64)
        order = np.argsort(ids, kind="stable")
        twice = ids[order][1:][ids[order][1:] == ids[order][:-1]]
        if twice.size:
            raise _given_twice(int(twice[0]))
        quantities = np.empty((len(ids), len(columns)), dtype=np.float64)
        for place, (measure, column) in enumerate(columns.items()):
            if np.shape(column) != ids.shape:
                raise TradeoffError(
                    f"{measure!r} has the shape {np.shape(column)} for {len(ids)} alternatives",
                    hint="give one quantity for each alternative",
                )
            there = np.ones(len(ids), dtype=np.bool_) if known is None or measure not in known else known[measure]
            bad = np.flatnonzero(there & ~np.isfinite(column))
            if bad.size:
                raise _not_finite(measure, int(ids[bad[0]]), float(column[bad[0]]))
            quantities[:, place] = np.where(there, column, np.nan)[order]
        return EvidenceTable(variants=ids[order], measures=tuple(columns), quantities=quantities)

    def column(self, measure: str) -> NDArray[np.float64]:
        """The quantities of one measure, shape (n,); NaN where unknown."""
        return self.quantities[:, self.measures.index(measure)]

    def replicates(self, measure: str) -> Samples:
        """The replicates of one measure; of one that follows from the design alone, its quantity once."""
        import numpy as np

        if measure in self.samples:
            return self.samples[measure]
        column = self.column(measure)[:, None]
        return Samples(values=column, ran=np.ones_like(column, dtype=np.bool_))

    def rows(self, chosen: NDArray[np.intp]) -> EvidenceTable:
        """The table of some of its rows, in ascending order of their ids."""
        import numpy as np

        kept = np.sort(chosen)
        return EvidenceTable(
            variants=self.variants[kept],
            measures=self.measures,
            quantities=self.quantities[kept],
            samples={
                measure: Samples(values=samples.values[kept], ran=samples.ran[kept])
                for measure, samples in self.samples.items()
            },
        )

    def row_of(self, variant: int) -> int:
        """The row of an alternative that is in the table."""
        import numpy as np

        return int(np.searchsorted(self.variants, variant))

    def __len__(self) -> int:
        return len(self.variants)

    def __iter__(self) -> Iterator[Alternative]:
        return (self[row] for row in range(len(self)))

    @overload
    def __getitem__(self, index: int) -> Alternative: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Alternative]: ...
    def __getitem__(self, index: int | slice) -> Alternative | Sequence[Alternative]:
        if isinstance(index, slice):
            return tuple(self[row] for row in range(len(self))[index])
        return Alternative(
            variant=int(self.variants[index]),
            measures={
                measure: _or_none(quantity)
                for measure, quantity in zip(self.measures, self.quantities[index].tolist(), strict=True)
            },
            samples={
                measure: tuple(
                    _or_none(value)
                    for value, ran in zip(samples.values[index].tolist(), samples.ran[index].tolist(), strict=True)
                    if ran
                )
                for measure, samples in self.samples.items()
            },
        )


def tabulated(alternatives: Sequence[Alternative]) -> EvidenceTable:
    """The alternatives as a table by ascending id; a table is returned as it is.

    Args:
        alternatives: Alternatives that have the same measures and the same sampled measures.
    """
    if isinstance(alternatives, EvidenceTable):
        return alternatives
    import numpy as np

    by_id = sorted(alternatives, key=lambda alternative: alternative.variant)
    measures = tuple(dict.fromkeys(measure for alternative in by_id for measure in alternative.measures))
    # None becomes NaN, which compares false and propagates: unknown stays unknown.
    quantities = np.array(
        [[alternative.measures.get(measure) for measure in measures] for alternative in by_id], dtype=np.float64
    ).reshape(len(by_id), len(measures))
    sampled = tuple(dict.fromkeys(measure for alternative in by_id for measure in alternative.samples))
    return EvidenceTable(
        variants=np.array([alternative.variant for alternative in by_id], dtype=np.int64),
        measures=measures,
        quantities=quantities,
        samples={measure: _samples([one.samples.get(measure, ()) for one in by_id]) for measure in sampled},
    )


def check_evidence(alternatives: Sequence[Alternative]) -> None:
    """Check that there are alternatives, each given once, with finite quantities.

    Raises:
        TradeoffError: It is not so.
    """
    if not len(alternatives):
        raise TradeoffError("there are no alternatives to choose from", hint="run the study's variants first")
    if isinstance(alternatives, EvidenceTable):
        return
    seen: set[int] = set()
    for alternative in alternatives:
        if alternative.variant in seen:
            raise _given_twice(alternative.variant)
        seen.add(alternative.variant)
        for measure, quantity in alternative.measures.items():
            if quantity is not None and not math.isfinite(quantity):
                raise _not_finite(measure, alternative.variant, quantity)
        for measure, row in alternative.samples.items():
            for quantity in row:
                if quantity is not None and not math.isfinite(quantity):
                    raise _not_finite(measure, alternative.variant, quantity)


def _samples(rows: Sequence[tuple[float | None, ...]]) -> Samples:
    import numpy as np

    most = max((len(row) for row in rows), default=0)
    values = np.full((len(rows), most), np.nan)
    ran = np.zeros((len(rows), most), dtype=np.bool_)
    for place, row in enumerate(rows):
        values[place, : len(row)] = np.array(row, dtype=np.float64)
        ran[place, : len(row)] = True
    return Samples(values=values, ran=ran)


def _or_none(quantity: float) -> float | None:
    return None if math.isnan(quantity) else quantity


def _given_twice(variant: int) -> TradeoffError:
    return TradeoffError(f"variant {variant} is given twice", hint="give every alternative its own id")


def _not_finite(measure: str, variant: int, quantity: float) -> TradeoffError:
    return TradeoffError(
        f"{measure!r} of variant {variant} must be finite or None, got {quantity:g}",
        hint="give None where it is unknown",
    )
