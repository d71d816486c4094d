"""Seeds that were read of each variant after replication until decided."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.assessment.measuring import VariantMeasures
from rgss.studies import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class SeedGroup:
    """Variants of which the same seeds are read.

    Attributes:
        first: The first seed.
        last: The last seed; all between are read too.
        variants: Ids of the variants, ascending.
    """

    first: int
    last: int
    variants: tuple[int, ...]

    @property
    def replicates(self) -> int:
        """Number of seeds."""
        return self.last - self.first + 1


def sequential_seeds(project: Project, measured: Sequence[VariantMeasures]) -> tuple[SeedGroup, ...]:
    """The seeds that were read, with variants of equal seeds grouped, the fewest seeds first.

    Args:
        project: The project with its study.
        measured: Every variant with its records, in the order of their seeds.

    Returns:
        The groups; none if the study has a fixed number of replicates.
    """
    if not project.study.is_sequential:
        return ()
    groups: dict[tuple[int, int], list[int]] = {}
    for entry in measured:
        if entry.records:
            groups.setdefault((entry.records[0].seed, entry.records[-1].seed), []).append(entry.variant.id)
    return tuple(
        SeedGroup(first=first, last=last, variants=tuple(sorted(ids)))
        for (first, last), ids in sorted(groups.items(), key=lambda item: (item[0][1] - item[0][0], item[0]))
    )
