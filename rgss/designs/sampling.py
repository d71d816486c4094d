"""Sampled designs of a space whose full factorial is too large or infinite.

A point is a row of numbers from 0 to 1, one for each factor; each number selects a level or a value. The rows are those
of SciPy's quasi-Monte Carlo engines. Scrambled Sobol points (Owen 1998, *Scrambling Sobol' and Niederreiter-Xing
points*; Joe and Kuo 2008 for the direction numbers) have exactly one point in each of ``size`` equal parts of every
axis and spread evenly over any few axes together; a larger sample of the same seed begins with the smaller one. A Latin
hypercube (McKay, Beckman and Conover 1979) has the same property on every axis for any size.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from math import floor

from rgss.designs.factors import Factor, Level


class SamplingMethod(str, Enum):
    """Method of sampling the unit cube."""

    SOBOL = "sobol"
    LATIN_HYPERCUBE = "latin_hypercube"


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """Sample of a design space.

    Attributes:
        method: Sampling method.
        size: Number of points, including repetitions.
        seed: Seed of the draws.
        points: The level of each factor at each distinct point, by its number from 1.
        repeats: The number of the first equal point, by the number of a repeated point.
    """

    method: SamplingMethod
    size: int
    seed: int
    points: Mapping[int, tuple[Level, ...]]
    repeats: Mapping[int, int]


def unit_points(method: SamplingMethod, *, dimensions: int, size: int, seed: int) -> list[tuple[float, ...]]:
    """Points of the unit cube, a deterministic function of the arguments.

    Args:
        method: Sampling method.
        dimensions: Number of coordinates.
        size: Number of points; a power of two for a Sobol sample.
        seed: Seed of the draws.
    """
    from scipy.stats import qmc

    if method is SamplingMethod.SOBOL:
        points = qmc.Sobol(dimensions, scramble=True, rng=seed).random_base2(size.bit_length() - 1)
    else:
        points = qmc.LatinHypercube(dimensions, rng=seed).random(size)
    return [tuple(float(number) for number in row) for row in points]


def sample_factors(factors: Sequence[Factor], *, method: SamplingMethod, size: int, seed: int) -> Sample:
    """Select a level of each factor at each point.

    Levels have equal parts of the unit interval. In a Latin hypercube every level of a factor then has ``size /
    levels`` points, rounded up or down; in a Sobol sample exactly that where the number of levels is a power of two,
    and less than two points more or fewer otherwise.

    Args:
        factors: The factors, with levels or a range each.
        method: Sampling method.
        size: Number of points; a power of two for a Sobol sample.
        seed: Seed of the draws.
    """
    rows = unit_points(method, dimensions=len(factors), size=size, seed=seed)
    points: dict[int, tuple[Level, ...]] = {}
    repeats: dict[int, int] = {}
    first: dict[tuple[str, ...], int] = {}
    for number, row in enumerate(rows, start=1):
        point = tuple(
            _level(factor, share, parts=size if method is SamplingMethod.LATIN_HYPERCUBE else None)
            for factor, share in zip(factors, row, strict=True)
        )
        ids = tuple(level.id for level in point)
        if ids in first:
            repeats[number] = first[ids]
        else:
            first[ids] = number
            points[number] = point
    return Sample(method=method, size=size, seed=seed, points=points, repeats=repeats)


def _level(factor: Factor, share: float, *, parts: int | None) -> Level:
    """Level at a position in the unit interval.

    Args:
        factor: The factor.
        share: The position.
        parts: Number of equal parts of the interval with one point each; levels are assigned to whole parts, so that no
            boundary between levels is inside a part.
    """
    if factor.span is not None:
        return factor.span.at(share)
    levels = len(factor.levels)
    place = floor(share * levels) if parts is None else floor(share * parts) * levels // parts
    return factor.levels[place]
