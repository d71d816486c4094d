"""Reading many trials, one after another."""

import tracemalloc

import pytest

from rgss.evidence import EvidenceStore

TRIALS = 600


@pytest.fixture(scope="module")
def many(tmp_path_factory, record):
    """The path of a store with some hundred trials."""
    from rgss.evidence import Provenance, trial_key

    path = tmp_path_factory.mktemp("many") / "evidence.sqlite"
    provenance = Provenance(inputs={}, versions={"rgss": "0.1.0"})
    with EvidenceStore.open(path) as store:
        store.put_many(trials=[(trial_key({"trial": n}), record(variant=n), provenance) for n in range(TRIALS)])
    return path


def peak_of(read):
    tracemalloc.start()
    try:
        count = read()
        return count, tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_what_is_iterated_is_what_all_gives(many):
    with EvidenceStore.open(many) as store:
        assert tuple(store.iterate()) == store.all()
        assert len(store.all()) == TRIALS


def test_iterating_does_not_hold_the_trials(many):
    with EvidenceStore.open(many) as store:
        next(store.iterate())  # so that what is made once is not counted
        few, peak_of_few = peak_of(lambda: sum(1 for _, _ in zip(store.iterate(), range(100), strict=False)))
        most, peak_of_most = peak_of(lambda: sum(1 for _ in store.iterate()))
        held, peak_of_all = peak_of(lambda: len(store.all()))
    assert (few, most, held) == (100, TRIALS, TRIALS)
    assert peak_of_most < 1.3 * peak_of_few
    assert peak_of_most < peak_of_all / 5


def test_writing_meanwhile_does_no_harm(filled, record, provenance, key):
    with EvidenceStore.open(filled) as store, EvidenceStore.open(filled) as other:
        seen = set()
        for number, trial in enumerate(store.iterate()):
            seen.add(trial.key)
            if number == 0:
                other.put(key(4), record(variant=4), provenance)
                store.put(key(5), record(variant=5), provenance)
        assert seen >= {key(1), key(2), key(3)}
        assert len(store) == 5


def test_two_iterations_at_once(many):
    with EvidenceStore.open(many) as store:
        pairs = list(zip(store.iterate(), store.iterate(), strict=True))
    assert len(pairs) == TRIALS
    assert all(one == other for one, other in pairs)
