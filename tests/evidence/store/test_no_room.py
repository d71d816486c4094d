"""A system that has no room for another file, or lets nothing more be written: the kind of error that it is."""

import errno
import os
import sqlite3

import pytest

from rgss.errors import EvidenceError, StorageError
from rgss.evidence import EvidenceStore
from rgss.evidence.store import connection as connecting


def raising(number):
    def refuse(*_, **__):
        raise OSError(number, os.strerror(number))

    return refuse


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EMFILE, errno.ENFILE])
def test_no_room_for_a_folder_is_a_failure_of_the_run(path, monkeypatch, number):
    monkeypatch.setattr("pathlib.Path.mkdir", raising(number))
    with pytest.raises(StorageError, match=rf"^the folder of it cannot be created: {os.strerror(number)} \(free space"):
        EvidenceStore.open(path, label="it")


def test_a_folder_that_may_not_be_made_is_a_mistake_still(path, monkeypatch):
    monkeypatch.setattr("pathlib.Path.mkdir", raising(errno.EACCES))
    with pytest.raises(EvidenceError, match="Permission denied") as caught:
        EvidenceStore.open(path, label="it")
    assert not isinstance(caught.value, StorageError)


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EMFILE])
def test_what_sqlite_does_not_tell_is_asked_of_the_system(path, monkeypatch, number):
    """SQLite says that it is unable to open the file, whatever the reason."""

    def unable(*_, **__):
        raise sqlite3.OperationalError("unable to open database file")

    with monkeypatch.context() as patch:
        patch.setattr("sqlite3.connect", unable)
        with pytest.raises(EvidenceError, match="unable to open database file") as caught:
            EvidenceStore.open(path, label="it")
        assert not isinstance(caught.value, StorageError)
        patch.setattr(connecting.tempfile, "TemporaryFile", raising(number))
        with pytest.raises(StorageError) as caught:
            EvidenceStore.open(path, label="it")
    assert str(caught.value) == (
        f"the evidence store it cannot be used: {os.strerror(number)} "
        "(free space on the disk, or raise the limit; earlier entries are stored)"
    )


@pytest.mark.parametrize("problem", ["attempt to write a readonly database", "unable to open database file"])
def test_a_store_that_can_no_longer_be_written_is_a_failure_of_the_run(path, record, provenance, problem):
    """As when the file system is made read-only under it."""
    store = EvidenceStore.open(path, label="it")
    connection = store.database.connection

    class Refusing:
        in_transaction = False

        def execute(self, statement, *values):
            if statement.startswith("BEGIN IMMEDIATE"):
                raise sqlite3.OperationalError(problem)
            return connection.execute(statement, *values)

    store.database.connection = Refusing()
    with pytest.raises(StorageError, match=problem):
        store.put("a" * 64, record(), provenance)
    connection.close()
