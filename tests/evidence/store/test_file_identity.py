"""A store that is lost while it is open: it is noticed, and what can be saved is."""

import os
import shutil
import sqlite3
from contextlib import closing

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import EvidenceStore, Piece, PieceKind, trial_key
from rgss.evidence.store.verification import verify

HINT = "(remove the rest of evidence.sqlite, rename {0} to evidence.sqlite and run the sweep again)"
REPLACED = (
    "(evidence.sqlite is another store now: 'rgss evidence merge evidence.sqlite.rescued' adds the saved rows to it)"
)


@pytest.fixture
def put(record, provenance):
    """Puts a trial and a piece of some length."""

    def do(store, number, length=10):
        key = trial_key({"trial": number})
        piece = Piece(digest=key, kind=PieceKind.PLAN, text=f'"{"x" * length}"')
        store.put_many(trials=[(key, record(variant=number), provenance)], pieces=[piece])

    return do


def replaced(path):
    path.rename(path.with_name("elsewhere"))
    EvidenceStore.open(path).close()


LOSSES = {
    "removed": (lambda path: path.unlink(), "was removed"),
    "removed with its folder": (lambda path: shutil.rmtree(path.parent), "was removed"),
    "moved": (lambda path: path.rename(path.with_name("elsewhere")), "was moved to {folder}/elsewhere"),
    "replaced": (replaced, "was replaced by another file"),
    "without its log": (lambda path: path.with_name(f"{path.name}-wal").unlink(), "lost its write-ahead log"),
    "without its index": (lambda path: path.with_name(f"{path.name}-shm").unlink(), "lost its index of its log"),
}


@pytest.fixture
def place(tmp_path):
    (tmp_path / "evidence").mkdir()
    return tmp_path / "evidence" / "evidence.sqlite"


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("noticed_by", ["put", "confirm"])
def test_a_store_that_is_lost_is_saved_as_a_whole(place, put, loss, noticed_by):
    lose, words = LOSSES[loss]
    store = EvidenceStore.open(place, label="it")
    for number in range(5):
        put(store, number)
    lose(place)
    with pytest.raises(StorageError) as caught:
        put(store, 5) if noticed_by == "put" else store.confirm()
    rows = 12 if noticed_by == "put" else 10
    saved = f"{rows} readable rows are saved in evidence.sqlite.rescued beside it"
    words = words.format(folder=place.parent)
    assert caught.value.message == f"the evidence store it {words} while it was in use; {saved}"
    assert str(caught.value).endswith(REPLACED if loss == "replaced" else HINT.format("evidence.sqlite.rescued"))
    # Said again, and not saved again.
    with pytest.raises(StorageError) as again:
        put(store, 6)
    assert again.value is caught.value
    store.close()
    # Of a file that has gone, or has another name, no log is left that would be applied to the next of this name.
    if "log" not in loss and "index" not in loss and loss != "replaced":
        assert [file.name for file in place.parent.glob("evidence.sqlite*")] == ["evidence.sqlite.rescued"]

    rescued = place.with_name("evidence.sqlite.rescued")
    assert verify(rescued, label="it").damages == ()
    # As the hint says.
    for file in place.parent.glob("evidence.sqlite*"):
        if file != rescued:
            file.unlink()
    rescued.rename(place)
    with EvidenceStore.open(place) as store:
        assert len(store.all()) == rows // 2
        assert {trial.record.variant for trial in store.all()} == set(range(rows // 2))


@pytest.mark.parametrize("keep", [0, 1, 4096, 20_000])
def test_a_store_that_is_cut_is_noticed_and_what_can_be_read_is_saved(place, put, keep):
    with EvidenceStore.open(place) as store:
        for number in range(40):
            put(store, number, length=2000)
    store = EvidenceStore.open(place, label="it")
    size = place.stat().st_size
    os.truncate(place, keep)
    with pytest.raises(StorageError) as caught:
        put(store, 100)
    assert f"the evidence store it was truncated from {size} to {keep} bytes while it was in use; " in str(caught.value)
    store.close()
    # What was in hand is saved, whatever else is.
    with EvidenceStore.open(place.with_name("evidence.sqlite.rescued")) as rescued:
        assert 100 in {trial.record.variant for trial in rescued.all()}
    with pytest.raises(EvidenceError):
        EvidenceStore.open(place, create=False)


def test_an_older_copy_in_the_same_file_is_noticed_in_the_end(place, put):
    with EvidenceStore.open(place) as store:
        put(store, 0)
    older = place.read_bytes()
    with EvidenceStore.open(place) as store:
        put(store, 1)
    store = EvidenceStore.open(place, label="it")
    put(store, 2)
    store.database.connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    with place.open("r+b") as file:
        file.write(older.ljust(place.stat().st_size, b"\0"))
    with pytest.raises(StorageError, match=r"^the evidence store it (cannot be read back|lacks)"):
        store.confirm()
    store.close()


def test_a_row_that_another_has_deleted_is_noticed_in_the_end(place, put, change):
    store = EvidenceStore.open(place, label="it")
    put(store, 0)
    put(store, 1)
    change(place, "DELETE FROM trials WHERE variant = 1")
    with pytest.raises(StorageError, match="lacks 1 of 4 written rows"):
        store.confirm()
    store.close()


def test_the_log_of_a_lost_file_is_not_applied_to_the_one_that_took_its_place(place, put, tmp_path):
    other = tmp_path / "other.sqlite"
    with EvidenceStore.open(other) as store:
        for number in range(100, 110):
            put(store, number)
    store = EvidenceStore.open(place, label="it")
    for number in range(30):
        put(store, number)
    other.rename(place)
    with pytest.raises(StorageError, match="was replaced by another file"):
        store.confirm()
    store.close()
    assert verify(place, label="it").damages == ()
    with EvidenceStore.open(place) as store:
        assert {trial.record.variant for trial in store.all()} == set(range(100, 110))


def test_what_was_saved_before_is_not_written_over(place, put):
    for number, name in enumerate(["evidence.sqlite.rescued", "evidence.sqlite.rescued-2"]):
        store = EvidenceStore.open(place)
        put(store, number)
        place.unlink()
        with pytest.raises(StorageError, match=f"saved in {name} beside it"):
            store.confirm()
        store.close()
    with EvidenceStore.open(place.with_name("evidence.sqlite.rescued")) as store:
        assert [trial.record.variant for trial in store.all()] == [0]


def test_where_nothing_can_be_saved_that_is_said(place, put):
    store = EvidenceStore.open(place)
    put(store, 0)
    shutil.rmtree(place.parent)
    place.parent.write_text("a file in the place of the folder", encoding="utf-8")
    with pytest.raises(StorageError, match="was removed while it was in use; nothing of it could be saved: "):
        store.confirm()
    store.close()


@pytest.mark.parametrize("noticed_by", ["put", "confirm"])
def test_a_store_that_is_moved_with_its_project_has_everything(tmp_path, put, noticed_by):
    folder, other = tmp_path / "project", tmp_path / "renamed"
    place = folder / ".rgss" / "evidence.sqlite"
    store = EvidenceStore.open(place, label="it")
    put(store, 0)
    folder.rename(other)
    with pytest.raises(StorageError) as caught:
        put(store, 1) if noticed_by == "put" else store.confirm()
    store.close()
    moved = other / ".rgss" / "evidence.sqlite"
    assert str(caught.value) == (
        f"the evidence store it was moved to {moved} while it was in use; everything that was finished is in it "
        "(run the sweep again there)"
    )
    assert not folder.exists()
    assert verify(moved, label="it").damages == ()
    with EvidenceStore.open(moved) as store:
        assert len(store) == (2 if noticed_by == "put" else 1)


def test_what_is_finished_while_another_process_locks_the_store_is_saved(place, put, monkeypatch):
    monkeypatch.setattr("rgss.evidence.store.connection.BUSY_TIMEOUT_S", 0.0)
    store = EvidenceStore.open(place, label="it")
    put(store, 0)
    with closing(sqlite3.connect(place, isolation_level=None)) as locking:
        locking.execute("BEGIN EXCLUSIVE")
        with pytest.raises(StorageError) as caught:
            put(store, 1)
        # What comes later is refused at once, without another wait.
        with pytest.raises(StorageError) as again:
            put(store, 2)
    assert again.value is caught.value
    store.close()
    assert str(caught.value) == (
        "the evidence store it was locked by another process while it was in use; 4 readable rows are saved in "
        "evidence.sqlite.rescued beside it (when the other process has ended, 'rgss evidence merge "
        "evidence.sqlite.rescued' adds them to evidence.sqlite)"
    )
    assert verify(place, label="it").damages == ()
    with EvidenceStore.open(place.with_name("evidence.sqlite.rescued")) as rescued:
        assert {trial.record.variant for trial in rescued.all()} == {0, 1}


def test_other_users_of_a_store_do_no_harm(place, put):
    with EvidenceStore.open(place) as store, EvidenceStore.open(place) as other:
        for number in range(5):
            put(store if number % 2 else other, number)
        other.database.connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        put(store, 6)
        other.close()
        put(store, 7)
        store.confirm()
    assert verify(place, label="it").damages == ()


def test_a_store_that_was_only_read_is_not_read_back(place, put, monkeypatch):
    with EvidenceStore.open(place) as store:
        put(store, 0)
    with EvidenceStore.open(place) as store:
        monkeypatch.setattr("rgss.evidence.store.writing.connect", lambda path: pytest.fail("it was read back"))
        assert len(store.all()) == 1
        store.confirm()
