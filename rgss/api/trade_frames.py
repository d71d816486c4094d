"""A trade-off and its robustness as pandas frames, with the columns of `rgss.api.columns`."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from rgss.api.column import Column
from rgss.api.columns import FRAMES
from rgss.api.frames import Row, described_frame
from rgss.decision.robustness import FactorLevels, Part, Robustness, StudyEffects, WeightRobustness
from rgss.decision.what_if import Change, Scenario
from rgss.errors import TradeoffError
from rgss.tradeoff import Decision, PortfolioDecision, TradeProblem
from rgss.tradeoff.programs import Enumeration, single_values
from rgss.tradeoff.robustness import Effect, pareto_front

if TYPE_CHECKING:
    import pandas as pd

Result = TypeVar("Result")

_TIMES = " × "


def ranking_frame(decision: Decision) -> pd.DataFrame:
    """One row for each feasible variant, best first."""
    rows = []
    for place, ranked in enumerate(decision.ranking, start=1):
        rows.append(
            {
                "place": place,
                "variant": ranked.variant,
                "value": ranked.value,
                "tied": ranked.variant in decision.ties,
                "near_tie": ranked.variant in decision.near_ties,
                **{f"objective_{number}": value for number, value in enumerate(ranked.objectives, start=1)},
            }
        )
    numbers = [str(number) for number in range(1, len(decision.objectives) + 1)]
    return described_frame("ranking", rows, _filled("ranking", "N", numbers))


def pareto_frame(problem: TradeProblem, enumeration: Enumeration) -> pd.DataFrame:
    """One row for each feasible variant.

    Args:
        problem: The trade-off.
        enumeration: Its alternatives.
    """
    variants, measures = enumeration.variants.tolist(), problem.weighting.deciding_measures
    values = single_values(problem, enumeration.table)
    rows = []
    for point in pareto_front(values, enumeration.feasible).points:
        row: Row = {
            "variant": variants[point.row],
            "support": point.support.value,
            "shortfall": point.shortfall,
            "dominated_by": None if point.dominated_by is None else variants[point.dominated_by],
        }
        row |= {f"value_{name}": float(value) for name, value in zip(measures, values[point.row], strict=True)}
        rows.append(row)
    return described_frame("pareto", rows, _filled("pareto", "MEASURE", measures))


def weights_frame(found: Robustness) -> pd.DataFrame:
    """One row for each measure with a weight above 0.

    Raises:
        TradeoffError: The weights were not analysed, or this could not be computed.
    """
    rows = [
        {
            "measure": measure,
            "weight": float(weight),
            "low": one.low,
            "high": one.high,
            "below": _names(found.variants[row] for row in one.below),
            "above": _names(found.variants[row] for row in one.above),
        }
        for measure, weight, one in zip(
            found.measures, found.weights, _computed(found, Part.RANGES, _weighting(found).ranges), strict=True
        )
    ]
    return described_frame("weights", rows)


def acceptability_frame(found: Robustness) -> pd.DataFrame:
    """One row for each variant.

    Raises:
        TradeoffError: The weights were not analysed, or this could not be computed.
    """
    weighting = _weighting(found)
    indices = _computed(found, Part.ACCEPTABILITY, weighting.acceptability)
    errors = indices.rank_errors[:, 0] if weighting.first_errors is None else weighting.first_errors
    rows = []
    for number, variant in enumerate(found.variants):
        row: Row = {
            "variant": variant,
            "first": float(indices.first[number]),
            "first_error": float(errors[number]),
            "unranked": float(indices.unranked[number]),
            "confidence": float(indices.confidence[number]),
        }
        central = indices.central_weights[number]
        row |= {f"central_{name}": float(weight) for name, weight in zip(found.measures, central, strict=True)}
        rows.append(row)
    return described_frame("acceptability", rows, _filled("acceptability", "MEASURE", found.measures))


def computed_effects(found: Robustness) -> StudyEffects:
    """The effects of an analysis.

    Raises:
        TradeoffError: They could not be computed.
    """
    return _computed(found, Part.EFFECTS, None if Part.EFFECTS in found.not_computed else found.effects)


def effects_frame(effects: StudyEffects) -> pd.DataFrame:
    """One row for each measure, factor or pair of factors, and level of each.

    For sampled designs there are no effects of levels; one row for each factor has its share.
    """
    rows: list[Row] = []
    for one in effects.measures:
        row = {"measure": one.measure, "unit": one.unit}
        for factor, index in one.sampled.items():
            shares = {"share": index.share, "share_low": index.low, "share_high": index.high}
            rows.append({**row, "factors": factor, "levels": "", **shares})
        if one.analysis is not None:
            for effect in one.analysis.effects:
                rows += [{**row, **cells} for cells in _effect_rows(effect, one.factors)]
    return described_frame("effects", rows)


def changes_frame(scenario: Scenario | None) -> pd.DataFrame:
    """One row for each supposition, and for each weight that follows."""
    changes: list[tuple[Change, bool]] = []
    if scenario is not None:
        changes = [(one, True) for one in scenario.changes] + [(one, False) for one in scenario.rescaled]
    rows = [
        {"what": one.id, "before": one.before, "after": one.after, "unit": one.unit, "asked": asked}
        for one, asked in changes
    ]
    readings = () if scenario is None else scenario.readings
    rows += [{"what": one.supposition, "before": None, "after": None, "unit": "", "asked": True} for one in readings]
    settings = () if scenario is None else scenario.settings
    rows += [
        {"what": f"{one.id}={one.after}", "before": None, "after": None, "unit": "", "asked": True} for one in settings
    ]
    return described_frame("changes", rows)


def portfolio_frame(portfolio: PortfolioDecision) -> pd.DataFrame:
    """One row for each study that the portfolio serves; no row if no portfolio serves all of them."""
    rows = [
        {
            "study": one.task,
            "member": one.member,
            "variant": one.variant,
            "value": one.value,
            "status": portfolio.status.value,
            "gap": portfolio.gap,
        }
        for one in portfolio.assignments
    ]
    return described_frame("portfolio", rows)


def _weighting(found: Robustness) -> WeightRobustness:
    if found.weighting is None:
        raise TradeoffError(
            f"the weights were not analysed: {found.refused['weights']}", hint="robustness().refused has the reasons"
        )
    return found.weighting


def _computed(found: Robustness, part: Part, result: Result | None) -> Result:
    if result is None:
        why = found.not_computed[part]
        raise TradeoffError(f"{part.words}: not computed: {why.reason}", hint=why.remedy)
    return result


def _effect_rows(effect: Effect, factors: Sequence[FactorLevels]) -> list[Row]:
    levels = {factor.id: factor.levels for factor in factors}
    named = [levels[factor] for factor in effect.factors]
    shares = {"share": effect.share, "share_low": effect.share_low, "share_high": effect.share_high}
    return [
        {
            "factors": _TIMES.join(effect.factors),
            "levels": _TIMES.join(names[at] for names, at in zip(named, place, strict=True)),
            "effect": float(effect.levels[place]),
            "low": _at(effect.low, place),
            "high": _at(effect.high, place),
            **shares,
        }
        for place in itertools.product(*(range(len(names)) for names in named))
    ]


def _at(values: Any, place: tuple[int, ...]) -> float | None:
    return None if values is None else float(np.asarray(values)[place])


def _names(variants: Iterable[int]) -> str:
    return ", ".join(str(variant) for variant in variants)


def _filled(frame: str, part: str, names: Iterable[str]) -> tuple[Column, ...]:
    """The columns of a frame with a placeholder in capitals replaced by names."""
    known = list(names)
    found: list[Column] = []
    for column in FRAMES[frame].columns:
        if column.name.endswith(f"_{part}"):
            found += [replace(column, name=column.name.replace(part, name)) for name in known]
        else:
            found.append(column)
    return tuple(found)
