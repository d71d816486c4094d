"""Robustness of a decision with derived figures for its pages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.assessment import leading_measures
from rgss.decision.robustness import AssumptionFinding, MeasureEffects, Part, Robustness, leading_factors
from rgss.decision.study_decision.contenders import Contender, contenders_of
from rgss.decision.study_decision.limit_moves import LimitMoves, limit_moves
from rgss.studies import Project
from rgss.tradeoff.robustness import Support

_NO_DISTANCE = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class WeightMove:
    """Least move of weights that changes the choice.

    Attributes:
        moved: The total weight that is moved.
        before: The weights of the study.
        after: The weights after the move.
        winners: The variants that then win.
    """

    moved: float
    before: Mapping[str, float] = field(hash=False)
    after: Mapping[str, float] = field(hash=False)
    winners: tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Driver:
    """Factors that drive a measure of effectiveness.

    Attributes:
        measure: The measure.
        shares: The share of its variance by factor, the largest first.
        left_out: Levels that are omitted for lack of successful trials.
        not_computed: Reason why the shares were not computed, as part of a sentence; empty if they were.
    """

    measure: str
    shares: Mapping[str, float] = field(hash=False)
    left_out: tuple[str, ...]
    not_computed: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RobustnessFindings:
    """Robustness of a decision, with its consequences for the choice.

    Attributes:
        analysis: The analyses, with the reason for each part that was not computed.
        contenders: The closest rivals.
        nearest_move: The least move of weights at which a variant that is not tied becomes one of the best; None if
            there is none, or it was not computed.
        tied_by_weights: The variants that are worth as much as the choice at these weights alone, so that the least
            move of weights towards what they are better in lets them win.
        limits: The moves of limits that change the choice.
        decisive: The assumptions that change the choice within the scanned values.
        harmless: Ids of the assumptions that do not.
        simulated: Ids of the assumptions that the trials were simulated with.
        corner: The costs, by component, that differ from the assumed ones at the worst corner.
        effects: The effects on each measure of effectiveness.
        drivers: The leading factors of each.
        sampled: True if the designs are a sample of the design space.
    """

    analysis: Robustness
    contenders: tuple[Contender, ...]
    nearest_move: WeightMove | None
    tied_by_weights: tuple[int, ...]
    limits: tuple[LimitMoves, ...]
    decisive: tuple[AssumptionFinding, ...]
    harmless: tuple[str, ...]
    simulated: tuple[str, ...]
    corner: Mapping[str, float]
    effects: tuple[MeasureEffects, ...]
    drivers: tuple[Driver, ...]
    sampled: bool

    def is_missing(self, part: Part) -> bool:
        """True if a part could not be computed."""
        return part in self.analysis.not_computed

    def variants(self, rows: tuple[int, ...]) -> tuple[int, ...]:
        """Ids of the variants of rows of the analysis."""
        return tuple(self.analysis.variants[row] for row in rows)


def robustness_findings(project: Project, found: Robustness, *, chosen: int | None) -> RobustnessFindings:
    """The findings of an analysis.

    Args:
        project: The project with its study.
        found: The analysis.
        chosen: The choice; None if there is none.
    """
    followed = [one for one in found.assumptions if one.range is not None]
    shown = {measure.id for measure in leading_measures(project)}
    effects = tuple(one for one in found.effects.measures if one.measure in shown)
    return RobustnessFindings(
        analysis=found,
        contenders=contenders_of(found),
        nearest_move=_nearest_move(found),
        tied_by_weights=_tied_by_weights(found, chosen),
        limits=limit_moves(found, chosen=chosen),
        decisive=tuple(one for one in followed if one.range is not None and not one.range.always),
        harmless=tuple(one.number.id for one in followed if one.range is not None and one.range.always),
        simulated=tuple(one.number.id for one in found.assumptions if one.simulated and one.columns),
        corner=_corner(found),
        effects=effects,
        drivers=tuple(
            Driver(
                measure=one.measure,
                shares=leading_factors(one),
                left_out=tuple(one.left_out),
                not_computed=one.not_computed,
            )
            for one in effects
        ),
        sampled=project.designs.sample is not None,
    )


def _nearest_move(found: Robustness) -> WeightMove | None:
    shifts = () if found.weighting is None else found.weighting.shifts or ()
    # What is the only best one for no weights can be tied, at best, and does not win.
    extreme = {point.row for point in found.front.points if point.support is Support.EXTREME}
    others = [shift for shift in shifts if shift.distance > _NO_DISTANCE and extreme.intersection(shift.rows)]
    if not others:
        return None
    nearest = min(others, key=lambda shift: (shift.sum_distance, shift.rows))
    return WeightMove(
        moved=nearest.sum_distance / 2.0,
        before=dict(zip(found.measures, found.weights.tolist(), strict=True)),
        after=dict(zip(found.measures, nearest.nearest_in_sum.tolist(), strict=True)),
        winners=tuple(found.variants[row] for row in nearest.rows),
    )


def _tied_by_weights(found: Robustness, chosen: int | None) -> tuple[int, ...]:
    shifts = () if found.weighting is None else found.weighting.shifts or ()
    here = [[found.variants[row] for row in shift.rows] for shift in shifts if shift.distance <= _NO_DISTANCE]
    return tuple(sorted(variant for rows in here if chosen not in rows for variant in rows))


def _corner(found: Robustness) -> Mapping[str, float]:
    box = found.costs
    if box is None or box.range.corner is None:
        return {}
    return {
        one.component: float(value)
        for one, value in zip(box.numbers, box.range.corner, strict=True)
        if abs(value - one.value) > 1e-6 * max(1.0, one.value)
    }
