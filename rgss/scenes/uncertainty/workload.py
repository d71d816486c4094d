"""Workload: the objects that a study's trials carry, assigned to seeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One kind of object of a workload; the robot knows which it carries.

    Attributes:
        id: Its name.
        replicates: How many of each block of seeds it has.
        mass_kg: Mass of the object; None for the scene's.
        radius_m: Radius; None for the scene's.
        height_m: Height; None for the scene's.
        friction: Friction coefficient; None for the scene's.
    """

    id: str
    replicates: int = 1
    mass_kg: float | None = None
    radius_m: float | None = None
    height_m: float | None = None
    friction: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Workload:
    """The cases of a study.

    Attributes:
        cases: The cases; empty for the scene's object alone.
    """

    cases: tuple[Case, ...] = ()

    def case_of(self, seed: int) -> Case | None:
        """The case of a trial: each block of as many seeds as the cases have replicates has each that often.

        The same for every design, and independent of how many replicates a study has.

        Args:
            seed: The trial's seed.

        Returns:
            The case; None where there is no workload.
        """
        if not self.cases:
            return None
        block = _block(tuple(case.replicates for case in self.cases))
        return self.cases[block[seed % len(block)]]


ONE_WORKLOAD = Workload()
"""Every trial has the scene's object."""


@lru_cache(maxsize=64)
def _block(replicates: Sequence[int]) -> tuple[int, ...]:
    """The cases of a block of seeds in turn, spread as evenly as may be: next is the one that is most behind."""
    total = int(math.fsum(replicates))
    counts = [0] * len(replicates)
    order = []
    for position in range(1, total + 1):
        behind = [share * position - total * count for share, count in zip(replicates, counts, strict=True)]
        chosen = behind.index(max(behind))
        counts[chosen] += 1
        order.append(chosen)
    return tuple(order)
