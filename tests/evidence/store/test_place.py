"""Stores behind links, and what is in the place of a store without being a file."""

import os
import socket
import sqlite3
import subprocess
import sys
from contextlib import closing

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import EvidenceStore
from rgss.evidence.store import collect_garbage, observed, schema, state_of, verify
from tests.fixtures.processes import PATIENCE_S

LEAVES_ITS_LOG = """
import os, sys
from pathlib import Path
from rgss.evidence import EvidenceStore, Piece, PieceKind, trial_key
store = EvidenceStore.open(Path(sys.argv[1]))
store.put_many(pieces=[Piece(digest=trial_key({"piece": 1}), kind=PieceKind.PLAN, text="1")])
os._exit(0)
"""


@pytest.fixture(params=["file", "folder"])
def linked(tmp_path, request):
    """A store behind a link, and the store's own path."""
    far, near = tmp_path / "far", tmp_path / "near"
    far.mkdir()
    if request.param == "folder":
        near.symlink_to(far, target_is_directory=True)
        return near / "evidence.sqlite", far / "evidence.sqlite"
    near.mkdir()
    (near / "evidence.sqlite").symlink_to(far / "own.sqlite")
    return near / "evidence.sqlite", far / "own.sqlite"


def test_a_store_is_made_at_the_end_of_a_link(linked):
    link, own = linked
    EvidenceStore.open(link).close()
    assert own.is_file()
    assert not own.is_symlink()
    assert link.samefile(own)


def test_what_is_only_in_the_log_of_a_linked_store_is_read(linked):
    link, own = linked
    EvidenceStore.open(own).close()
    subprocess.run([sys.executable, "-c", LEAVES_ITS_LOG, str(link)], check=True, timeout=PATIENCE_S)
    assert own.with_name(f"{own.name}-wal").stat().st_size > 0

    def pieces(store):
        return store.database.rows("SELECT count(*) FROM pieces")[0][0]

    with EvidenceStore.open(link, read_only=True) as store:
        assert pieces(store) == 1
    assert observed(link, pieces, label="it") == 1


def test_a_change_in_the_log_of_a_linked_store_is_another_state(linked):
    link, own = linked
    EvidenceStore.open(own).close()
    with EvidenceStore.open(link) as store:
        before = state_of(link)
        with store.database.transaction():
            store.database.change("DELETE FROM ledger")
        assert state_of(link) != before


def test_the_loss_of_the_log_of_a_linked_store_is_noticed(linked):
    link, own = linked
    EvidenceStore.open(own).close()
    with EvidenceStore.open(link, label="it") as store:
        own.with_name(f"{own.name}-wal").unlink()
        with pytest.raises(StorageError, match="it lost its write-ahead log while it was in use"):
            store.confirm()


def actions(path):
    return {
        "open": lambda: EvidenceStore.open(path, label="it"),
        "read": lambda: EvidenceStore.open(path, read_only=True, label="it"),
        "observe": lambda: observed(path, len, label="it"),
        "verify": lambda: verify(path, label="it"),
        "collect": lambda: collect_garbage(path, trials=set(), pieces=set(), label="it"),
    }


ACTIONS = actions(None)


@pytest.mark.parametrize("action", ACTIONS)
@pytest.mark.parametrize("kind", ["a folder", "a pipe", "a socket", "a device", "a link in a circle of links"])
def test_what_is_no_file_is_named(tmp_path, monkeypatch, action, kind):
    path = tmp_path / "evidence.sqlite"
    # The path of a socket has a limit.
    monkeypatch.chdir(tmp_path)
    with closing(socket.socket(socket.AF_UNIX)) as listening:
        {
            "a folder": path.mkdir,
            "a pipe": lambda: os.mkfifo(path),
            "a socket": lambda: listening.bind(path.name),
            "a device": lambda: path.symlink_to("/dev/null"),
            "a link in a circle of links": lambda: path.symlink_to(path),
        }[kind]()
        with pytest.raises(EvidenceError) as caught:
            actions(path)[action]()
    assert str(caught.value) == f"it must be a regular file, but it is {kind} (move it away)"


@pytest.mark.parametrize("action", ACTIONS)
@pytest.mark.parametrize("which", ["file", "folder"])
def test_a_link_to_a_disk_that_is_not_there_stays_as_it_is(tmp_path, action, which):
    folder = tmp_path / "near"
    disk = tmp_path / "disk" / "evidence"
    if which == "folder":
        folder.symlink_to(disk)
    else:
        folder.mkdir()
        (folder / "evidence.sqlite").symlink_to(disk / "evidence.sqlite")
    problem = f"it is a link to {disk / 'evidence.sqlite'}, whose folder does not exist"
    with pytest.raises(EvidenceError) as caught:
        actions(folder / "evidence.sqlite")[action]()
    assert str(caught.value) == f"{problem} (make that folder, or remove the link)"
    assert not disk.parent.exists()
    assert (folder if which == "folder" else folder / "evidence.sqlite").is_symlink()


def test_a_reader_of_a_file_without_a_log_is_waited_for_once(tmp_path, monkeypatch):
    path = tmp_path / "evidence.sqlite"
    EvidenceStore.open(path).close()
    with closing(sqlite3.connect(path, isolation_level=None)) as reader:
        reader.execute("PRAGMA journal_mode = DELETE")
        reader.execute("BEGIN")
        reader.execute("SELECT count(*) FROM trials").fetchone()
        asked = []
        with closing(sqlite3.connect(path, isolation_level=None, timeout=0.0)) as waiting:
            waiting.set_trace_callback(asked.append)
            # The clock of a process whose every attempt takes as long as SQLite waits.
            times = iter(range(0, 1_000_000, 31))
            monkeypatch.setattr(schema.time, "monotonic", lambda: next(times))
            monkeypatch.setattr(schema.time, "sleep", lambda _: None)
            with pytest.raises(sqlite3.OperationalError, match="locked"):
                schema.prepare(waiting, "it")
    assert asked.count("PRAGMA journal_mode = WAL") == 1
