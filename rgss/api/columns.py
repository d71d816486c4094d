"""Every frame of the public interface with its columns: the one place that says what they mean.

The tables of docs/api.md are made from here, and a test holds every frame against it.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rgss.api.column import Column, FrameDescription, Kind
from rgss.api.metric_columns import phase_metric_columns, recorded_column, trial_metric_columns

_VARIANT = Column(name="variant", meaning="id of the design variant", unit="1", kind=Kind.COUNT)
_SEED = Column(
    name="seed", meaning="seed of the trial; replicate r has the study's seed + r", unit="1", kind=Kind.COUNT
)
_MEASURE = Column(name="measure", meaning="id of the measure")
_SAID = "as `unit` says"
_UNIT = Column(name="unit", meaning="unit of the numbers of the row")

_VARIANTS = FrameDescription(
    name="variants",
    row="a design variant",
    index=(_VARIANT,),
    columns=(
        Column(
            name="PARAMETER",
            meaning="value of a design parameter; id, name and unit make the name, as in m_f_finger_mass_kg",
            unit="the parameter's, in SI",
            kind=Kind.NUMBER,
        ),
        Column(name="level_FACTOR", meaning="level that the variant has of a factor"),
        Column(name="trials", meaning="trials with evidence", unit="1", kind=Kind.COUNT),
        Column(name="missing", meaning="trials without evidence", unit="1", kind=Kind.COUNT),
        Column(name="screening", meaning="what became of it in screening; missing if the study has none"),
        Column(
            name="feasible",
            meaning="whether it meets every demand of the trade-off; missing until all trials have evidence",
            kind=Kind.TRUTH,
        ),
        Column(name="violates", meaning="demands that it does not meet, with commas between; empty if it meets all"),
        Column(
            name="weighted_value",
            meaning="its value in the trade-off, whatever it violates",
            unit="1",
            kind=Kind.NUMBER,
        ),
    ),
)

_TRIALS = FrameDescription(
    name="trials",
    row="a variant and a seed",
    index=(_VARIANT, _SEED),
    columns=(
        Column(name="key", meaning="what the evidence store knows the trial by"),
        Column(name="fidelity", meaning="kinematic, dynamic or contact"),
        Column(
            name="success",
            meaning="whether all states are complete and the object is where it should be",
            kind=Kind.TRUTH,
        ),
        Column(name="failure", meaning="what ended it; missing on success"),
        Column(name="failed_phase", meaning="the state in which it ended; missing on success"),
        Column(name="failure_detail", meaning="the numbers that show the failure; missing on success"),
        *trial_metric_columns(),
    ),
)

_PHASES = FrameDescription(
    name="phases",
    row="a trial and one of its eight states",
    index=(_VARIANT, _SEED, Column(name="phase", meaning="the state")),
    columns=(
        Column(name="outcome", meaning="completed, failed or not_run"),
        recorded_column("duration_s"),
        Column(name="planning_outcome", meaning="how the planning of the move ended; missing if it is not planned"),
        recorded_column("planning_checks", Kind.COUNT),
        Column(
            name="planning_simplification_checks",
            meaning="state-validity checks of the simplification, its final check included",
            unit="1",
            kind=Kind.COUNT,
        ),
        recorded_column("planning_time_s"),
        recorded_column("path_length_m"),
        *phase_metric_columns(),
    ),
)

_MEASURES = FrameDescription(
    name="measures",
    row="a variant and a measure",
    index=(_VARIANT, _MEASURE),
    columns=(
        Column(name="value", meaning="estimate; missing where no trial gave one", unit=_SAID, kind=Kind.NUMBER),
        Column(name="low", meaning="lower end of the 95 % interval", unit=_SAID, kind=Kind.NUMBER),
        Column(name="high", meaning="upper end of the 95 % interval", unit=_SAID, kind=Kind.NUMBER),
        _UNIT,
        Column(
            name="n",
            meaning="trials that the estimate stands on; 0 if it follows from the design alone or is missing",
            unit="1",
            kind=Kind.COUNT,
        ),
        Column(name="kind", meaning="moe, mop or supplementary"),
        Column(name="better", meaning="which values are better: higher, lower or none"),
    ),
)

_VERDICTS = FrameDescription(
    name="verdicts",
    row="a variant and a requirement with a criterion",
    index=(_VARIANT, Column(name="requirement", meaning="id of the requirement")),
    columns=(
        Column(name="verdict", meaning="met, not_met, inconclusive, not_run or stale"),
        Column(name="changed", meaning="why it is stale, with commas between; empty if it is not"),
        _MEASURE,
        Column(name="statistic", meaning="which number of the estimate is compared: value, low or high"),
        Column(name="comparison", meaning="how it must stand to the threshold"),
        Column(name="threshold", meaning="the bound", unit=_SAID, kind=Kind.NUMBER),
        Column(name="unit", meaning="unit of the bound"),
    ),
)

_RANKING = FrameDescription(
    name="ranking",
    row="a feasible variant, best first",
    index=(Column(name="place", meaning="its place, from 1; equals stand by ascending id", unit="1", kind=Kind.COUNT),),
    columns=(
        _VARIANT,
        Column(name="value", meaning="weighted value, from 0 to 1", unit="1", kind=Kind.NUMBER),
        Column(name="tied", meaning="whether it is as good as the best", kind=Kind.TRUTH),
        Column(name="near_tie", meaning="whether it is not tied but within the practical margin", kind=Kind.TRUTH),
        Column(
            name="objective_N",
            meaning="what the program optimises in turn, N from 1",
            unit="the program's",
            kind=Kind.NUMBER,
        ),
    ),
)

_PARETO = FrameDescription(
    name="pareto",
    row="a feasible variant",
    index=(_VARIANT,),
    columns=(
        Column(
            name="support", meaning="extreme, supported, weakly_supported or unsupported on the front, or dominated"
        ),
        Column(
            name="shortfall",
            meaning="least by which the best is worth more, over all weights; missing if dominated",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(
            name="dominated_by", meaning="a variant that dominates it; missing on the front", unit="1", kind=Kind.COUNT
        ),
        Column(
            name="value_MEASURE",
            meaning="what it is worth in a weighted measure, from 0 to 1",
            unit="1",
            kind=Kind.NUMBER,
        ),
    ),
)

_EFFECTS = FrameDescription(
    name="effects",
    row="a measure, one or two factors, and a level of each",
    index=(
        _MEASURE,
        Column(
            name="factors", meaning="the factor, or two with a times sign between for what they do beyond each alone"
        ),
        Column(name="levels", meaning="its level, or the levels of both with a times sign between"),
    ),
    columns=(
        Column(
            name="effect",
            meaning="how far the mean there is from what the terms above say",
            unit=_SAID,
            kind=Kind.NUMBER,
        ),
        Column(
            name="low", meaning="lower end of its 95 % interval; missing without noise", unit=_SAID, kind=Kind.NUMBER
        ),
        Column(name="high", meaning="upper end of its 95 % interval", unit=_SAID, kind=Kind.NUMBER),
        _UNIT,
        Column(
            name="share", meaning="share of the differences between designs, of the term", unit="1", kind=Kind.NUMBER
        ),
        Column(name="share_low", meaning="lower end of the share's 95 % interval", unit="1", kind=Kind.NUMBER),
        Column(name="share_high", meaning="upper end of the share's 95 % interval", unit="1", kind=Kind.NUMBER),
    ),
)

_WEIGHTS = FrameDescription(
    name="weights",
    row="a measure with a weight above 0",
    index=(_MEASURE,),
    columns=(
        Column(name="weight", meaning="its weight in the decision", unit="1", kind=Kind.NUMBER),
        Column(
            name="low", meaning="least weight at which the chosen variant is still best", unit="1", kind=Kind.NUMBER
        ),
        Column(name="high", meaning="greatest such weight", unit="1", kind=Kind.NUMBER),
        Column(name="below", meaning="variants that win just below, with commas between; empty if none"),
        Column(name="above", meaning="variants that win just above, with commas between; empty if none"),
    ),
)

_ACCEPTABILITY = FrameDescription(
    name="acceptability",
    row="a variant",
    index=(_VARIANT,),
    columns=(
        Column(name="first", meaning="share of weights and noise for which it is the best", unit="1", kind=Kind.NUMBER),
        Column(name="first_error", meaning="standard error of that", unit="1", kind=Kind.NUMBER),
        Column(name="unranked", meaning="share of noise in which it cannot be chosen", unit="1", kind=Kind.NUMBER),
        Column(
            name="confidence",
            meaning="probability that it is best at its central weights; missing if it never is",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(
            name="central_MEASURE", meaning="mean weight of a measure where it is the best", unit="1", kind=Kind.NUMBER
        ),
    ),
)

_CHANGES = FrameDescription(
    name="changes",
    row="what is supposed, or follows from it",
    index=(Column(name="what", meaning="what is another, such as weight.t_e"),),
    columns=(
        Column(name="before", meaning="its value in the project", unit=_SAID, kind=Kind.NUMBER),
        Column(name="after", meaning="the value that is supposed", unit=_SAID, kind=Kind.NUMBER),
        Column(name="unit", meaning="unit of both"),
        Column(name="asked", meaning="whether it was asked for; otherwise it follows", kind=Kind.TRUTH),
    ),
)

_FLEET = FrameDescription(
    name="fleet",
    row="a study that the fleet serves",
    index=(Column(name="study", meaning="file of the study"),),
    columns=(
        Column(name="member", meaning="member of the fleet that serves it: a component, or a variant"),
        Column(name="variant", meaning="id of the design variant that serves it", unit="1", kind=Kind.COUNT),
        Column(name="value", meaning="its weighted value in that study", unit="1", kind=Kind.NUMBER),
        Column(name="status", meaning="of the fleet: optimal, or best found where that is not proven"),
        Column(name="gap", meaning="by how much another fleet can be better at most", unit="1", kind=Kind.NUMBER),
    ),
)

_COURSE = FrameDescription(
    name="course",
    row="an instant of a trial with contact, in simulated time without planning",
    index=(Column(name="time_s", meaning="time from the start of the first state", unit="s", kind=Kind.NUMBER),),
    columns=(
        Column(name="phase", meaning="the state that ran"),
        Column(name="joint_position_rad", meaning="position, of each joint", unit="rad", kind=Kind.NUMBER, items=0),
        Column(
            name="tool_position_m", meaning="grasp centre in the world: x, y, z", unit="m", kind=Kind.NUMBER, items=3
        ),
        Column(name="tool_speed_m_s", meaning="speed of the grasp centre", unit="m/s", kind=Kind.NUMBER),
        Column(
            name="workpiece_position_m", meaning="object in the world: x, y, z", unit="m", kind=Kind.NUMBER, items=3
        ),
        Column(
            name="finger_travel_m", meaning="how far it had closed, of each finger", unit="m", kind=Kind.NUMBER, items=0
        ),
        Column(
            name="finger_force_n",
            meaning="normal force on the object, of each finger",
            unit="N",
            kind=Kind.NUMBER,
            items=0,
        ),
        Column(
            name="commanded_force_n", meaning="force that each finger is told to press with", unit="N", kind=Kind.NUMBER
        ),
        Column(name="grip_margin", meaning="friction available over friction needed", unit="1", kind=Kind.NUMBER),
    ),
)

FRAMES: Mapping[str, FrameDescription] = MappingProxyType(
    {
        frame.name: frame
        for frame in (
            _VARIANTS,
            _TRIALS,
            _PHASES,
            _MEASURES,
            _VERDICTS,
            _RANKING,
            _PARETO,
            _EFFECTS,
            _WEIGHTS,
            _ACCEPTABILITY,
            _FLEET,
            _CHANGES,
            _COURSE,
        )
    }
)
"""Every frame by its name."""
