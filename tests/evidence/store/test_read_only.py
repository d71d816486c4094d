"""A store that cannot be written is read all the same, and only read."""

import sqlite3
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore
from rgss.evidence.store.migration import FIRST_TABLE
from rgss.evidence.store.schema import APPLICATION_ID
from rgss.evidence.store.verification import verify

Freeze = Callable[[], Path]


@pytest.fixture
def frozen(as_ordinary_user, record, provenance, key) -> Iterator[Freeze]:
    """Takes away the right to write a store of three trials, in a folder that anybody may enter."""
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "evidence of 100 % & more?.sqlite"
        with EvidenceStore.open(path) as store:
            store.put_many(trials=[(key(number), record(variant=number), provenance) for number in range(3)])

        def freeze() -> Path:
            path.chmod(0o444)
            path.parent.chmod(0o555)
            return path

        try:
            yield freeze
        finally:
            path.parent.chmod(0o755)


def variants(store: EvidenceStore) -> list[int]:
    return sorted(trial.record.variant for trial in store.iterate())


def test_it_is_read_and_nothing_appears_beside_it(frozen):
    path = frozen()
    content = path.read_bytes()
    with EvidenceStore.open(path, create=False) as store:
        assert variants(store) == [0, 1, 2]
        assert len(store) == 3

    assert path.read_bytes() == content
    assert [each.name for each in path.parent.iterdir()] == [path.name]


def test_it_is_verified(frozen):
    found = verify(frozen(), label="it")

    assert (found.damages, found.sound["trial"]) == ((), 3)


def test_who_puts_something_into_it_is_refused(frozen, record, provenance, key):
    with EvidenceStore.open(frozen(), create=False, label="it") as store:
        with pytest.raises(EvidenceError) as caught:
            store.put(key(9), record(variant=9), provenance)
        assert variants(store) == [0, 1, 2]

    assert str(caught.value) == (
        "the evidence store it cannot be used: it may not be written (you can change its permissions)"
    )


def test_what_another_user_has_just_put_is_read_too(frozen, record, provenance, key):
    """It stands in the log beside the file until the other user has finished."""
    path = frozen()
    path.parent.chmod(0o755)
    path.chmod(0o644)
    with EvidenceStore.open(path) as other:
        other.put(key(9), record(variant=9), provenance)
        path.chmod(0o444)
        path.parent.chmod(0o555)
        with EvidenceStore.open(path, create=False) as store:
            assert variants(store) == [0, 1, 2, 9]
        path.parent.chmod(0o755)


def test_an_older_store_is_not_brought_to_this_schema(frozen, as_ordinary_user):
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "old.sqlite"
        connection = sqlite3.connect(path)
        connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
        connection.execute("PRAGMA user_version = 1")
        connection.execute(FIRST_TABLE)
        connection.close()
        path.chmod(0o444)
        with pytest.raises(EvidenceError) as caught:
            EvidenceStore.open(path, create=False, label="it")
        assert str(caught.value) == (
            "it has the older schema 1 and cannot be written "
            "(make the file and its folder writable, so that it can be migrated to the present schema)"
        )


def test_what_is_no_store_is_refused(as_ordinary_user):
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "other.sqlite"
        path.write_text("These are no pages of a database.")
        path.chmod(0o444)
        with pytest.raises(EvidenceError, match="it cannot be used: file is not a database"):
            EvidenceStore.open(path, create=False, label="it")
