"""Workload: the objects of a study's trials, assigned to seeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One kind of object of a workload, known to the robot.

    Attributes:
        id: Its name.
        replicates: Number of its seeds in each block of seeds.
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
        """Case of a trial.

        Each block of seeds, as long as the cases have replicates in total, contains each case as often as its
        replicates. Independent of the design and of a study's number of replicates.

        Returns:
            The case; None without a workload.
        """
        if not self.cases:
            return None
        block = _block(tuple(case.replicates for case in self.cases))
        return self.cases[block[seed % len(block)]]


ONE_WORKLOAD = Workload()
"""Every trial has the scene's object."""


@lru_cache(maxsize=64)
def _block(replicates: Sequence[int]) -> tuple[int, ...]:
    """Cases of a block of seeds in an even sequence: the next case is the one with the greatest deficit."""
    total = int(math.fsum(replicates))
    counts = [0] * len(replicates)
    order = []
    for position in range(1, total + 1):
        behind = [share * position - total * count for share, count in zip(replicates, counts, strict=True)]
        chosen = behind.index(max(behind))
        counts[chosen] += 1
        order.append(chosen)
    return tuple(order)
