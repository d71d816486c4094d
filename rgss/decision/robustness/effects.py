"""Effects of the design parameters on the measures, over all designs of a study."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.assessment import VariantMeasures, replicates_of
from rgss.decision.robustness.effect_findings import FactorLevels, MeasureEffects, StudyEffects
from rgss.designs import COMPONENT_PREFIX, DESIGN_PREFIX
from rgss.measures import Measure, MeasureKind
from rgss.studies import Project
from rgss.tradeoff.problem import Resamples
from rgss.tradeoff.robustness import (
    FEWEST_DESIGNS,
    factorial_effects,
    first_order_indices,
    largest_complete_block,
    level_terms,
    range_terms,
)

SAMPLE_RESAMPLES = 200
"""Number of resamples of sampled designs for the intervals of shares."""

_NO_FACTORS = "no factor varies"
_NOT_IN_IT = "it contains nothing that varies"


def study_effects(project: Project, measured: Sequence[VariantMeasures], resamples: Resamples | None) -> StudyEffects:
    """Main effects and interactions of two factors on every measure, with bootstrap intervals.

    A factor may set several design parameters at once; their effects are those of the factor. A
    measure that designs without success lack is analysed over the largest block of levels
    in which every combination has it; omitted levels are reported.

    A measure that follows from the design alone has no noise, and its effects have no intervals.
    For a sample of designs, which is not a table of levels, only each factor's own share is
    estimated, over the designs that have the measure.

    Args:
        project: The project.
        measured: Every variant with its estimates and records.
        resamples: Resamples of the replicates, for the intervals; None for none.
    """
    if project.designs.sample is not None:
        return _of_sample(project, measured)
    design = _Design.of(project, measured)
    replicates = {} if resamples is None else _replicate_columns(project, measured)
    found = []
    blocks: dict[bytes, tuple[tuple[int, ...], ...] | None] = {}
    for measure in _analysed(project):
        estimates = design.arranged([_number(entry.estimates[measure.id].value) for entry in measured])
        resampled = None
        if resamples is not None and measure.id in replicates:
            resampled = resamples.means(replicates.pop(measure.id))
        known = np.isfinite(estimates)
        if known.tobytes() not in blocks:
            blocks[known.tobytes()] = largest_complete_block(known) if design.factors else None
        block = blocks[known.tobytes()]
        found.append(_effects(measure.id, measure.unit, design, block, estimates, resampled, resamples))
    return StudyEffects(
        factors=design.factors,
        constants=tuple(
            parameter.id
            for parameter in project.designs.parameters
            if not any(parameter.id in factor.parameters for factor in design.factors)
        ),
        measures=tuple(found),
    )


def _analysed(project: Project) -> Iterator[Measure]:
    """The measures whose effects are analysed."""
    for measure in project.measures.measures:
        if measure.kind is not MeasureKind.SUPPLEMENTARY or measure.better.value != "none":
            yield measure


def _replicate_columns(project: Project, measured: Sequence[VariantMeasures]) -> dict[str, NDArray[np.float64]]:
    """Quantities by replicate of each variant, shape (n, r), for each measure with noise.

    Arrays are filled row by row, since lists of Python objects would take four times the memory.
    """
    names = [measure.id for measure in _analysed(project) if measure.id in project.measures.noisy]
    columns: dict[str, NDArray[np.float64]] = {}
    for place, entry in enumerate(measured):
        row = replicates_of(project.measures, entry, only=names)
        for name in names:
            if name not in columns:
                columns[name] = np.full((len(measured), len(row[name])), np.nan)
            columns[name][place] = np.array(row[name], dtype=np.float64)
    return columns


def _of_sample(project: Project, measured: Sequence[VariantMeasures]) -> StudyEffects:
    """Shares of the factors of sampled designs; a repeated point counts as often as it was drawn."""
    sample, generator = project.designs.sample, np.random.default_rng(project.study.seed)
    repeats = Counter(sample.repeats.values()) if sample is not None else Counter()
    rows = [entry for entry in measured for _ in range(1 + repeats[entry.variant.id])]
    factors = tuple(
        FactorLevels(
            id=factor.id,
            parameters=(factor.span.parameter,) if factor.span is not None else tuple(factor.levels[0].values),
            levels=tuple(level.id for level in factor.levels),
        )
        for factor in project.designs.factors
        if factor.span is not None or len(factor.levels) > 1
    )
    columns = {factor.id: _column(factor, rows) for factor in factors}
    found = []
    for measure in _analysed(project):
        values = np.array([_number(entry.estimates[measure.id].value) for entry in rows])
        known = np.isfinite(values)
        missing = _missing_of_sample(int(known.sum()), factors)
        contained = () if missing else tuple(factor for factor in factors if _may_act(project, measure, factor))
        missing = missing or ("" if contained else _NOT_IN_IT)
        indices = (
            first_order_indices(
                [_terms(factor, columns[factor.id][known]) for factor in contained],
                values[known],
                resamples=SAMPLE_RESAMPLES,
                generator=generator,
            )
            if contained
            else ()
        )
        found.append(
            MeasureEffects(
                measure=measure.id,
                unit=measure.unit,
                factors=factors,
                left_out=() if known.all() else (f"{int((~known).sum())} designs",),
                designs=int(known.sum()),
                analysis=None,
                sampled={factor.id: index for factor, index in zip(contained, indices, strict=True)},
                not_computed=missing,
            )
        )
    varying = {parameter for factor in factors for parameter in factor.parameters}
    return StudyEffects(
        factors=factors,
        constants=tuple(parameter.id for parameter in project.designs.parameters if parameter.id not in varying),
        measures=tuple(found),
    )


def _may_act(project: Project, measure: Measure, factor: FactorLevels) -> bool:
    """False if a measure that follows from the design alone does not contain what a factor sets.

    A sample that is spread over few points confounds such a factor with the interaction of others.
    """
    if measure.from_trials:
        return True
    used = project.measures.sources(measure.id)
    # Which component a design has may depend on any parameter.
    has_components = any(one.startswith(COMPONENT_PREFIX) for one in used)
    return has_components or any(f"{DESIGN_PREFIX}{parameter}" in used for parameter in factor.parameters)


def _missing_of_sample(known: int, factors: Sequence[FactorLevels]) -> str:
    """Reason why the shares of the factors cannot be estimated from so many designs with a value; empty if they can."""
    if not factors:
        return _NO_FACTORS
    if known >= FEWEST_DESIGNS:
        return ""
    return f"{known} of the sampled designs have a value, of at least {FEWEST_DESIGNS}"


def _column(factor: FactorLevels, rows: Sequence[VariantMeasures]) -> NDArray[np.float64]:
    """Place of each design's level, or its value if the factor has a range."""
    if factor.levels:
        return np.array([factor.levels.index(entry.variant.levels[factor.id]) for entry in rows], dtype=np.float64)
    return np.array([entry.variant.parameters[factor.parameters[0]] for entry in rows], dtype=np.float64)


def _terms(factor: FactorLevels, column: NDArray[np.float64]) -> NDArray[np.float64]:
    return level_terms(column) if factor.levels else range_terms(column)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Design:
    """Position of each variant among the combinations of levels."""

    factors: tuple[FactorLevels, ...]
    places: tuple[tuple[int, ...], ...]

    @staticmethod
    def of(project: Project, measured: Sequence[VariantMeasures]) -> _Design:
        varying = [factor for factor in project.designs.factors if len(factor.levels) > 1]
        factors = tuple(
            FactorLevels(
                id=factor.id,
                parameters=tuple(factor.levels[0].values),
                levels=tuple(level.id for level in factor.levels),
            )
            for factor in varying
        )
        return _Design(
            factors=factors,
            places=tuple(
                tuple(factor.levels.index(entry.variant.levels[factor.id]) for factor in factors) for entry in measured
            ),
        )

    def arranged(self, values: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]:
        """Values of the variants, one axis for each factor; NaN for combinations that rules exclude."""
        return np.asarray(self.all_arranged(np.array(values, dtype=np.float64)[None])[0], dtype=np.float64)

    def all_arranged(self, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """Rows of values, shape (k, n), each arranged as a table: shape (k, ...)."""
        shape = [len(factor.levels) for factor in self.factors]
        places = np.array(self.places, dtype=np.intp).reshape(len(self.places), len(shape))
        flat = np.ravel_multi_index(tuple(places.T), shape) if shape else np.zeros(len(places), dtype=np.intp)
        table = np.full((len(rows), math.prod(shape)), np.nan)
        table[:, flat] = rows
        return table.reshape(len(rows), *shape)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _ResampledBlock:
    """Means of every design of a balanced block in each resample, arranged lazily.

    Attributes:
        means: The means of the variants, shape (b, n).
        design: Levels of each variant.
        cut: The retained levels, as an index.
        shape: The number of retained levels of each varying factor.
    """

    means: NDArray[np.float64]
    design: _Design
    cut: tuple[NDArray[np.intp], ...]
    shape: Sequence[int]

    def __len__(self) -> int:
        return len(self.means)

    def __getitem__(self, some: slice, /) -> NDArray[np.float64]:
        tables = self.design.all_arranged(self.means[some])
        kept = np.array([table[self.cut] for table in tables])
        return np.asarray(kept.reshape(len(tables), *self.shape), dtype=np.float64)


def _effects(
    measure: str,
    unit: str,
    design: _Design,
    block: tuple[tuple[int, ...], ...] | None,
    estimates: NDArray[np.float64],
    resampled: NDArray[np.float64] | None,
    resamples: Resamples | None,
) -> MeasureEffects:
    if block is None:
        reason = "no block of two or more levels has a value of every combination" if design.factors else _NO_FACTORS
        return MeasureEffects(
            measure=measure, unit=unit, factors=(), left_out=(), designs=0, analysis=None, not_computed=reason
        )
    kept = [axis for axis, levels in enumerate(block) if len(levels) > 1]
    cut = np.ix_(*block)
    shape = [len(block[axis]) for axis in kept]
    factors = tuple(
        FactorLevels(
            id=design.factors[axis].id,
            parameters=design.factors[axis].parameters,
            levels=tuple(design.factors[axis].levels[level] for level in block[axis]),
        )
        for axis in kept
    )
    return MeasureEffects(
        measure=measure,
        unit=unit,
        factors=factors,
        left_out=tuple(
            f"{factor.id}={level}"
            for factor, levels in zip(design.factors, block, strict=True)
            for place, level in enumerate(factor.levels)
            if place not in levels
        ),
        designs=int(np.prod(shape)),
        analysis=factorial_effects(
            estimates[cut].reshape(shape),
            [factor.id for factor in factors],
            resampled=None
            if resampled is None
            else _ResampledBlock(means=resampled, design=design, cut=cut, shape=shape),
            probabilities=None if resamples is None or resampled is None else resamples.probabilities,
        ),
    )


def _number(value: float | None) -> float:
    return float("nan") if value is None else value
