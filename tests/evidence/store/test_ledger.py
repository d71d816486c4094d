"""The ledger: whatever is done to the rows of a store from outside is found, and what rgss does is not."""

# ruff: noqa: S608 - the attacker writes statements as it likes

import random
import shutil
import sqlite3
from contextlib import closing, suppress
from dataclasses import replace

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, Piece, PieceKind, RunFailure, RunFailureKind, trial_key
from rgss.evidence.store.collection import collect_garbage
from rgss.evidence.store.verification import verify
from tests.fixtures.stored_inputs import put_inputs

COLUMNS = {
    "trials": ["key", "variant", "seed", "fidelity", "content_digest", "seal", "record", "provenance"],
    "pieces": ["digest", "kind", "content_digest", "seal", "content"],
    "inputs": ["digest", "content"],
    "failures": ["key", "what", "kind", "detail", "attempts", "seal"],
    "ledger": ["name", "row_count", "checksum", "seal"],
}


def fill(path, record, provenance, numbers):
    with EvidenceStore.open(path) as store:
        for number in numbers:
            inputs = {"scene": number // 3}
            piece = Piece(digest=trial_key({"piece": number // 2}), kind=PieceKind.PLAN, text=str(number // 2))
            origin = replace(provenance, inputs={"plan": piece.digest}, inputs_digest=put_inputs(store, inputs))
            store.put_many(trials=[(trial_key({"trial": number}), record(variant=number), origin)], pieces=[piece])
            kind, detail = RunFailureKind.CRASHED, f"signal {number}"
            store.put_failure(
                RunFailure(key=trial_key({"lost": number}), what="plan", kind=kind, detail=detail, attempts=2)
            )
    return path


@pytest.fixture
def stocked(tmp_path, record, provenance):
    return fill(tmp_path / "evidence.sqlite", record, provenance, range(6))


@pytest.fixture
def foreign(tmp_path, record, provenance):
    """Another sound store, from which rows with proper seals can be taken."""
    return fill(tmp_path / "foreign.sqlite", record, provenance, range(100, 104))


def contents(path):
    """Everything in a database that can matter: its schema and its rows; None if they cannot be read."""
    with closing(sqlite3.connect(path)) as connection:
        connection.text_factory = bytes
        try:
            found = {"schema": connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_master").fetchall()}
            found |= {
                name: [connection.execute(f"PRAGMA {name}").fetchone()] for name in ("user_version", "application_id")
            }
            for table, columns in COLUMNS.items():
                typed = ", ".join(f"typeof({column}), {column}" for column in columns)
                found[table] = connection.execute(f"SELECT {typed} FROM {table}").fetchall()
        except sqlite3.Error:
            return None
    return {name: sorted(rows, key=repr) for name, rows in found.items()}


class Attacker:
    """Somebody with a shell of SQLite who knows nothing of seals."""

    def __init__(self, path, foreign, seed):
        self.path = path
        self.foreign = foreign
        self.choose = random.Random(seed)  # noqa: S311 - a sample, no secret

    def act(self):
        action = self.choose.choice(
            [self.delete, self.delete, self.edit, self.edit, self.swap, self.copy, self.bring, self.restructure]
        )
        with closing(sqlite3.connect(self.path, isolation_level=None)) as connection:
            connection.execute("ATTACH ? AS other", [str(self.foreign)])
            # A statement that the schema does not allow is no attack.
            with suppress(sqlite3.Error):
                connection.execute(*action())

    def table(self):
        return self.choose.choice([*COLUMNS])

    def some(self):
        """A condition that is true of one row, of some, or of all."""
        number = self.choose.randrange(1, 8)
        return self.choose.choice([f"rowid = {number}", f"rowid % 2 = {number % 2}", f"rowid > {number}", "1"])

    def value(self):
        """A value of any type."""
        return self.choose.choice([0, 1, -7, 2**40, 1.5, "", "x", "f" * 64, b"", b"\x00\xff", "plan", "contact", None])

    def delete(self):
        return (f"DELETE FROM {self.table()} WHERE {self.some()}",)

    def edit(self):
        table = self.table()
        column = self.choose.choice(COLUMNS[table])
        return f"UPDATE OR REPLACE {table} SET {column} = ? WHERE {self.some()}", [self.value()]

    def swap(self):
        """The value of one row in the place of another's."""
        table = self.table()
        column = self.choose.choice(COLUMNS[table])
        order = self.choose.choice(["ASC", "DESC"])
        other = f"SELECT {column} FROM {table} ORDER BY rowid {order} LIMIT 1"
        return (f"UPDATE OR IGNORE {table} SET {column} = ({other}) WHERE {self.some()}",)

    def copy(self):
        """A row once more, under another key."""
        table = self.table()
        rest = ", ".join(COLUMNS[table][1:])
        key = f"{self.choose.randrange(16**64):064x}"
        return f"INSERT INTO {table} SELECT ?, {rest} FROM {table} WHERE {self.some()} LIMIT 1", [key]

    def bring(self):
        """Rows of another store, whose seals are in order."""
        table = self.table()
        how = self.choose.choice(["IGNORE", "REPLACE"])
        return (f"INSERT OR {how} INTO {table} SELECT * FROM other.{table} WHERE {self.some()}",)

    def restructure(self):
        table = self.table()
        column = self.choose.choice(COLUMNS[table])
        return (
            self.choose.choice(
                [
                    f"DROP TABLE {table}",
                    "DROP INDEX trials_by_variant",
                    f"CREATE TABLE IF NOT EXISTS copy_of AS SELECT * FROM {table}",
                    f"ALTER TABLE {table} RENAME COLUMN {column} TO renamed",
                    f"ALTER TABLE {table} DROP COLUMN {column}",
                    f"CREATE INDEX more ON {table} ({column})",
                    f"CREATE TRIGGER t AFTER INSERT ON {table} BEGIN DELETE FROM trials; END",
                    f"PRAGMA user_version = {self.choose.randrange(5)}",
                    f"PRAGMA application_id = {self.choose.randrange(5)}",
                ]
            ),
        )


def is_found(path):
    """Whether a check finds something, and whether the next sweep would."""
    try:
        by_check = bool(verify(path, label="it").damages)
    except EvidenceError:
        by_check = True
    return by_check


@pytest.mark.parametrize("part", range(8))
def test_every_change_of_the_rows_or_the_schema_is_found(stocked, foreign, tmp_path, part):
    honest = contents(stocked)
    assert not is_found(stocked)
    changed = 0
    for seed in range(part * 50, part * 50 + 50):
        attacked = tmp_path / "attacked.sqlite"
        shutil.copy(stocked, attacked)
        attacker = Attacker(attacked, foreign, seed)
        for _ in range(attacker.choose.choice([1, 1, 2, 3])):
            attacker.act()
        differs = contents(attacked) != honest
        assert is_found(attacked) == differs, seed
        changed += differs
        for left in tmp_path.glob("attacked.sqlite*"):
            left.unlink()
    assert changed > 25


@pytest.mark.parametrize("table", ["trials", "pieces", "inputs", "failures"])
@pytest.mark.parametrize("change", ["DELETE FROM {0} WHERE rowid = 2", "INSERT INTO {0} SELECT * FROM other.{0}"])
def test_the_next_one_to_open_it_is_told(stocked, foreign, table, change):
    with closing(sqlite3.connect(stocked, isolation_level=None)) as connection:
        connection.execute("ATTACH ? AS other", [str(foreign)])
        connection.execute(change.format(table))
    for create in (True, False):
        with pytest.raises(EvidenceError) as caught:
            EvidenceStore.open(stocked, create=create, label="it")
        assert caught.value.message.startswith(f"it was changed outside rgss: table {table}: ")
    with pytest.raises(EvidenceError, match="was changed outside rgss"):
        collect_garbage(stocked, trials=set(), pieces=set(), label="it")


def test_everything_that_rgss_does_keeps_the_ledger(stocked, record, provenance):
    keys = [trial_key({"lost": number}) for number in range(6)]
    with EvidenceStore.open(stocked) as store:
        trials = {trial.key for trial in store.all()}
        # A failure in place of another one, and one that is made after all.
        for detail in ("once", "twice"):
            store.put_failure(
                RunFailure(key=keys[2], what="plan", kind=RunFailureKind.RAISED, detail=detail, attempts=1)
            )
        store.put_many(pieces=[Piece(digest=keys[3], kind=PieceKind.PLAN, text="made")])
        with pytest.raises(EvidenceError, match="non-determinism"):
            store.put_many(pieces=[Piece(digest=keys[3], kind=PieceKind.PLAN, text="otherwise")])
        assert not store.put(*next((trial.key, trial.record, trial.provenance) for trial in store.iterate()))
        store.confirm()
    assert verify(stocked, label="it").sound == {"trial": 6, "piece": 4, "inputs": 2, "failure": 5}
    assert not is_found(stocked)
    collect_garbage(stocked, trials=set(sorted(trials)[:2]), pieces=set(), label="it")
    assert not is_found(stocked)
    with EvidenceStore.open(stocked) as store:
        assert len(store) == 2


def test_a_store_of_the_schema_before_gets_a_ledger(stocked):
    with closing(sqlite3.connect(stocked, isolation_level=None)) as connection:
        connection.execute("DROP TABLE ledger")
        connection.execute("PRAGMA user_version = 2")
    with EvidenceStore.open(stocked) as store:
        assert len(store.all()) == 6
    assert not is_found(stocked)


def test_a_sound_row_in_the_place_of_another_is_found_by_the_checksum_alone(stocked, foreign):
    with closing(sqlite3.connect(stocked, isolation_level=None)) as connection:
        connection.execute("ATTACH ? AS other", [str(foreign)])
        connection.execute("DELETE FROM failures WHERE rowid = 2")
        connection.execute("INSERT INTO failures SELECT * FROM other.failures LIMIT 1")
    assert [str(damage) for damage in verify(stocked, label="it").damages] == [
        "ledger failures: the 6 rows are not those that were stored"
    ]
