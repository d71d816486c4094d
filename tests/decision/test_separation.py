"""Whether the evidence separates two designs on the seeds that both have."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.separation import is_separated

FIRST, SECOND = 18, 17
"""They differ in the planning limit alone."""


@pytest.fixture
def measured_with(shipped, filled, record_of):
    """Two designs with other numbers of replicates, whose trials with some seeds fail."""

    def make(*, failing=((), ()), time_s=(3.0, 3.0), ran=(24, 16)):
        project = shipped.with_fidelity("kinematic").with_replicates(max(ran))
        variants = [one for one in project.designs.expand() if one.id in (FIRST, SECOND)]
        first_seed = project.study.seed

        def record(spec):
            if spec.variant not in (FIRST, SECOND):
                return None
            place = 0 if spec.variant == FIRST else 1
            if spec.seed - first_seed in failing[place]:
                return record_of(spec, success=False)
            return record_of(spec, planning_s=time_s[place] / 5.0 * (1.0 + 0.01 * (spec.seed % 3)), path_m=0.4)

        found = measure_variants(project, filled(project, record), among=variants)
        kept = dict(zip((FIRST, SECOND), ran, strict=True))
        cut = tuple(
            replace(entry, trials=entry.trials[:most], records=entry.records[:most])
            for entry in found
            for most in [kept[entry.variant.id]]
        )
        return project, cut

    return make


def test_one_failure_more_does_not_separate(measured_with):
    project, measured = measured_with(failing=((), (3,)))
    assert not is_separated(project, measured, FIRST, SECOND)


def test_failures_of_seeds_that_one_alone_has_do_not_count(measured_with):
    """They are all of those that the other has not run: nothing is known of how it would have fared."""
    project, measured = measured_with(failing=(tuple(range(16, 24)), ()))
    assert not is_separated(project, measured, SECOND, FIRST)


def test_failures_of_most_common_seeds_separate(measured_with):
    project, measured = measured_with(failing=((), tuple(range(12))))
    assert is_separated(project, measured, FIRST, SECOND)


def test_a_few_successes_do_not_outdo_many_trials(measured_with):
    """All four of the one succeed, and one of the other's four with these seeds fails, as 3 of its 64 do."""
    project, measured = measured_with(failing=((0, 20, 40), ()), ran=(64, 4), time_s=(3.0, 2.0))
    assert not is_separated(project, measured, SECOND, FIRST)


def test_many_successes_of_a_faster_design_separate(measured_with):
    project, measured = measured_with(failing=(tuple(range(0, 64, 5)), ()), ran=(64, 64), time_s=(3.0, 2.0))
    assert is_separated(project, measured, SECOND, FIRST)


def test_a_time_that_is_longer_in_every_trial_separates(measured_with):
    project, measured = measured_with(time_s=(3.0, 14.0))
    assert is_separated(project, measured, FIRST, SECOND)


def test_a_design_is_not_separated_from_itself(measured_with):
    project, measured = measured_with()
    assert not is_separated(project, measured, FIRST, FIRST)


def test_a_former_choice_that_is_no_longer_there_is_a_change(measured_with):
    project, measured = measured_with()
    assert is_separated(project, measured, FIRST, 1)


@pytest.mark.parametrize(("time_s", "separated"), [((3.0, 3.0), False), ((3.0, 14.0), True)])
def test_single_trials_are_compared_by_their_estimates(measured_with, time_s, separated):
    project, measured = measured_with(time_s=time_s, ran=(1, 1))
    assert is_separated(project, measured, FIRST, SECOND) is separated
