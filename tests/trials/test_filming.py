"""Looking at a trial: the trace tells its course, the film shows it, and neither changes it."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rgss.evidence import Fidelity, PhaseOutcome, record_digest
from rgss.kinematics import Arm
from rgss.physics.pictures import camera
from rgss.physics.pictures.camera import VIEWS, Camera
from rgss.scenes import Box, SceneObject
from rgss.trials.filming import Film
from rgss.trials.pieces.run import run_trial
from rgss.trials.tracing import run_traced_trial
from tests.fixtures.eight_states import Phase

pytestmark = pytest.mark.engine

WIDTH, HEIGHT = 120, 90


@pytest.fixture(scope="module")
def spec(spec_of):
    return spec_of(65, 1)


@pytest.fixture(scope="module")
def traced(spec):
    return run_traced_trial(spec)


@pytest.fixture(scope="module")
def record(traced):
    return traced[0]


@pytest.fixture(scope="module")
def trace(traced):
    return traced[1]


def film(spec, trace, **changes):
    options = {"inset": None, "width": WIDTH, "height": HEIGHT, "rate_hz": 5.0, **changes}
    return Film(spec, trace, VIEWS["overview"], **options)


def test_tracing_changes_no_bit_of_the_record(spec, record):
    assert record_digest(run_trial(spec)) == record_digest(record)


def test_spans_are_the_phases_of_the_record(record, trace):
    assert [span.phase for span in trace.spans] == list(Phase)
    assert [span.end_s - span.start_s for span in trace.spans] == pytest.approx([p.duration_s for p in record.phases])
    assert all(before.end_s == after.start_s for before, after in pairwise(trace.spans))
    assert trace.spans[0].start_s == 0.0


def test_there_is_a_sample_for_every_step(spec, trace):
    assert np.diff(trace.time_s) == pytest.approx(spec.settings.physics.step_s)
    assert [trace.time_s[span.last] for span in trace.spans] == pytest.approx([span.end_s for span in trace.spans])
    for series in (trace.joint_positions_rad, trace.finger_travel_m, trace.workpiece_quaternion_xyzw):
        assert len(series) == len(trace.time_s)


def test_forces_and_margins_are_those_of_the_record(record, trace):
    assert trace.finger_forces_n.max() == record.metrics["peak_finger_force_n"]
    assert np.nanmin(trace.grip_margin) == record.metrics["grip_margin_min"]


def test_forces_are_commanded_while_the_hand_holds(spec, trace):
    for before, span in zip((None, *trace.spans), trace.spans, strict=False):
        first = 0 if before is None else before.last + 1
        commanded = trace.commanded_force_n[first : span.last + 1]
        if span.phase in list(Phase)[1:6]:
            assert (commanded > 0.0).all()
            assert (commanded <= spec.gripper.finger_force_n).all()
        else:
            assert np.isnan(commanded).all()


def test_margins_are_known_only_while_the_object_is_carried(trace):
    carrying = [trace.span_at(sample).phase for sample in np.flatnonzero(np.isfinite(trace.grip_margin))]

    assert set(carrying) == set(list(Phase)[2:6])


def test_tool_goes_where_the_task_says(spec, trace):
    ends = {span.phase: trace.tool_position_m[span.last] for span in trace.spans}

    assert math.dist(ends[Phase.MOVE_TO_GRASP], spec.scene.grasp.position_m) < 1e-3
    assert math.dist(ends[Phase.MOVE_TO_PLACE], spec.scene.place_pose.position_m) < 1e-3


def test_tool_speed_is_the_derivative_of_its_position(spec, trace):
    step = spec.settings.physics.step_s
    differences = np.linalg.norm(trace.tool_position_m[2:] - trace.tool_position_m[:-2], axis=1) / (2 * step)

    assert trace.tool_speed_m_s[1:-1] == pytest.approx(differences, abs=0.02)
    assert trace.tool_speed_m_s.max() <= 1.01 * trace.tool_speed_limit_m_s
    assert trace.tool_speed_limit_m_s == spec.tool_speed_m_s


def test_tool_positions_are_those_of_the_joints(spec, trace):
    arm = Arm(spec.scene.robot, spec.gripper.geometry.grasp_centre)

    assert trace.tool_position_m[::500] == pytest.approx(arm.tool_position(trace.joint_positions_rad[::500]))


def test_a_coarse_rate_hides_no_peak(spec, record, trace):
    again, coarse = run_traced_trial(spec, rate_hz=24.0)

    assert record_digest(again) == record_digest(record)
    assert len(coarse.time_s) < len(trace.time_s) / 8
    assert coarse.finger_forces_n.max() == trace.finger_forces_n.max()
    assert np.nanmin(coarse.grip_margin) == np.nanmin(trace.grip_margin)
    assert [span.end_s for span in coarse.spans] == pytest.approx([span.end_s for span in trace.spans])


def test_phases_beyond_the_planning_limit_are_not_in_the_trace(spec, record):
    """Their physics ran, since other designs share it, but this design never got so far."""
    first = record.planning[0].time_s
    slow = next(planning for planning in record.planning if planning.time_s > 1.1 * first)
    ends, trace = run_traced_trial(replace(spec, planning_limit_s=1.05 * first))

    assert ends.failed_phase == slow.subtask
    assert [span.phase for span in trace.spans] == list(Phase)[: list(Phase).index(slow.subtask)]
    assert trace.duration_s == pytest.approx(ends.metrics["motion_time_s"])
    assert len(trace.grip_margin) == len(trace.time_s)


def test_there_is_no_trace_where_nothing_moved(spec):
    record, trace = run_traced_trial(replace(spec, planning_limit_s=0.1))

    assert record.phases[0].outcome is PhaseOutcome.FAILED
    assert trace is None


def test_other_fidelities_have_nothing_to_show(spec):
    record, trace = run_traced_trial(replace(spec, fidelity=Fidelity.KINEMATIC))

    assert record.success
    assert trace is None


@pytest.mark.parametrize(
    ("time_s", "sample"), [(-1.0, 0), (0.0, 0), (0.0063, 1), (0.006, 0), (1e9, -1)], ids=lambda value: f"{value}"
)
def test_sample_nearest_to_a_time(trace, time_s, sample):
    assert trace.sample_at(time_s) == range(len(trace.time_s))[sample]


def test_a_film_has_a_frame_for_each_interval_and_one_of_the_end(spec, trace):
    with film(spec, trace) as frames:
        count = len(frames)
        first, second, last = (frames.frame(index) for index in (0, 1, count - 1))

    assert count == math.ceil(trace.duration_s * 5.0) + 1
    assert first.picture.shape == second.picture.shape == last.picture.shape == (HEIGHT, WIDTH, 3)
    assert (first.time_s, second.time_s) == pytest.approx((0.0, 0.2), abs=0.005)
    assert last.time_s == trace.duration_s
    assert (first.span.phase, last.span.phase) == (Phase.MOVE_TO_GRASP, Phase.MOVE_TO_GRASP_APPROACH)


def test_the_cup_goes_from_the_right_to_the_left_of_the_overview(spec, trace):
    with film(spec, trace) as frames:
        ends = frames.ends_of_phases()
    columns = []
    for frame in ends:
        r, g, b = np.moveaxis(frame.picture.astype(int), -1, 0)
        cup = (r > 90) & (r > 2 * g) & (r > 2 * b)
        assert cup.any(), frame.span.phase
        columns.append(cup.nonzero()[1].mean())

    assert [frame.span for frame in ends] == list(trace.spans)
    assert columns[0] > 0.6 * WIDTH
    assert columns[-1] < 0.4 * WIDTH


def test_an_inset_lies_in_the_lower_right(spec, trace):
    with film(spec, trace) as plain, film(spec, trace, inset=VIEWS["hand"]) as both:
        differing = (plain.frame(9).picture != both.frame(9).picture).any(axis=2)
    rows, columns = differing.nonzero()

    assert 0.6 * HEIGHT < rows.min() < rows.max() < HEIGHT
    assert 0.6 * WIDTH < columns.min() < columns.max() < WIDTH
    assert differing.sum() > 0.1 * differing.size


def test_a_film_closes_its_first_camera_if_the_second_cannot_be(spec, trace, monkeypatch):
    closed = []

    class Recorded(Camera):
        def __init__(self, *arguments, **options):
            if closed is not None and options["width"] < WIDTH:
                raise RuntimeError("no second camera")
            super().__init__(*arguments, **options)

        def close(self):
            closed.append(self)
            super().close()

    monkeypatch.setattr("rgss.trials.filming.Camera", Recorded)

    with pytest.raises(RuntimeError, match="no second camera"):
        film(spec, trace, inset=VIEWS["hand"])
    assert len(closed) == 1
    assert camera.Camera is Camera


def test_every_object_of_a_scene_is_seen_where_it_is(spec_of):
    """A green block that nobody carries stays in the picture, and is where the trace has it."""
    spec = replace(spec_of(65), fidelity=Fidelity.CONTACT)
    scene = spec.scene
    x, y, z = scene.workpiece.pose.position_m
    shape = Box(size_m=(0.1, 0.1, 0.2))
    at = replace(scene.workpiece.pose, position_m=(x - 0.2, y, z - scene.workpiece.shape.half_height_m + 0.1))
    block = replace(scene.workpiece, id="block", shape=shape, pose=at, colour=(0.0, 1.0, 0.0, 1.0))
    other = SceneObject(workpiece=block, support=scene.support, place=scene.place, place_support=scene.place_support)
    spec = replace(spec, scene=replace(scene, others=(other,)))
    _, trace = run_traced_trial(spec, rate_hz=30.0)

    def seen(trace, number):
        with film(spec, trace, width=320, height=240) as shown:
            red, green, blue = np.moveaxis(shown.frame(number).picture.astype(int), 2, 0)
        return np.argwhere((green > 60) & (green > 2 * red) & (green > 2 * blue))

    first, last = seen(trace, 0), seen(trace, 10**6)
    assert min(len(first), len(last)) > 20
    assert np.linalg.norm(first.mean(axis=0) - last.mean(axis=0)) < 5
    raised = {name: rows + np.array([0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0]) for name, rows in trace.objects.items()}
    higher = seen(replace(trace, objects=raised), 0)
    assert higher.mean(axis=0)[0] < first.mean(axis=0)[0] - 10
