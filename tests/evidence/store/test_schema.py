"""Making and checking the file of a store where processes meet or break off."""

import errno
import sqlite3

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore
from rgss.evidence.store import connection as connecting
from rgss.evidence.store import creation, schema


class BusyConnection:
    """Answers that the file is locked, as SQLite does at once when two processes switch its mode."""

    def __init__(self, refusals, message="database is locked"):
        self.refusals = refusals
        self.message = message
        self.calls = 0

    def execute(self, statement):
        assert statement == "PRAGMA journal_mode = WAL"
        self.calls += 1
        if self.calls <= self.refusals:
            raise sqlite3.OperationalError(self.message)


@pytest.fixture(autouse=True)
def short_waits(monkeypatch):
    monkeypatch.setattr(schema, "_PAUSE_S", 0.001)


def test_switching_to_write_ahead_logging_waits_for_its_turn():
    connection = BusyConnection(refusals=3)
    schema._log_ahead(connection)
    assert connection.calls == 4


def test_switching_gives_up_in_the_end(monkeypatch):
    monkeypatch.setattr(connecting, "BUSY_TIMEOUT_S", 0.01)
    with pytest.raises(sqlite3.OperationalError, match="database is locked"):
        schema._log_ahead(BusyConnection(refusals=1000))


def test_switching_does_not_wait_for_what_will_not_pass():
    connection = BusyConnection(refusals=1000, message="attempt to write a readonly database")
    with pytest.raises(sqlite3.OperationalError, match="readonly"):
        schema._log_ahead(connection)
    assert connection.calls == 1


def test_a_store_that_another_process_made_meanwhile_is_used(tmp_path, monkeypatch, record, provenance):
    path = tmp_path / "evidence.sqlite"
    make, others = creation.make, []

    def make_after_another(connection):
        if not others:
            others.append(True)
            with EvidenceStore.open(path) as store:
                store.put("a" * 64, record(), provenance)
        make(connection)

    monkeypatch.setattr(creation, "make", make_after_another)
    with EvidenceStore.open(path) as store:
        assert store.get("a" * 64).record == record()
    assert [file.name for file in tmp_path.iterdir()] == ["evidence.sqlite"]


def test_a_store_is_made_where_the_file_system_has_no_links(tmp_path, monkeypatch):
    def refused(source, target):
        raise OSError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr("os.link", refused)
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        assert len(store) == 0
    assert [file.name for file in tmp_path.iterdir()] == ["evidence.sqlite"]


def test_a_store_that_could_not_be_made_is_left_empty(tmp_path, monkeypatch):
    path = tmp_path / "evidence.sqlite"
    with monkeypatch.context() as patch:
        patch.setattr(schema, "_TABLES", (*schema._TABLES, ("trials", "CREATE TABLE more (key TEXT, key TEXT)")))
        with pytest.raises(
            EvidenceError, match=r"cannot be used: duplicate column name: key \(run 'rgss evidence verify'"
        ):
            EvidenceStore.open(path)
    with EvidenceStore.open(path) as store:
        assert len(store) == 0


def test_damage_that_only_a_check_of_the_pages_shows_is_refused(tmp_path):
    path = tmp_path / "evidence.sqlite"
    EvidenceStore.open(path).close()
    connection = sqlite3.connect(path, isolation_level=None)
    (original,) = connection.execute("SELECT sql FROM sqlite_master WHERE name = 'inputs'").fetchone()
    _rewrite_schema(connection, original.replace(" NOT NULL", ""))
    connection.close()
    connection = sqlite3.connect(path, isolation_level=None)
    connection.execute("INSERT INTO inputs (digest) VALUES ('k')")
    _rewrite_schema(connection, original)
    connection.close()
    with pytest.raises(EvidenceError) as caught:
        EvidenceStore.open(path, label="evidence.sqlite")
    assert str(caught.value) == (
        "evidence.sqlite is damaged: NULL value in inputs.content "
        "(run 'rgss evidence verify' to see what can be recovered)"
    )


def test_every_connection_is_durable_and_lets_nothing_act(tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        settings = ("journal_mode", "synchronous", "fullfsync", "trusted_schema", "cell_size_check", "mmap_size")
        found = {name: store.database.one(f"PRAGMA {name}") for name in settings}
    assert found == {
        "journal_mode": ("wal",),
        "synchronous": (2,),
        "fullfsync": (1,),
        "trusted_schema": (0,),
        "cell_size_check": (1,),
        "mmap_size": (0,),
    }


def _rewrite_schema(connection, text):
    connection.execute("PRAGMA writable_schema = ON")
    connection.execute("UPDATE sqlite_master SET sql = ? WHERE name = 'inputs'", (text,))
    connection.execute("PRAGMA writable_schema = OFF")
