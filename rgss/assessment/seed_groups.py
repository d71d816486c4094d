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
        last: The last seed.
        variants: Ids of the variants, ascending.
        absent: The seeds between that have no trial, ascending.
        added: Number of seeds beyond the study's replicates.
    """

    first: int
    last: int
    variants: tuple[int, ...]
    absent: tuple[int, ...] = ()
    added: int = 0

    @property
    def replicates(self) -> int:
        """Number of seeds."""
        return self.last - self.first + 1 - len(self.absent)


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
    groups: dict[tuple[int, ...], list[int]] = {}
    for entry in measured:
        if entry.records:
            groups.setdefault(tuple(record.seed for record in entry.records), []).append(entry.variant.id)
    return tuple(
        SeedGroup(
            first=seeds[0],
            last=seeds[-1],
            variants=tuple(sorted(ids)),
            absent=tuple(sorted(set(range(seeds[0], seeds[-1] + 1)) - set(seeds))),
            added=max(0, len(seeds) - project.study.replicates),
        )
        for seeds, ids in sorted(groups.items(), key=lambda item: (item[0][-1] - item[0][0], item[0]))
    )
