"""Merge of two stores: what both have is the same, and nothing is changed where it is not."""

import shutil
import sqlite3
from contextlib import closing
from dataclasses import replace

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import EvidenceStore, Piece, PieceKind, RunFailure, RunFailureKind, inputs_digest
from rgss.evidence.store import merge, verify

INPUTS = {"mass": 0.25}
HERE = {"libm": "glibc 2.36 aaaaaaaaaaaa"}
ELSEWHERE = {"libm": "glibc 2.31 bbbbbbbbbbbb"}


@pytest.fixture
def put(record, provenance, key):
    """Puts a trial with its named inputs, and a piece."""

    def do(store, number, *, text='"path"', numerics=HERE, **changes):
        origin = replace(provenance, inputs_digest=inputs_digest(INPUTS), numerics=numerics)
        piece = Piece(digest=key(f"piece {number}"), kind=PieceKind.PLAN, text=text)
        trial = (key(number), record(variant=number, **changes), origin)
        store.put_many(trials=[trial], pieces=[piece], inputs=[INPUTS])

    return do


@pytest.fixture
def two(tmp_path):
    with (
        EvidenceStore.open(tmp_path / "one.sqlite", label="one") as store,
        EvidenceStore.open(tmp_path / "two.sqlite", label="two") as other,
    ):
        yield store, other


def failure(key):
    return RunFailure(key=key, what="execution", kind=RunFailureKind.TIMED_OUT, detail="60 s", attempts=2)


def test_everything_of_the_other_store_is_added_once(two, put, key, tmp_path):
    store, other = two
    for number in (1, 2):
        put(store, number)
    for number in (2, 3, 4):
        put(other, number)
    # The trial was run here meanwhile; the other failure is unknown here.
    other.put_failure(failure(key(1)))
    other.put_failure(failure(key(9)))

    found = merge(store, other)
    assert (found.trials, found.pieces, found.present, found.left_out) == (2, 2, 2, 0)
    assert {trial.record.variant for trial in store.all()} == {1, 2, 3, 4}
    assert store.all()[0].provenance.numerics == HERE
    assert store.inputs(inputs_digest(INPUTS)) == INPUTS
    assert list(store.failures([key(1), key(9)])) == [key(9)]
    assert len(other) == 3
    again = merge(store, other)
    assert (again.trials, again.pieces, again.present) == (0, 0, 6)
    for name in ("one", "two"):
        assert verify(tmp_path / f"{name}.sqlite", label=name).damages == ()


@pytest.mark.parametrize("differs", ["trial", "piece"])
def test_another_result_of_the_same_inputs_is_refused_and_nothing_is_merged(two, put, differs):
    store, other = two
    put(store, 2)
    put(other, 1)
    put(other, 2, **({"failure_detail": "slipped 32 mm"} if differs == "trial" else {"text": '"other"'}))

    with pytest.raises(EvidenceError, match=f"non-determinism: {differs} .* has different results in one and two"):
        merge(store, other)
    assert len(store) == 1


def test_trials_of_other_numerics_are_refused(two, put):
    store, other = two
    put(store, 1)
    put(other, 2, numerics=ELSEWHERE)

    with pytest.raises(EvidenceError, match="what is stored in one was computed with other numerics"):
        merge(store, other)
    assert len(store) == 1


def test_pieces_of_unknown_numerics_are_left_out(two, put, key):
    """Those of a sweep that was ended before its first trial."""
    store, other = two
    put(store, 1)
    other.put_many(pieces=[Piece(digest=key("path"), kind=PieceKind.PLAN, text="0")])

    found = merge(store, other)
    assert (found.trials, found.pieces, found.present, found.left_out, found.unproven) == (0, 0, 0, 0, 1)
    assert store.has_pieces([key("path")]) == set()


def test_damaged_rows_of_the_other_store_are_left_out(two, put, key, change, tmp_path):
    store, other = two
    for number in (1, 2, 3):
        put(other, number)
    change(tmp_path / "two.sqlite", "UPDATE trials SET seal = ? WHERE key = ?", "0" * 64, key(1))
    change(tmp_path / "two.sqlite", "UPDATE pieces SET content = x'00' WHERE digest = ?", key("piece 2"))

    found = merge(store, other)
    assert (found.trials, found.pieces, found.left_out) == (2, 2, 2)
    assert verify(tmp_path / "one.sqlite", label="one").damages == ()


def test_trials_whose_inputs_are_damaged_are_left_out(two, put, change, tmp_path):
    store, other = two
    put(other, 1)
    change(tmp_path / "two.sqlite", "UPDATE inputs SET content = x'00'")

    found = merge(store, other)
    assert (found.trials, found.pieces, found.left_out) == (0, 1, 2)
    assert verify(tmp_path / "one.sqlite", label="one").damages == ()


@pytest.mark.parametrize("loss", ["replaced", "locked"])
def test_what_is_saved_of_a_lost_store_is_added_to_the_one_in_its_place(path, put, loss, monkeypatch):
    monkeypatch.setattr("rgss.evidence.store.connection.BUSY_TIMEOUT_S", 0.0)
    with EvidenceStore.open(path) as store:
        put(store, 1)
        if loss == "replaced":
            shutil.move(path, path.with_name("moved"))
            with EvidenceStore.open(path) as another:
                put(another, 3)
            with pytest.raises(StorageError):
                put(store, 2)
        else:
            with closing(sqlite3.connect(path, isolation_level=None)) as locking:
                locking.execute("BEGIN EXCLUSIVE")
                with pytest.raises(StorageError):
                    put(store, 2)
    with (
        EvidenceStore.open(path) as store,
        EvidenceStore.open(path.with_name("evidence.sqlite.rescued"), create=False) as saved,
    ):
        merge(store, saved)
        assert {trial.record.variant for trial in store.all()} == ({1, 2, 3} if loss == "replaced" else {1, 2})
    assert verify(path, label="it").damages == ()
