"""Trials that share pieces have the records that they have alone, in any order and process."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from itertools import groupby

import pytest

from rgss.errors import DefinitionError
from rgss.evidence import Failure, PhaseOutcome, record_digest
from rgss.tasks import default_task
from rgss.trials.code.piece_versions import versions
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.pieces.run import Pieces, run_trial
from rgss.trials.planning import plan_task
from rgss.trials.workcell import Workcell
from tests.fixtures.eight_states import PLANNED_PHASES, Phase

pytestmark = pytest.mark.engine

PRINT_DIGESTS = """
import sys
from pathlib import Path
from rgss.evidence import record_digest
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trials.pieces.run import run_trial
from tests.fixtures.eight_states import PLANNED_PHASES, Phase
project = load_project(Path(sys.argv[1]))
for variant in map(int, sys.argv[2:]):
    (spec,) = trial_specs(project, variants=[project.designs.variant(variant)], seeds=[project.study.seed])
    print(variant, record_digest(run_trial(spec)))
"""


def limited(replicate):
    """Variants of this replicate that a planning limit ends."""
    return [number for number, record in replicate.records.items() if record.failure is Failure.PLANNING_LIMIT]


def test_72_variants_need_6_plans_12_timings_24_executions_and_4_benches(replicate):
    assert len(replicate.records) == 72
    assert replicate.made == {"plan": 6, "timing": 12, "execution": 24, "bench": 4}


@pytest.mark.verifies("SYS-021")
def test_a_record_read_off_shared_pieces_is_the_one_of_the_trial_alone(replicate):
    some = [65, 4, *limited(replicate)[:1]]

    for number in some:
        alone = run_trial(replicate.specs[number])
        assert record_digest(alone) == record_digest(replicate.records[number]), number


def test_this_replicate_has_trials_that_a_limit_ends(replicate):
    planners = {replicate.specs[number].planner for number in limited(replicate)}

    assert "STRIDE" in planners


@pytest.mark.verifies("SYS-021")
def test_order_does_not_matter(replicate):
    some = [number for number in replicate.specs if replicate.specs[number].planner == "RRT"][:6]
    pieces = Pieces()
    records = {number: pieces.record(replicate.specs[number]) for number in some[::-1]}

    assert {number: record_digest(record) for number, record in records.items()} == {
        number: record_digest(replicate.records[number]) for number in some
    }


@pytest.mark.verifies("SYS-021")
def test_another_process_gives_the_same_bits(replicate, project):
    some = [65, 22]
    run = subprocess.run(
        [sys.executable, "-c", PRINT_DIGESTS, str(project.folder), *map(str, some)],
        capture_output=True,
        text=True,
        check=False,
    )

    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout.split() == [word for n in some for word in (str(n), record_digest(replicate.records[n]))]


def test_a_limit_beyond_the_search_is_refused(replicate):
    spec = replace(replicate.specs[65], planning_limit_s=8.5)

    with pytest.raises(DefinitionError, match=r"the planning limit of 8.5 s exceeds the search of 8 s \(set the"):
        Pieces().record(spec)


@pytest.mark.verifies("SYS-023")
def test_trials_that_differ_in_their_limit_alone_share_the_phases_before_the_cut(replicate):
    """Of variants with one execution, a shorter limit gives a prefix of what a longer one gives."""
    found = versions()
    specs = sorted(
        replicate.specs.values(), key=lambda spec: (digests_of(spec, found).execution, -spec.planning_limit_s)
    )
    cuts = 0
    for _, group in groupby(specs, key=lambda spec: digests_of(spec, found).execution):
        longest, *shorter = (replicate.records[spec.variant] for spec in group)
        for record in shorter:
            done = record.metrics["phases_completed"]
            assert record.phases[:done] == longest.phases[:done]
            begun = [planning for planning in record.planning if planning.outcome.value == "solved"]
            assert begun == list(longest.planning[: len(begun)])
            cuts += done < longest.metrics["phases_completed"]

    assert cuts > 0


@pytest.mark.verifies("SYS-032")
@pytest.mark.parametrize(("variant", "seed"), [(25, 1), (25, 4), (7, 2), (22, 1), (4, 3)])
def test_a_limit_read_off_the_shared_search_equals_a_search_with_that_limit(spec_of, variant, seed):
    spec = spec_of(variant, seed)
    planning = spec.settings.planning
    cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m, task=default_task())
    shared = plan_task(cell, spec.planner, seed=seed, settings=planning)
    longest = max((move.checks, phase) for phase, move in shared.moves.items())[1]
    boundary_s = shared.moves[longest].checks * planning.clock.charge_s
    limits = [4.0, 6.0, 8.0, boundary_s, boundary_s - planning.clock.charge_s]

    for limit_s in limits:
        alone = plan_task(cell, spec.planner, seed=seed, settings=replace(planning, search_limit_s=limit_s))
        assert set(alone.moves) <= set(shared.moves)
        for phase, move in alone.moves.items():
            read = shared.move_within(phase, limit_s)
            assert (read.outcome, read.checks, read.simplification_checks) == (
                move.outcome,
                move.checks,
                move.simplification_checks,
            )
            assert read.time_s == pytest.approx(move.time_s)
            assert bits(read.path_rad) == bits(move.path_rad)
            assert read.path_length_m == move.path_length_m


def bits(path):
    return None if path is None else path.tobytes()


@pytest.mark.verifies("SYS-023")
def test_states_run_in_order_and_the_return_only_after_a_successful_place(replicate):
    for record in replicate.records.values():
        assert [phase.phase for phase in record.phases] == list(Phase)
        assert [planning.subtask for planning in record.planning] == list(PLANNED_PHASES)
        outcomes = [phase.outcome for phase in record.phases]
        first = next((i for i, each in enumerate(outcomes) if each is not PhaseOutcome.COMPLETED), 8)
        assert all(outcome is PhaseOutcome.NOT_RUN for outcome in outcomes[first + 1 :])
        place, back = record.phases[6:]
        assert back.duration_s is None or place.outcome is PhaseOutcome.COMPLETED
