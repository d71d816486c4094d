"""Pieces as tasks and texts: made apart, read back bit for bit, and put together to the same records."""

from __future__ import annotations

import json
import pickle
from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import EvidenceError, MotionError
from rgss.evidence import Failure, Fidelity, Piece, PieceKind, record_digest
from rgss.motion import PlannerSettings, PlanningClock
from rgss.tasks import default_task
from rgss.trials.code.piece_versions import versions
from rgss.trials.executing import execution_of
from rgss.trials.pieces.bench_json import bench_from_json, bench_to_json
from rgss.trials.pieces.execution_json import execution_from_json, execution_to_json
from rgss.trials.pieces.float_array import FloatArray
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.pieces.pieces import PieceTask, TrialTask, make_piece, record_of, tasks_of
from rgss.trials.pieces.plan_json import plan_from_json, plan_to_json
from rgss.trials.pieces.run import make, run_trial
from rgss.trials.pieces.timing_json import timing_from_json, timing_to_json
from rgss.trials.planning import TaskPlan, plan_of, plan_task
from rgss.trials.record import assemble_record
from rgss.trials.timing import time_task, timing_of
from rgss.trials.workcell import workcell_of
from tests.fixtures.eight_states import Phase

AWKWARD = [0.1, -0.0, 5e-324, 1.7976931348623157e308, 1 / 3, -1e-9, 0.1 + 0.2]


def bits(array):
    return None if array is None else (array.shape, array.dtype.str, array.tobytes())


@pytest.fixture(scope="module")
def made(spec_of):
    """The pieces of a trial, each made from the texts of those before it."""
    spec = spec_of(65)
    pieces: dict[str, Piece] = {}
    for task in tasks_of(spec, digests_of(spec, versions())):
        needed = {digest: pieces[digest] for digest in task.needs}
        # As it would travel to another process or machine.
        pieces[task.digest] = pickle.loads(pickle.dumps(make(*pickle.loads(pickle.dumps((task, needed))))))  # noqa: S301
    return {piece.kind: piece for piece in pieces.values()}


def test_a_trial_is_four_tasks_each_after_what_it_needs(spec_of):
    spec = spec_of(65)
    digests = digests_of(spec, versions())
    tasks = tasks_of(spec, digests)

    assert [(task.kind, task.digest, task.needs) for task in tasks] == [
        (PieceKind.PLAN, digests.plan, ()),
        (PieceKind.TIMING, digests.timing, (digests.plan,)),
        (PieceKind.EXECUTION, digests.execution, (digests.timing,)),
        (PieceKind.BENCH, digests.bench, ()),
    ]
    kinematic = replace(spec, fidelity=Fidelity.KINEMATIC)
    assert PieceKind.BENCH not in [task.kind for task in tasks_of(kinematic, digests_of(kinematic, versions()))]


@pytest.mark.engine
@pytest.mark.verifies("SYS-021")
def test_pieces_made_apart_give_the_record_of_the_trial_run_by_itself(spec_of, made):
    spec = spec_of(65)

    assert {*made} == {*PieceKind}
    assert record_digest(record_of(spec, made)) == record_digest(run_trial(spec))


@pytest.mark.engine
def test_a_piece_is_known_by_its_digest_and_small_enough_to_be_kept(spec_of, made):
    digests = digests_of(spec_of(65), versions()).as_mapping()

    assert {kind.value: piece.digest for kind, piece in made.items()} == {
        name: digest for name, digest in digests.items() if name != "trial"
    }
    assert max(len(piece.text) for piece in made.values()) < 100_000


@pytest.mark.engine
def test_a_plan_and_a_timing_are_read_back_bit_for_bit(spec_of, made):
    spec = spec_of(65)
    planning = spec.settings.planning
    cell = workcell_of(spec.scene, spec.gripper.geometry, planning.clearance_m, default_task())
    plan = plan_task(cell, spec.planner, seed=spec.seed, settings=planning)
    timing = time_task(cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)
    read, timed = plan_from_json(made[PieceKind.PLAN].text), timing_from_json(made[PieceKind.TIMING].text)

    assert list(read.moves) == list(plan.moves)
    for phase, move in plan.moves.items():
        assert bits(read.moves[phase].path_rad) == bits(move.path_rad)
        assert replace(read.moves[phase], path_rad=None) == replace(move, path_rad=None)
    assert bits(read.direct["lift"]) == bits(plan.direct["lift"])
    assert read.clock == plan.clock
    assert list(timed.trajectories) == list(timing.trajectories)
    assert len(timed.trajectories) == 6
    times = np.linspace(-0.1, 3.0, 500)
    for phase, motion in timing.trajectories.items():
        assert bits(timed.trajectories[phase].positions(times)) == bits(motion.positions(times))
        assert bits(timed.trajectories[phase].rates) == bits(motion.rates)
        assert timed.trajectories[phase].duration_s == motion.duration_s
    assert timed.failures == timing.failures


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", ["kinematic", "contact"])
def test_no_text_between_the_steps_changes_a_record(spec_of, made, fidelity):
    """The record of a trial made from values in memory, never written as text."""
    spec = replace(spec_of(65), fidelity=Fidelity(fidelity))
    plan = plan_of(spec)
    timing = timing_of(spec, plan)
    phases = execution_of(spec, timing)
    held_kg = bench_from_json(made[PieceKind.BENCH].text).payload_kg if fidelity == "contact" else None
    in_memory = assemble_record(spec, plan, timing.failures, phases, bench_payload_kg=held_kg)

    assert record_digest(run_trial(spec)) == record_digest(in_memory)


@pytest.mark.engine
def test_a_text_that_is_read_and_written_again_is_the_same(made):
    for kind, back in {
        PieceKind.PLAN: lambda text: plan_to_json(plan_from_json(text)),
        PieceKind.TIMING: lambda text: timing_to_json(timing_from_json(text)),
        PieceKind.EXECUTION: lambda text: execution_to_json(execution_from_json(text)),
        PieceKind.BENCH: lambda text: bench_to_json(bench_from_json(text)),
    }.items():
        assert back(made[kind].text) == made[kind].text


@pytest.mark.engine
def test_a_trial_that_fails_to_plan_or_to_move_has_all_its_pieces(spec_of):
    """The plan ends at its first move, and everything after it is empty."""
    spec = spec_of(65)
    short = replace(spec.settings.planning, search_limit_s=0.001)
    hopeless = replace(
        spec,
        planning_limit_s=0.001,
        fidelity=Fidelity.KINEMATIC,
        settings=replace(spec.settings, planning=short),
    )
    pieces: dict[str, Piece] = {}
    for task in tasks_of(hopeless, digests_of(hopeless, versions())):
        pieces[task.digest] = make_piece(task, pieces)
    record = record_of(hopeless, {piece.kind: piece for piece in pieces.values()})

    assert record.failure is Failure.PLANNING_LIMIT
    assert record_digest(record) == record_digest(run_trial(hopeless))
    untimed = '{"motions":[],"untimed":[{"detail":"why","failure":"unreachable_waypoint","phase":"lift"}]}'
    assert timing_from_json(untimed).failures == {Phase.LIFT: (Failure.UNREACHABLE_WAYPOINT, "why")}


@pytest.mark.engine
def test_a_whole_trial_can_be_one_task(spec_of):
    spec = replace(spec_of(65), fidelity=Fidelity.KINEMATIC)
    task = TrialTask(digest="a" * 64, spec=spec)

    assert task.needs == ()
    assert record_digest(make(task, {})) == record_digest(run_trial(spec))


@pytest.mark.engine
def test_a_planner_that_is_not_there_is_an_error(spec_of):
    spec = replace(spec_of(65), planner_settings=PlannerSettings(algorithm="PRN"))
    task = PieceTask(digest="a" * 64, kind=PieceKind.PLAN, spec=spec)

    with pytest.raises(MotionError, match="unknown planner 'PRN'"):
        make(task, {})


def test_a_bench_of_a_trial_that_knows_none_is_an_error(spec_of):
    spec = replace(spec_of(65), fidelity=Fidelity.DYNAMIC)

    with pytest.raises(EvidenceError, match="a dynamic trial has no payload bench"):
        make_piece(PieceTask(digest="a" * 64, kind=PieceKind.BENCH, spec=spec), {})


@pytest.mark.parametrize("shape", [(7,), (1, 7), (7, 1, 1)])
def test_an_array_is_read_back_bit_for_bit(shape):
    array = np.array(AWKWARD).reshape(shape)

    assert bits(FloatArray.of(array).array()) == bits(array)
    assert bits(FloatArray.of(np.zeros((0, 6))).array()) == bits(np.zeros((0, 6)))
    backwards = np.array(AWKWARD)[::-1]
    assert FloatArray.of(backwards).array().tolist() == backwards.tolist()


@pytest.mark.parametrize(
    ("shape", "text", "problem"),
    [
        ((1,), "?", "an array is not in Base64"),
        ((1,), "AAAA", r"an array of shape \(1,\) cannot have 3 bytes"),
        ((2,), "AAAAAAAAAAA=", r"an array of shape \(2,\) cannot have 8 bytes"),
        ((-1, -1), "AAAAAAAAAAA=", r"an array of shape \(-1, -1\) cannot have 8 bytes"),
        ((10**9, 10**9), "", r"an array of shape \(1000000000, 1000000000\) cannot have 0 bytes"),
        ((1,), FloatArray.of(np.array([np.nan])).base64, "an array holds a number that is not finite"),
        ((1,), FloatArray.of(np.array([-np.inf])).base64, "an array holds a number that is not finite"),
    ],
)
def test_an_array_that_is_none_is_refused(shape, text, problem):
    with pytest.raises(EvidenceError, match=problem):
        FloatArray(shape=shape, base64=text).array()


def changed(text: str, change) -> str:
    data = json.loads(text)
    change(data)
    return json.dumps(data)


@pytest.mark.engine
@pytest.mark.parametrize(
    ("kind", "change", "problem"),
    [
        (PieceKind.PLAN, lambda plan: plan["moves"].append(plan["moves"][0]), "two moves of one phase"),
        (
            PieceKind.PLAN,
            lambda plan: plan["moves"][0].update(path_rad=None),
            "must have a path if and only if it is solved",
        ),
        (
            PieceKind.PLAN,
            lambda plan: plan["moves"][0].update(outcome="budget_spent"),
            "must have a path if and only if it is solved",
        ),
        (
            PieceKind.PLAN,
            lambda plan: plan["direct"][0]["path_rad"].update(shape=[2, 3, 4]),
            r"a path cannot have the shape \(2, 3",
        ),
        (PieceKind.PLAN, lambda plan: plan["moves"][0].update(checks="1"), "checks"),
        (PieceKind.PLAN, lambda plan: plan.pop("clock"), "lacks 'clock'"),
        (PieceKind.TIMING, lambda timing: timing["motions"].append(timing["motions"][0]), "two entries of one phase"),
        (
            PieceKind.TIMING,
            lambda timing: timing["motions"][1].update(rates=timing["motions"][0]["breaks"]),
            "the motion of lift has arrays of inconsistent shapes",
        ),
        (
            PieceKind.TIMING,
            lambda timing: timing["motions"][1].update(curved=[]),
            "the motion of lift has arrays of inconsistent shapes",
        ),
        (PieceKind.EXECUTION, lambda execution: execution["phases"][0].update(phase=1), "phase"),
        (PieceKind.EXECUTION, lambda execution: execution.update(more=1), "unknown 'more'"),
        (PieceKind.BENCH, lambda bench: bench.update(bracket_kg=[1.0]), "must have two masses"),
        (PieceKind.BENCH, lambda bench: bench["probes"][0].update(stopped_by="magic"), "stopped_by"),
    ],
)
def test_a_damaged_piece_is_refused(made, kind, change, problem):
    read = {
        PieceKind.PLAN: plan_from_json,
        PieceKind.TIMING: timing_from_json,
        PieceKind.EXECUTION: execution_from_json,
        PieceKind.BENCH: bench_from_json,
    }[kind]

    with pytest.raises(EvidenceError, match=problem):
        read(changed(made[kind].text, change))


def test_a_plan_without_moves_is_a_plan():
    plan = TaskPlan(moves={}, direct={}, clock=PlanningClock(charge_s=0.5))

    assert plan_from_json(plan_to_json(plan)) == plan
