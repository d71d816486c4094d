"""The reference study's world makes designs fail in several ways, each of them again bit for bit."""

from __future__ import annotations

import pytest

from rgss.evidence import Failure, record_digest
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trials.pieces.run import run_trial
from rgss.trials.replay.replayed_trial import run_replayed_trial
from tests.fixtures.shared_trials import record_without_bench
from tests.fixtures.shipped_project import copy_as_shipped

pytestmark = pytest.mark.engine


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """The shipped project with its own default study."""
    return load_project(copy_as_shipped(tmp_path_factory.mktemp("reference") / "project"))


@pytest.mark.parametrize(
    ("variant", "seed", "failure"),
    [
        (30, 4, Failure.OBJECT_DROPPED),
        (12, 4, Failure.ARM_COLLISION),
        (12, 16, Failure.OBJECT_COLLISION),
    ],
)
def test_a_failure_that_is_no_planning_limit_is_found_again(reference, variant, seed, failure):
    (spec,) = trial_specs(reference, variants=[reference.designs.variant(variant)], seeds=[seed])
    record = run_trial(spec)
    replayed = run_replayed_trial(spec)
    last = replayed.scene.touches[-1:]

    assert record.failure is failure
    assert record_digest(replayed.record) == record_digest(record)
    if failure is Failure.ARM_COLLISION:
        assert [f"{one.link} touched {one.body}" for one in last] == [record.failure_detail]
        assert last[0].start_s == pytest.approx(replayed.trace.spans[-1].end_s)


def test_the_same_seed_fails_otherwise_with_other_fingers(reference):
    specs = trial_specs(reference, variants=[reference.designs.variant(one) for one in (12, 30)], seeds=[4])

    assert [record_without_bench(spec).failure for spec in specs] == [Failure.ARM_COLLISION, Failure.OBJECT_DROPPED]
