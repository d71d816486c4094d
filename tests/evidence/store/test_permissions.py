"""A store that the user may not read or write is refused with the file that refuses it, and never as a failed run."""

import os
import sqlite3
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import EvidenceStore
from rgss.evidence.store import collect_garbage
from rgss.evidence.store.connection import Database
from rgss.evidence.store.permissions import refusal_of
from rgss.evidence.store.verification import verify


@pytest.fixture
def path(as_ordinary_user) -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / ".rgss" / "evidence.sqlite"
        EvidenceStore.open(path).close()
        try:
            yield path
        finally:
            path.parent.chmod(0o755)


def refusal(use, path: Path) -> str:
    """The message of an error that is not a failure of the run."""
    with pytest.raises(EvidenceError) as caught:
        use(path)
    assert not isinstance(caught.value, StorageError)
    return str(caught.value).removeprefix("the evidence store it cannot be used: ")


def read(path: Path) -> None:
    with EvidenceStore.open(path, create=False, label="it") as store:
        store.all()


def write(path: Path) -> None:
    with EvidenceStore.open(path, label="it") as store, store.database.transaction():
        store.database.change("DELETE FROM failures")


def collect(path: Path) -> None:
    collect_garbage(path, trials=set(), pieces=set(), label="it")


@pytest.mark.parametrize("use", [read, write, collect, lambda path: verify(path, label="it")])
def test_an_unreadable_file_is_named(path, use):
    path.chmod(0o000)
    assert refusal(use, path) == "it may not be read (you can change its permissions)"


@pytest.mark.parametrize("use", [write, collect])
def test_a_file_that_may_only_be_read_is_no_failing_disk(path, use):
    path.chmod(0o444)
    assert refusal(use, path) == "it may not be written (you can change its permissions)"
    read(path)


@pytest.mark.parametrize("use", [write, collect])
def test_a_folder_that_may_only_be_read_is_named(path, use):
    path.parent.chmod(0o555)
    assert refusal(use, path) == "its folder .rgss may not be written (you can change its permissions)"
    read(path)


def test_a_new_store_names_the_folder_that_may_only_be_read(path):
    path.parent.chmod(0o555)
    told = refusal(write, path.with_name("new.sqlite"))
    assert told == "its folder .rgss may not be written (you can change its permissions)"


@pytest.fixture
def of_another_user(monkeypatch):
    """Leaves a log beside a store that is not this user's; returns the name of its owner."""

    def leave(path: Path, ending: str, mode: int) -> str:
        log = path.with_name(path.name + ending)
        log.touch()
        log.chmod(mode)
        monkeypatch.setattr(os, "geteuid", lambda: log.stat().st_uid + 1)
        return f"user {log.owner()}"

    return leave


@pytest.mark.parametrize("use", [read, write, collect])
def test_an_index_that_another_user_left_is_named(path, use, of_another_user):
    user = of_another_user(path, "-shm", 0o000)
    assert refusal(use, path) == (
        f"the index of its log evidence.sqlite-shm may not be read and belongs to {user} ({user} can change its "
        "permissions, or remove it by 'rgss evidence' when no sweep is running; do not delete it, since it may have "
        "what was stored last)"
    )


def test_a_log_that_another_user_left_does_not_keep_one_from_reading(path, of_another_user):
    user = of_another_user(path, "-wal", 0o444)
    assert f"its log evidence.sqlite-wal may not be written and belongs to {user}" in refusal(write, path)
    read(path)


def test_a_disk_that_becomes_read_only_later_is_a_failure_of_the_run(path):
    database = Database(sqlite3.connect(path), "it", refusal_of(path))
    path.chmod(0o444)
    with pytest.raises(StorageError, match="attempt to write a readonly database"), database.translated_errors():
        raise sqlite3.OperationalError("attempt to write a readonly database")
    database.close()


def store_at(folder: Path, length: int) -> Path:
    """A path of so many bytes, in a new folder."""
    left = length - len(os.fsencode(os.path.realpath(folder))) - len("/evidence.sqlite")
    names = ["x" * 99] * (left // 100)
    names += ["x" * (left % 100 - 1)] if left % 100 > 1 else []
    place = folder.joinpath(*names) / "evidence.sqlite"
    place.parent.mkdir(parents=True)
    return place


@pytest.mark.parametrize("length", [504, 512, 2000])
def test_a_path_that_is_too_long_for_sqlite_is_named(tmp_path, length):
    assert refusal(write, store_at(tmp_path, length)) == (
        "its path has more than 480 bytes, too many for SQLite (move the project to a folder with a shorter path)"
    )


def test_a_path_of_almost_that_length_is_used(tmp_path):
    write(store_at(tmp_path, 479))
