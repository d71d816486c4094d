"""Finding and removing what nobody names."""

import os
import sqlite3
from dataclasses import replace

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import EvidenceStore, Piece, PieceKind, RunFailure, RunFailureKind, inputs_digest, text_digest
from rgss.evidence.store import collection as collecting
from rgss.evidence.store.collection import collect_garbage, find_garbage
from rgss.evidence.store.contents import contents_of
from rgss.evidence.store.verification import verify

TRIALS = 40


def piece_of(number):
    """Two trials share a piece."""
    return text_digest(f"piece {number // 2}")


@pytest.fixture
def used(path, record, provenance, key):
    """The path of a store whose trials share pieces by twos and inputs by tens; the last piece has no trial."""
    with EvidenceStore.open(path) as store:
        inputs = [{"variant": ten, "ballast": "z" * 500} for ten in range(TRIALS // 10)]
        store.put_many(
            trials=[
                (
                    key(number),
                    record(variant=number),
                    replace(
                        provenance, inputs={"plan": piece_of(number)}, inputs_digest=inputs_digest(inputs[number // 10])
                    ),
                )
                for number in range(TRIALS)
            ],
            pieces=[
                Piece(digest=piece_of(number), kind=PieceKind.PLAN, text=str(os.urandom(3000)))
                for number in range(0, TRIALS + 2, 2)
            ],
            inputs=inputs,
        )
        for name in (piece_of(TRIALS), piece_of(TRIALS + 2)):
            store.put_failure(
                RunFailure(key=name, what="plan", kind=RunFailureKind.RAISED, detail="no path", attempts=1)
            )
    return path


def content(path):
    """Everything in a store, by table."""
    connection = sqlite3.connect(path)
    tables = {
        "trials": "SELECT * FROM trials ORDER BY key",
        "pieces": "SELECT * FROM pieces ORDER BY digest",
        "inputs": "SELECT * FROM inputs ORDER BY digest",
        "failures": "SELECT * FROM failures ORDER BY key",
    }
    rows = {name: connection.execute(statement).fetchall() for name, statement in tables.items()}
    connection.close()
    return rows


def test_what_is_named_stays_and_all_else_goes(used, key):
    before = content(used)
    kept = {key(number) for number in range(15)}
    waiting = frozenset({piece_of(TRIALS)})
    done = collect_garbage(used, trials=kept, pieces=waiting, label="it")
    after = content(used)

    # Counted by hand: trials 0 to 14 have the pieces 0 to 7 and the inputs 0 and 1.
    pieces = {piece_of(number) for number in range(15)} | waiting
    inputs = {inputs_digest({"variant": ten, "ballast": "z" * 500}) for ten in (0, 1)}
    assert after["trials"] == [row for row in before["trials"] if row[0] in kept]
    assert after["pieces"] == [row for row in before["pieces"] if row[0] in pieces]
    assert after["inputs"] == [row for row in before["inputs"] if row[0] in inputs]
    assert [row[0] for row in after["failures"]] == []
    garbage = done.garbage
    assert [len(part) for part in (garbage.trials, garbage.pieces, garbage.inputs, garbage.failures)] == [25, 12, 2, 1]
    assert [trial.key for trial in garbage.trials] == sorted({key(number) for number in range(15, TRIALS)})
    assert {(trial.variant, trial.seed, trial.fidelity) for trial in garbage.trials} == {
        (number, 7, "contact") for number in range(15, TRIALS)
    }
    removed = {name: [row for row in before[name] if row not in after[name]] for name in ("trials", "pieces", "inputs")}
    assert garbage.size_bytes == sum(
        len(cell) for rows in removed.values() for row in rows for cell in row if isinstance(cell, bytes)
    )
    assert verify(used, label="it").damages == ()


def test_the_space_is_given_back(used, key):
    size = used.stat().st_size
    done = collect_garbage(used, trials={key(0)}, pieces=frozenset(), label="it")
    assert done.shrunk
    assert (done.before_bytes, done.after_bytes) == (size, used.stat().st_size)
    assert used.stat().st_size < size / 2
    with EvidenceStore.open(used) as store:
        assert store.database.one("PRAGMA journal_mode") == ("wal",)


def test_looking_changes_nothing(used, key):
    before = content(used)
    with EvidenceStore.open(used) as store:
        found = find_garbage(store.database, trials={key(0)}, pieces=frozenset())
    assert len(found.trials) == TRIALS - 1
    assert content(used) == before
    assert collect_garbage(used, trials={key(0)}, pieces=frozenset(), label="it").garbage == found


def test_where_everything_is_named_nothing_goes(used, key):
    before = content(used)
    names = {key(number) for number in range(TRIALS)}
    pieces = {piece_of(number) for number in range(TRIALS + 4)}
    with EvidenceStore.open(used) as store:
        assert not find_garbage(store.database, trials=names, pieces=pieces)
    assert not collect_garbage(used, trials=names, pieces=pieces, label="it").garbage
    assert content(used) == before


def test_a_store_that_is_in_use_is_left_alone(used, key, monkeypatch):
    monkeypatch.setattr(collecting, "_PATIENCE_MS", 50)
    before = content(used)
    with EvidenceStore.open(used) as store:
        with pytest.raises(EvidenceError) as caught:
            collect_garbage(used, trials=frozenset(), pieces=frozenset(), label="it")
        assert str(caught.value) == (
            "another process has the evidence store it open (wait until the sweep has finished)"
        )
        assert len(store) == TRIALS
    assert content(used) == before
    assert collect_garbage(used, trials=frozenset(), pieces=frozenset(), label="it").shrunk


def test_a_file_that_cannot_be_written_anew_keeps_its_size(used, key, monkeypatch):
    def hindered(connection):
        # The file is never written anew within a transaction: that stands for a disk without space.
        connection.execute("BEGIN")
        try:
            return give_back(connection)
        finally:
            connection.execute("ROLLBACK")

    give_back = collecting._compact
    monkeypatch.setattr(collecting, "_compact", hindered)
    size = used.stat().st_size
    done = collect_garbage(used, trials={key(0)}, pieces=frozenset(), label="it")
    assert not done.shrunk
    assert used.stat().st_size == size
    with EvidenceStore.open(used) as store:
        assert len(store) == 1


def test_a_damaged_trial_that_is_to_stay_is_told(used, change, key):
    change(used, "UPDATE trials SET provenance = x'00' WHERE key = ?", key(3))
    with pytest.raises(EvidenceError) as caught:
        collect_garbage(used, trials={key(3)}, pieces=frozenset(), label="it")
    assert str(caught.value) == (
        f"it: trial {key(3)[:12]} is damaged: its provenance cannot be unpacked "
        "(run 'rgss evidence verify --mend' to remove it)"
    )
    # One that is to go may be damaged as it likes.
    assert len(collect_garbage(used, trials={key(4)}, pieces=frozenset(), label="it").garbage.trials) == TRIALS - 1


def test_what_a_store_holds(used, key):
    with EvidenceStore.open(used) as store:
        contents = contents_of(store.database)
    assert [trial.key for trial in contents.trials] == sorted(key(number) for number in range(TRIALS))
    assert contents.pieces == {"plan": TRIALS // 2 + 1}
    assert contents.inputs == TRIALS // 10
    assert sorted(failure.key for failure in contents.failures) == [piece_of(TRIALS + 2)]
    assert contents.size_bytes == used.stat().st_size


def test_nothing_is_removed_where_the_store_has_changed_since_the_names_were_determined(used, key, record, provenance):
    with EvidenceStore.open(used) as store:
        then = contents_of(store.database).ledger
        retained = store.has(map(key, range(TRIALS)))
        # A sweep or a confirmation that ends before the file is locked.
        assert store.put(key(99), record(variant=99), provenance)
    before = content(used)
    with pytest.raises(StorageError) as caught:
        collect_garbage(used, trials=retained, pieces=set(), label="it", then=then)
    assert str(caught.value) == "it was changed by another process meanwhile (try again)"
    assert content(used) == before
    with EvidenceStore.open(used) as store:
        then = contents_of(store.database).ledger
    done = collect_garbage(used, trials=retained | {key(99)}, pieces=set(), label="it", then=then)
    assert done.garbage.trials == ()
    with EvidenceStore.open(used) as store:
        assert len(store) == TRIALS + 1
