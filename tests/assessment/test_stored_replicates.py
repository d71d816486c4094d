"""Seeds that an assessment reads, compared with a plain reading of everything that is stored."""

from __future__ import annotations

import dataclasses
import random

import pytest

from rgss.assessment import common_seeds, measure_variants, require_complete, sequential_seeds, specs_read
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore
from rgss.measures.anytime_evidence import anytime_proportion_limits
from rgss.studies.expansion import trial_specs
from rgss.sweep.trial_keys import key_of
from tests.fixtures.stored_trials import put_trials

IDS = (1, 2, 28, 72)


@pytest.fixture
def sequential(shipped):
    rule = dataclasses.replace(shipped.study.until_decided, cap=12, verdict_cap=8)
    study = dataclasses.replace(shipped.study, replicates=3, is_sequential=True, until_decided=rule)
    return dataclasses.replace(shipped, study=study)


@pytest.fixture
def variants(shipped):
    return tuple(shipped.designs.variant(number) for number in IDS)


@pytest.fixture
def store(tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as opened:
        yield opened


def put(project, store, record_of, seeds, *, shuffled=0):
    """Stores trials of variants with the seeds that are given, in some order."""
    rows = [
        spec
        for variant, own in seeds.items()
        for spec in trial_specs(project, variants=[project.designs.variant(variant)], seeds=sorted(own))
    ]
    random.Random(shuffled).shuffle(rows)  # noqa: S311 - an order, no secret
    put_trials(store, rows, lambda spec: record_of(spec, planning_s=0.1 * spec.seed, success=spec.seed % 3 > 0))


def plainly_read(store, first, fewest, cap):
    """The seeds of each variant by a look at every stored trial."""
    there = {}
    for trial in store.all():
        there.setdefault(trial.record.variant, set()).add(trial.record.seed)
    found = {}
    for variant, seeds in there.items():
        count = 0
        while first + count in seeds and count < cap:
            count += 1
        found[variant] = tuple(range(first, first + count)) if count >= fewest else None
    return found


def test_each_variant_has_its_stored_seeds_without_a_gap(sequential, variants, store, record_of):
    seeds = {1: range(1, 4), 2: {*range(1, 8), 9, 10}, 28: range(1, 16), 72: range(1, 6)}
    put(sequential, store, record_of, seeds)
    measured = measure_variants(sequential, store, among=variants)
    expected = plainly_read(store, 1, 3, 12)
    read = {entry.variant.id: tuple(record.seed for record in entry.records) for entry in measured}
    assert read == expected
    assert {variant: len(own) for variant, own in read.items()} == {1: 3, 2: 7, 28: 12, 72: 5}
    assert {entry.missing for entry in measured} == {0}
    require_complete(measured)
    assert {key_of(spec) for spec in specs_read(sequential, measured)} == {
        key for entry in measured for key in entry.trials
    }
    assert [(one.first, one.last, one.replicates, one.variants) for one in sequential_seeds(sequential, measured)] == [
        (1, 3, 3, (1,)),
        (1, 5, 5, (72,)),
        (1, 7, 7, (2,)),
        (1, 12, 12, (28,)),
    ]


def test_the_order_of_the_evidence_changes_nothing(sequential, variants, tmp_path, record_of):
    seeds = {1: range(1, 4), 2: range(1, 9), 28: range(1, 11), 72: range(1, 4)}
    found = []
    for order in (1, 2):
        with EvidenceStore.open(tmp_path / f"{order}.sqlite") as store:
            put(sequential, store, record_of, seeds, shuffled=order)
            found.append(measure_variants(sequential, store, among=variants))
    assert found[0] == found[1]


def test_a_gap_in_the_studys_own_seeds_is_missing_and_nothing_after_it_is_read(sequential, variants, store, record_of):
    put(sequential, store, record_of, {1: {1, 3, 4, 5}, 2: range(1, 4), 28: range(1, 4), 72: range(1, 4)})
    measured = measure_variants(sequential, store, among=variants)
    assert [record.seed for record in measured[0].records] == [1, 3]
    assert measured[0].missing == 1
    with pytest.raises(EvidenceError, match="1 of 12 trials have no evidence"):
        require_complete(measured)


def test_a_fixed_number_reads_no_more(shipped, sequential, variants, store, record_of):
    put(sequential, store, record_of, dict.fromkeys(IDS, range(1, 9)))
    for project, count in ((sequential.with_replicates(5), 5), (shipped.with_replicates(3), 3)):
        measured = measure_variants(project, store, among=variants)
        assert {len(entry.records) for entry in measured} == {count}
        assert sequential_seeds(project, measured) == ()


def test_intervals_hold_at_any_number_where_the_number_depends_on_results(sequential, variants, store, record_of):
    put(sequential, store, record_of, dict.fromkeys(IDS, range(1, 9)))
    entry = measure_variants(sequential, store, among=variants)[0]
    successes = sum(record.success for record in entry.records)
    share = entry.estimates["S"]
    assert (share.low, share.high) == anytime_proportion_limits(successes, 8, tail=0.025)
    fixed = measure_variants(sequential.with_replicates(8), store, among=variants)[0].estimates["S"]
    assert (fixed.value, fixed.n) == (share.value, share.n)
    assert share.low < fixed.low < fixed.high < share.high


def test_evidence_of_other_inputs_ends_the_row(sequential, variants, store, record_of):
    put(sequential, store, record_of, dict.fromkeys(IDS, range(1, 4)))
    other = dataclasses.replace(sequential, study=dataclasses.replace(sequential.study, solver_iterations=50))
    put(other, store, record_of, {1: range(1, 9)})
    measured = measure_variants(sequential, store, among=variants)
    assert {len(entry.records) for entry in measured} == {3}


def test_common_seeds_are_estimated_as_if_nothing_else_was_there(sequential, variants, store, record_of):
    put(sequential, store, record_of, {1: range(1, 4), 2: range(1, 9), 28: range(1, 7), 72: range(1, 6)})
    measured = measure_variants(sequential, store, among=variants)
    rule = dataclasses.replace(sequential.study.until_decided, pilot=3, verdict_cap=3, cap=3)
    capped = dataclasses.replace(sequential, study=dataclasses.replace(sequential.study, until_decided=rule))
    fixed = measure_variants(capped, store, among=variants)
    alike = common_seeds(sequential, measured)
    assert [entry.estimates for entry in alike] == [entry.estimates for entry in fixed]
    assert [entry.trials for entry in alike] == [entry.trials for entry in fixed]
    assert measured[1].estimates != alike[1].estimates
    assert common_seeds(sequential, fixed) == fixed
