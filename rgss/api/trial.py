"""Trial of the Python interface: record, course over time, pictures."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from rgss.api.argument_terms import number_argument, whole_argument
from rgss.api.columns import FRAMES
from rgss.api.frames import frame_of, phases_frame
from rgss.api.html_views import trial_view
from rgss.errors import DefinitionError
from rgss.evidence import Fidelity, Metric, TrialRecord, record_digest
from rgss.evidence.records import TrialTrace
from rgss.studies import Project, trial_specs
from rgss.sweep import compute
from rgss.trials import run_traced_trial
from rgss.trials.payload_bench import PayloadResult, bench_spec, run_bench
from rgss.trials.pieces import TrialSpec, run_trial

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure
    from PIL.Image import Image

_LEAST_PIXELS, _LARGEST = 16, 2000
_IDS = "give an id and a seed"
_OF_THE_STUDY = "omit it for the study's own"
_OF_THE_FILE = "omit it for that of the gripper's file"
_LARGEST_SEED = 2**31
_LOWEST_HZ, _HIGHEST_HZ = 60.0, 10_000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """Functions that draw a trial; passed by the caller, since this package draws nothing.

    Attributes:
        figure: Makes the plots of a record, its trace and the names of the joints.
        filmstrip: Makes the picture of a record and the ends of its phases.
    """

    figure: Callable[..., Figure]
    filmstrip: Callable[..., Image]


@dataclass(frozen=True, kw_only=True, eq=False)
class Trial:
    """A trial that was run now; the same inputs and seed give the same trial as in the evidence.

    Attributes:
        record: Its record, as the evidence store keeps it.
    """

    record: TrialRecord
    _spec: TrialSpec = field(repr=False)
    _trace: TrialTrace | None = field(repr=False)
    _drawing: Drawing = field(repr=False)

    def __repr__(self) -> str:
        record = self.record
        outcome = "success" if record.success else self.failure
        return f"Trial(variant {record.variant}, seed {record.seed}, {record.fidelity.value} fidelity: {outcome})"

    def _repr_html_(self) -> str:
        return trial_view(repr(self), self.record)

    @property
    def success(self) -> bool:
        """True if all states are complete and the object is in its place."""
        return self.record.success

    @property
    def failure(self) -> str:
        """Failure and the phase in which it occurred, in words; empty on success."""
        record = self.record
        if record.failure is None or record.failed_phase is None:
            return ""
        return f"{record.failure.value} at {record.failed_phase}: {record.failure_detail}"

    @property
    def metrics(self) -> Mapping[str, Metric]:
        """Metrics of the whole trial, by name with unit; a row of numbers is a tuple."""
        return self.record.metrics

    @property
    def digest(self) -> str:
        """SHA-256 of the record."""
        return record_digest(self.record)

    @property
    def phases(self) -> pd.DataFrame:
        """The eight states, with the columns of a study's ``phases``."""
        return phases_frame([self.record])

    @property
    def course(self) -> pd.DataFrame:
        """Arm, hand and object over time.

        Raises:
            DefinitionError: There is no course: the trial's fidelity is not contact, or nothing moved.
        """
        import numpy as np

        trace = self._seen()
        instants = np.arange(len(trace.time_s))
        values: dict[str, Any] = {
            "time_s": trace.time_s,
            "phase": [trace.span_at(int(at)).phase for at in instants],
            "tool_speed_m_s": trace.tool_speed_m_s,
            "commanded_force_n": trace.commanded_force_n,
            "grip_margin": trace.grip_margin,
        }
        series = {
            "joint_position_rad": trace.joint_positions_rad,
            "tool_position_m": trace.tool_position_m,
            "workpiece_position_m": trace.workpiece_position_m,
            "finger_travel_m": trace.finger_travel_m,
            "finger_force_n": trace.finger_forces_n,
        }
        for name, rows in series.items():
            values |= {f"item_{number}_{name}": column for number, column in enumerate(rows.T, start=1)}
        described = FRAMES["course"]
        columns = [
            entry
            for column in described.columns
            for entry in column.entries(series[column.name].shape[1] if column.items is not None else 0)
        ]
        rows_of = [{name: cells[at] for name, cells in values.items()} for at in instants]
        return frame_of(described.index, columns, rows_of)

    def figure(self) -> Figure:
        """Joint positions, tool speed, finger forces and grip margin over time, as a Matplotlib figure.

        Raises:
            DefinitionError: As for `course`.
        """
        joints = [joint.name for joint in self._spec.scene.robot.joints]
        return self._drawing.figure(self.record, self._seen(), joints=joints)

    def filmstrip(self, *, width: int = 400, height: int = 300) -> Image:
        """The ends of the states side by side, as a Pillow image.

        Args:
            width: Width of each picture in pixels.
            height: Height of each picture in pixels.

        Raises:
            DefinitionError: As for `course`, or the size is out of range.
            SimulationError: The engine cannot draw the scene.
        """
        from rgss.physics import VIEWS
        from rgss.trials import Film

        hint = "omit them for the defaults"
        width, height = whole_argument("width", width, hint=hint), whole_argument("height", height, hint=hint)
        if not all(_LEAST_PIXELS <= side <= _LARGEST for side in (width, height)):
            raise DefinitionError(
                f"width and height must be from {_LEAST_PIXELS} to {_LARGEST} pixels, got {width} and {height}",
                hint=hint,
            )
        trace = self._seen()
        with Film(self._spec, trace, VIEWS["overview"], width=width, height=height, rate_hz=1.0) as film:
            ends = {frame.span.phase: frame.picture for frame in film.ends_of_phases()}
        return self._drawing.filmstrip(self.record, ends)

    def _seen(self) -> TrialTrace:
        if self._trace is not None:
            return self._trace
        if self.record.fidelity is not Fidelity.CONTACT:
            raise DefinitionError(
                f"a trial of {self.record.fidelity.value} fidelity has no course and no pictures",
                hint="call trial(..., fidelity='contact')",
            )
        raise DefinitionError(
            "the trial ended before anything moved, so that it has no course", hint=f"its failure was {self.failure}"
        )


def run_one(
    project: Project,
    drawing: Drawing,
    variant: int,
    seed: int | None,
    *,
    fidelity: str | None = None,
    rate_hz: float | None = None,
) -> Trial:
    """Run one trial; see `rgss.api.study.Study.trial`."""
    spec = _spec(project, variant, seed, fidelity=fidelity)
    if rate_hz is not None:
        rate_hz = number_argument("rate_hz", rate_hz, hint=_OF_THE_STUDY)
        if not _LOWEST_HZ <= rate_hz <= _HIGHEST_HZ:
            raise DefinitionError(
                f"rate_hz must be from {_LOWEST_HZ:g} to {_HIGHEST_HZ:g}, got {rate_hz:g}", hint=_OF_THE_STUDY
            )
        settings = spec.settings
        _refuse_coarse(spec.fidelity, rate_hz, settings.physics.solver_iterations)
        spec = replace(spec, settings=replace(settings, physics=replace(settings.physics, rate_hz=rate_hz)))
    seen = spec.fidelity is Fidelity.CONTACT
    record, trace = compute(run_traced_trial, spec) if seen else (compute(run_trial, spec), None)
    return Trial(record=record, _spec=spec, _trace=trace, _drawing=drawing)


def _refuse_coarse(fidelity: Fidelity, rate_hz: float, iterations: int) -> None:
    """Refuse a rate at which contact physics was not validated, as a study's file and a what-if do."""
    from rgss.physics import LEAST_ITERATIONS_HZ, LEAST_RATE_HZ

    if fidelity is Fidelity.CONTACT and (rate_hz < LEAST_RATE_HZ or rate_hz * iterations < LEAST_ITERATIONS_HZ):
        raise DefinitionError(
            f"contact physics needs at least {LEAST_RATE_HZ:g} Hz and {LEAST_ITERATIONS_HZ:g} solver iterations a "
            f"second, got rate_hz={rate_hz:g} and {rate_hz * iterations:g}",
            hint="240 Hz with 20 iterations are validated",
        )


def payload_of(
    project: Project, variant: int, *, friction: float | None = None, finger_force_n: float | None = None
) -> PayloadResult:
    """Test a gripper on the payload bench; see `rgss.api.study.Study.payload`."""
    spec = _spec(project, variant, None, fidelity=Fidelity.CONTACT.value)
    gripper, robot = spec.gripper, spec.scene.robot
    if friction is not None:
        friction = number_argument("friction", friction, hint=_OF_THE_FILE)
        if friction < 0.0:
            raise DefinitionError(f"friction must be at least 0, got {friction:g}", hint=_OF_THE_FILE)
        gripper = replace(gripper, friction=friction)
    if finger_force_n is not None:
        force_n = number_argument("finger_force_n", finger_force_n, hint=_OF_THE_FILE)
        gripper = replace(gripper, finger_force_n=force_n)
    return compute(
        run_bench,
        bench_spec(
            spec.scene,
            gripper,
            acceleration_m_s2=robot.tool_acceleration_m_s2,
            rated_kg=robot.payload_kg,
            physics=spec.settings.physics,
        ),
    )


def _spec(project: Project, variant: int, seed: int | None, *, fidelity: str | None) -> TrialSpec:
    chosen = project if fidelity is None else project.with_fidelity(fidelity)
    variant = whole_argument("variant", variant, hint=_IDS)
    seed = chosen.study.seed if seed is None else whole_argument("seed", seed, hint=_IDS)
    if not 0 <= seed < _LARGEST_SEED:
        raise DefinitionError(f"seed must be from 0 to {_LARGEST_SEED - 1}, got {seed}", hint=_OF_THE_STUDY)
    (spec,) = trial_specs(chosen, variants=[chosen.designs.variant(variant)], seeds=[seed])
    return spec
