"""The evidence store: what it keeps, what it checks, what it refuses."""

import json
import sqlite3
import tempfile
import threading
import zlib
from pathlib import Path

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import EvidenceStore, Provenance, StoredTrial, record_digest
from rgss.evidence.store.schema import APPLICATION_ID, SCHEMA_VERSION
from rgss.findings import shown


def refusal(path, **options):
    with pytest.raises(EvidenceError) as caught, EvidenceStore.open(path, label="evidence.sqlite", **options) as store:
        store.all()
    assert "\n" not in str(caught.value)
    assert caught.value.hint
    return str(caught.value)


def test_what_is_put_is_found_again(store, record, provenance, key):
    assert store.put(key(1), record(), provenance)
    trial = StoredTrial(key=key(1), content_digest=record_digest(record()), record=record(), provenance=provenance)
    assert store.get(key(1)) == trial
    assert store.all() == (trial,)
    assert len(store) == 1


def test_what_is_not_there_is_none(store, key):
    assert store.get(key(1)) is None
    assert store.has([key(1)]) == set()
    assert store.records([key(1)]) == {}
    assert store.all() == ()
    assert len(store) == 0


def test_a_store_is_kept_by_its_file(filled, record, provenance, key):
    with EvidenceStore.open(filled, create=False) as store:
        assert store.has([key(1), key(9), key(3)]) == {key(1), key(3)}
        assert list(store.records([key(3), key(9), key(1)]).items()) == [
            (key(3), record(variant=3)),
            (key(1), record(variant=1)),
        ]


def test_the_order_of_writing_does_not_show(tmp_path, record, provenance, key):
    contents = []
    for name, order in (("a", (1, 2, 3)), ("b", (3, 1, 2))):
        with EvidenceStore.open(tmp_path / name) as store:
            for number in order:
                store.put(key(number), record(variant=number), provenance)
            contents.append(store.all())
    assert contents[0] == contents[1]
    assert [trial.key for trial in contents[0]] == sorted(key(number) for number in (1, 2, 3))


def test_the_same_result_again_changes_nothing(store, record, provenance, key):
    assert store.put(key(1), record(), provenance)
    assert not store.put(key(1), record(), provenance)
    assert len(store) == 1


def test_another_result_of_the_same_inputs_is_non_determinism(store, record, provenance, key):
    store.put(key(1), record(), provenance)
    with pytest.raises(EvidenceError) as caught:
        store.put(key(1), record(metrics={"slip_m": 1e-300}), provenance)
    kept, other = record_digest(record()), record_digest(record(metrics={"slip_m": 1e-300}))
    assert str(caught.value) == (
        f"non-determinism: trial {key(1)[:12]} of variant 1, seed 7 has another result than before "
        f"(the same inputs must give the same content; {kept[:12]} is stored, {other[:12]} is not)"
    )
    assert store.get(key(1)).record == record()


@pytest.mark.parametrize("wrong", ["", "a" * 63, "A" * 64, "a" * 64 + "\n", "'; DROP TABLE trials; --", None, 7])
def test_a_malformed_key_is_refused(store, record, provenance, wrong):
    for use in (store.get, lambda name: store.has([name]), lambda name: store.put(name, record(), provenance)):
        with pytest.raises(EvidenceError) as caught:
            use(wrong)
        assert (
            str(caught.value) == f"the key of a trial must be a SHA-256, got {shown(wrong)} (compute it with trial_key)"
        )


def test_what_cannot_be_written_leaves_nothing_behind(store, record, provenance, key):
    with pytest.raises(EvidenceError, match=r"^record\.metrics\.x is not one of"):
        store.put(key(1), record(metrics={"x": "text"}), provenance)
    with pytest.raises(EvidenceError, match=r"^provenance\.versions\.rgss is not str: 1 *$"):
        store.put(key(1), record(), Provenance(inputs={}, versions={"rgss": 1}))
    with pytest.raises(EvidenceError, match=r"^the provenance cannot be written: inputs\.plan is of type bytes"):
        store.put(key(1), record(), Provenance(inputs={"plan": b""}, versions={}))
    assert len(store) == 0


def test_the_file_is_a_database_in_write_ahead_mode_without_pickles(filled):
    connection = sqlite3.connect(filled)
    assert connection.execute("PRAGMA journal_mode").fetchone() == ("wal",)
    assert connection.execute("PRAGMA application_id").fetchone() == (APPLICATION_ID,)
    assert connection.execute("PRAGMA user_version").fetchone() == (SCHEMA_VERSION,)
    kinds = "SELECT DISTINCT typeof(key), typeof(record), typeof(provenance), typeof(seal) FROM trials"
    assert connection.execute(kinds).fetchall() == [("text", "blob", "blob", "text")]
    packed = connection.execute("SELECT record, provenance FROM trials").fetchall()
    assert all(isinstance(json.loads(zlib.decompress(content)), dict) for row in packed for content in row)
    connection.close()


def test_the_folder_is_made(tmp_path):
    with EvidenceStore.open(tmp_path / "a" / "b" / "evidence.sqlite") as store:
        assert len(store) == 0


def test_an_empty_file_is_not_taken_for_a_new_store(path):
    path.touch()
    for create in (True, False):
        assert refusal(path, create=create) == (
            "evidence.sqlite is empty: an evidence store is never empty, so it was truncated "
            "(restore a copy of it, or remove the file to start again)"
        )
    assert path.stat().st_size == 0
    path.unlink()
    with EvidenceStore.open(path) as store:
        assert len(store) == 0


def test_an_empty_database_is_not_taken_for_a_new_store(path):
    connection = sqlite3.connect(path)
    connection.execute("VACUUM")
    connection.close()
    assert path.stat().st_size > 0
    assert refusal(path).startswith("evidence.sqlite is not an evidence store")


def test_a_missing_store_is_not_made_on_demand(path):
    assert refusal(path, create=False) == "there is no evidence in evidence.sqlite (run the sweep first)"
    assert not path.exists()


def test_a_folder_is_no_store(tmp_path):
    assert refusal(tmp_path) == "evidence.sqlite must be a regular file, but it is a folder (move it away)"


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "file").touch()
    assert refusal(tmp_path / "file" / "evidence.sqlite") == (
        "the folder of evidence.sqlite cannot be created: File exists (use a writable folder)"
    )


def test_a_folder_that_cannot_be_written_is_named(as_ordinary_user):
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o555)
        try:
            message = refusal(Path(folder) / "evidence.sqlite")
        finally:
            Path(folder).chmod(0o755)
    assert message == (
        f"the evidence store evidence.sqlite cannot be used: its folder {Path(folder).name} may not be written "
        "(you can change its permissions)"
    )


def test_a_file_that_cannot_be_written_is_named(as_ordinary_user, record, provenance, key):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "evidence.sqlite"
        EvidenceStore.open(path).close()
        path.chmod(0o444)
        with pytest.raises(EvidenceError) as caught, EvidenceStore.open(path, label="evidence.sqlite") as store:
            store.put(key(1), record(), provenance)
    assert str(caught.value) == (
        "the evidence store evidence.sqlite cannot be used: it may not be written (you can change its permissions)"
    )


def test_a_closed_store_says_so(path):
    store = EvidenceStore.open(path, label="evidence.sqlite")
    store.close()
    store.close()
    with pytest.raises(EvidenceError) as caught:
        len(store)
    assert str(caught.value) == (
        "the evidence store evidence.sqlite cannot be used: Cannot operate on a closed database. (open the store again)"
    )


def test_a_store_belongs_to_its_thread(store):
    caught = []

    def use():
        try:
            len(store)
        except EvidenceError as error:
            caught.append(error)

    thread = threading.Thread(target=use)
    thread.start()
    thread.join()
    assert caught[0].hint == "open the store in the thread that uses it"


def test_a_full_disk_is_named(store, record, provenance, key):
    store.database.connection.execute("PRAGMA max_page_count = 12")
    put = []

    def fill():
        for number in range(50):
            store.put(key(number), record(variant=number), provenance)
            put.append(number)

    with pytest.raises(StorageError) as caught:
        fill()
    assert str(caught.value) == (
        "the evidence store evidence.sqlite cannot be used: database or disk is full "
        "(free space on the disk; earlier entries are stored)"
    )
    assert sorted(trial.record.variant for trial in store.all()) == put


def test_a_store_that_another_process_keeps_locked_is_named(path, record, provenance, monkeypatch, key):
    EvidenceStore.open(path).close()
    monkeypatch.setattr("rgss.evidence.store.connection.BUSY_TIMEOUT_S", 0.05)
    other = sqlite3.connect(path, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    with EvidenceStore.open(path, label="evidence.sqlite") as store:
        with pytest.raises(StorageError) as caught, store.database.transaction():
            pass
        assert str(caught.value) == (
            "the evidence store evidence.sqlite cannot be used: database is locked "
            "(another process is using it; try again when it is done)"
        )
        with pytest.raises(StorageError, match="was locked by another process while it was in use; 1 readable"):
            store.put(key(1), record(), provenance)
    other.execute("ROLLBACK")
    other.close()
