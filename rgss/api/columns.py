"""Every frame of the public interface with its columns and their meaning.

The tables of docs/api.md are made from here, and a test compares every frame with it.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rgss.api.column import Column, FrameDescription, Kind
from rgss.api.metric_columns import phase_metric_columns, recorded_column, trial_metric_columns
from rgss.api.sensitivity_columns import ASSUMPTIONS, EXCHANGE_RATES, STAKEHOLDERS, TORNADO, WORTH_KEEPING
from rgss.api.shared_columns import AS_UNIT, MEASURE, SEED, UNIT, VARIANT
from rgss.api.trade_columns import ACCEPTABILITY, CHANGES, EFFECTS, PARETO, PORTFOLIO, RANKING, WEIGHTS

_VARIANTS = FrameDescription(
    name="variants",
    row="a design variant",
    index=(VARIANT,),
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
        Column(name="screening", meaning="outcome of its screening; missing if the study has none"),
        Column(
            name="feasible",
            meaning="true if its estimates meet every requirement, within the tolerance of the trade-off; missing "
            "until all trials have evidence",
            kind=Kind.TRUTH,
        ),
        Column(
            name="violates",
            meaning="requirements that its estimates miss, separated by commas; empty if it is feasible",
        ),
        Column(
            name="weighted_value",
            meaning="its value in the trade-off, also if it is infeasible",
            unit="1",
            kind=Kind.NUMBER,
        ),
    ),
)

_TRIALS = FrameDescription(
    name="trials",
    row="a variant and a seed",
    index=(VARIANT, SEED),
    columns=(
        Column(name="key", meaning="digest that identifies the trial in the evidence store"),
        Column(name="fidelity", meaning="kinematic, dynamic or contact"),
        Column(
            name="success",
            meaning="true if all states are complete and the object is at its place",
            kind=Kind.TRUTH,
        ),
        Column(name="failure", meaning="kind of the failure; missing on success"),
        Column(name="failed_phase", meaning="the state in which it ended; missing on success"),
        Column(name="failure_detail", meaning="description of the failure, with its figures; missing on success"),
        Column(name="workload", meaning="case of the workload; missing where the study has none"),
        Column(
            name="drawn_QUANTITY",
            meaning="draw of an uncertain quantity; name and unit make the name, as in drawn_perception_x_m",
            unit="the quantity's, in SI",
            kind=Kind.NUMBER,
        ),
        *trial_metric_columns(),
    ),
)

_PHASES = FrameDescription(
    name="phases",
    row="a trial and one of its eight states",
    index=(VARIANT, SEED, Column(name="phase", meaning="the state")),
    columns=(
        Column(name="outcome", meaning="completed, failed or not_run"),
        recorded_column("duration_s"),
        Column(name="planning_outcome", meaning="outcome of the planning of the move; missing if it is not planned"),
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
    index=(VARIANT, MEASURE),
    columns=(
        Column(name="value", meaning="estimate; missing where no trial gave one", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="low", meaning="lower end of the 95 % interval", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="high", meaning="upper end of the 95 % interval", unit=AS_UNIT, kind=Kind.NUMBER),
        UNIT,
        Column(
            name="n",
            meaning="number of trials of the estimate; 0 if it follows from the design alone or is missing",
            unit="1",
            kind=Kind.COUNT,
        ),
        Column(name="kind", meaning="moe, mop or supplementary"),
        Column(name="better", meaning="preferred direction: higher, lower or none"),
    ),
)

_REQUIREMENTS = FrameDescription(
    name="requirements",
    row="a system requirement",
    index=(Column(name="requirement", meaning="id of the requirement"),),
    columns=(
        Column(name="group", meaning="kind of the requirement, such as gripper or algorithm"),
        Column(name="text", meaning="its text"),
        Column(name="rationale", meaning="its rationale"),
        Column(name="source", meaning="its source"),
        Column(name="parent", meaning="id of the requirement that contains it; missing if none does"),
        Column(name="derived_from", meaning="ids of the elements it is derived from, separated by commas"),
        Column(name="traces", meaning="ids of the elements it traces to, separated by commas"),
        Column(name="satisfied_by", meaning="ids of the blocks and behaviours that satisfy it, separated by commas"),
        Column(name="verification", meaning="inspection, analysis, demonstration or test; missing if not stated"),
        Column(name="priority", meaning="its priority"),
        Column(name="status", meaning="its status"),
        Column(name="owner", meaning="its owner"),
        Column(name="measure", meaning="id of the measure of its criterion; missing if it has no criterion"),
        Column(name="statistic", meaning="compared number of the estimate: value, low or high"),
        Column(name="comparison", meaning="comparison with the threshold"),
        Column(name="threshold", meaning="the threshold", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="unit", meaning="unit of the threshold"),
    ),
)

_VERDICTS = FrameDescription(
    name="verdicts",
    row="a variant and a requirement with a criterion",
    index=(VARIANT, Column(name="requirement", meaning="id of the requirement")),
    columns=(
        Column(name="verdict", meaning="met, not_met, inconclusive, not_run or stale"),
        Column(name="changed", meaning="reasons why it is stale, separated by commas; empty if it is not"),
        MEASURE,
        Column(name="statistic", meaning="compared number of the estimate: value, low or high"),
        Column(name="comparison", meaning="comparison with the threshold"),
        Column(name="threshold", meaning="the threshold", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="unit", meaning="unit of the threshold"),
    ),
)


_COURSE = FrameDescription(
    name="course",
    row="an instant of a trial at contact fidelity, in simulated time without planning",
    index=(Column(name="time_s", meaning="time from the start of the first state", unit="s", kind=Kind.NUMBER),),
    columns=(
        Column(name="phase", meaning="the state at that time"),
        Column(name="joint_position_rad", meaning="position, of each joint", unit="rad", kind=Kind.NUMBER, items=0),
        Column(
            name="tool_position_m", meaning="grasp centre in the world: x, y, z", unit="m", kind=Kind.NUMBER, items=3
        ),
        Column(name="tool_speed_m_s", meaning="speed of the grasp centre", unit="m/s", kind=Kind.NUMBER),
        Column(
            name="workpiece_position_m",
            meaning="position of the object in the world: x, y, z",
            unit="m",
            kind=Kind.NUMBER,
            items=3,
        ),
        Column(name="finger_travel_m", meaning="closing travel of each finger", unit="m", kind=Kind.NUMBER, items=0),
        Column(
            name="finger_force_n",
            meaning="normal force on the object, of each finger",
            unit="N",
            kind=Kind.NUMBER,
            items=0,
        ),
        Column(name="commanded_force_n", meaning="commanded normal force of each finger", unit="N", kind=Kind.NUMBER),
        Column(name="grip_margin", meaning="available friction divided by needed friction", unit="1", kind=Kind.NUMBER),
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
            _REQUIREMENTS,
            _VERDICTS,
            RANKING,
            PARETO,
            EFFECTS,
            WEIGHTS,
            ACCEPTABILITY,
            TORNADO,
            EXCHANGE_RATES,
            WORTH_KEEPING,
            STAKEHOLDERS,
            ASSUMPTIONS,
            PORTFOLIO,
            CHANGES,
            _COURSE,
        )
    }
)
"""Every frame by its name."""
