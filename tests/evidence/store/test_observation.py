"""A store that another process writes is read without a byte of its folder being changed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import EvidenceStore
from rgss.evidence.store import observed, state_of

WRITER = """
import pickle, sys
from pathlib import Path
from rgss.evidence import EvidenceStore
with EvidenceStore.open(Path(sys.argv[1])) as store:
    while True:
        try:
            trials = pickle.load(sys.stdin.buffer)
        except EOFError:
            break
        store.put_many(trials=trials)
        print("put", flush=True)
"""


class Writer:
    """A process of its own that has a store open."""

    def __init__(self, path: Path) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-c", WRITER, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )

    def put(self, trials: object) -> None:
        import pickle

        pickle.dump(trials, self._process.stdin)
        self._process.stdin.flush()
        assert self._process.stdout.readline() == b"put\n"

    def end(self, *, killed: bool = False) -> None:
        if killed:
            self._process.kill()
        self._process.communicate()


@pytest.fixture
def path(tmp_path) -> Path:
    return tmp_path / "evidence of 100 % & more?.sqlite"


@pytest.fixture
def trial(record, provenance, key):
    return lambda number: (key(number), record(variant=number), provenance)


@pytest.fixture
def stored(path, trial) -> Path:
    with EvidenceStore.open(path) as store:
        store.put_many(trials=[trial(number) for number in range(3)])
    return path


@pytest.fixture
def writer(stored):
    process = Writer(stored)
    yield process
    process.end()


def variants(store: EvidenceStore) -> list[int]:
    return sorted(each.record.variant for each in store.iterate())


def content(folder: Path) -> dict[str, bytes]:
    return {each.name: each.read_bytes() for each in folder.iterdir()}


def look(path: Path) -> list[int]:
    """The variants in a store, read without a change of its folder."""
    before = content(path.parent)
    found = observed(path, variants, label="it")
    assert content(path.parent) == before
    return found


def test_without_a_writer(stored):
    assert look(stored) == [0, 1, 2]
    assert [each.name for each in stored.parent.iterdir()] == [stored.name]


def test_while_another_process_writes(stored, writer, trial):
    writer.put([trial(7)])
    assert look(stored) == [0, 1, 2, 7]
    first = state_of(stored)
    writer.put([trial(8)])
    assert look(stored) == [0, 1, 2, 7, 8]
    assert state_of(stored) != first


def test_after_the_writer_has_ended(stored, trial):
    writer = Writer(stored)
    writer.put([trial(7)])
    writer.end()
    assert look(stored) == [0, 1, 2, 7]


def test_after_the_writer_was_killed(stored, trial):
    writer = Writer(stored)
    writer.put([trial(7)])
    writer.end(killed=True)
    assert stored.with_name(f"{stored.name}-wal").stat().st_size > 0
    assert look(stored) == [0, 1, 2, 7]


def test_a_log_without_its_index_is_refused(stored, trial):
    writer = Writer(stored)
    writer.put([trial(7)])
    writer.end(killed=True)
    stored.with_name(f"{stored.name}-shm").unlink()
    with pytest.raises(EvidenceError) as caught:
        look(stored)
    assert str(caught.value) == (
        "the evidence store it cannot be used: its log has no index "
        "(run 'rgss evidence' with write access to the file, which merges its log)"
    )
    with EvidenceStore.open(stored, create=False) as store:
        assert variants(store) == [0, 1, 2, 7]
    assert look(stored) == [0, 1, 2, 7]


def test_a_missing_store(path):
    assert not state_of(path).exists
    with pytest.raises(EvidenceError) as caught:
        look(path)
    assert str(caught.value) == "there is no evidence in it (run the sweep first)"
    assert content(path.parent) == {}


def test_a_store_that_was_replaced_or_removed(stored, trial, tmp_path_factory):
    before = state_of(stored)
    other = tmp_path_factory.mktemp("other") / "other.sqlite"
    with EvidenceStore.open(other) as store:
        store.put_many(trials=[trial(9)])
    other.replace(stored)
    assert state_of(stored) != before
    assert look(stored) == [9]
    stored.unlink()
    with pytest.raises(EvidenceError, match="there is no evidence in it"):
        look(stored)


def test_a_writer_that_comes_meanwhile_lets_it_be_read_again(stored, trial):
    calls = []

    def read(store: EvidenceStore) -> list[int]:
        found = variants(store)
        if not calls:
            with EvidenceStore.open(stored) as other:
                other.put_many(trials=[trial(7)])
        calls.append(found)
        return variants(store)

    assert observed(stored, read, label="it") == [0, 1, 2, 7]
    assert calls[1:] == [[0, 1, 2, 7]]


def test_a_file_that_never_stays_the_same(stored, trial):
    numbers = iter(range(10, 100))

    def read(store: EvidenceStore) -> None:
        with EvidenceStore.open(stored) as other:
            other.put_many(trials=[trial(next(numbers))])

    with pytest.raises(StorageError) as caught:
        observed(stored, read, label="it")
    assert str(caught.value) == "it changes faster than it can be read (try again later)"


def test_who_puts_something_into_it_is_refused(stored, trial):
    with (
        EvidenceStore.open(stored, read_only=True, label="it") as store,
        pytest.raises(EvidenceError, match="attempt to write a readonly database"),
    ):
        store.put_many(trials=[trial(9)])
