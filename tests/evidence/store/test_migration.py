"""From older schemas to the present one: nothing is lost or gets better than it was, and a crash changes nothing."""

import random
import shutil
import signal
import sqlite3
import subprocess
import sys

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, Fidelity, Provenance, record_digest
from rgss.evidence.store.verification import verify
from tests.fixtures.processes import PATIENCE_S


@pytest.fixture
def old(path, first_store):
    first_store(path, range(40))
    return path


def raw(path):
    """Version of a database file and every row of its trials, as SQLite alone reads them."""
    connection = sqlite3.connect(path)
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    rows = connection.execute("SELECT * FROM trials ORDER BY key").fetchall()
    connection.close()
    return version, rows


def test_every_trial_is_carried_over(old, record, key):
    with EvidenceStore.open(old, label="evidence.sqlite") as store:
        trials = store.all()
        assert [trial.key for trial in trials] == sorted(key(number) for number in range(40))
        assert {trial.key: trial.record for trial in trials} == {
            key(number): record(variant=number) for number in range(40)
        }
        assert all(trial.content_digest == record_digest(trial.record) for trial in trials)
        assert trials[0].provenance == Provenance(inputs={"plan": "a" * 64}, versions={"rgss": "0.1.0"})
        assert store.trials_of(7, 7, Fidelity.CONTACT) == (store.get(key(7)),)
        assert not store.put(key(7), record(variant=7), trials[0].provenance)
    assert verify(old, label="evidence.sqlite").damages == ()
    assert raw(old)[0] == 3


def test_an_old_store_without_trials_becomes_a_new_one(path, first_store, record, provenance, key):
    first_store(path, [])
    with EvidenceStore.open(path) as store:
        assert len(store) == 0
        assert store.put(key(1), record(), provenance)


def test_the_file_is_then_the_same_as_that_of_a_new_store(old, tmp_path):
    EvidenceStore.open(old).close()
    EvidenceStore.open(tmp_path / "new.sqlite").close()
    schemas = []
    for path in (old, tmp_path / "new.sqlite"):
        connection = sqlite3.connect(path)
        schemas.append(sorted(connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_master").fetchall()))
        schemas[-1].append(connection.execute("PRAGMA application_id").fetchone())
        connection.close()
    assert schemas[0] == schemas[1]


@pytest.mark.parametrize(
    ("statement", "problem"),
    [
        ("UPDATE trials SET record = replace(record, '12.5', '11.5')", "its record is not the one that was put"),
        ("UPDATE trials SET record = ''", "its record is not the one that was put"),
        ("UPDATE trials SET record = x'ff00'", "its record is not UTF-8"),
        ("UPDATE trials SET record = CAST(x'ff0a' AS TEXT)", "its record is not UTF-8"),
        ("UPDATE trials SET record = '[' || record || ']'", "its record is not the one that was put"),
        (
            "UPDATE trials SET record = replace(record, '\"variant\":3', '\"variant\":1e999')",
            "its record is not the one",
        ),
        ("UPDATE trials SET seal = 'x'", "its record or provenance belongs to another row"),
        ("UPDATE trials SET provenance = '{}'", "its record or provenance belongs to another row"),
    ],
)
def test_a_row_that_was_damaged_before_is_damaged_after(old, change, key, statement, problem):
    change(old, f"{statement} WHERE key = ?", key(3))
    with EvidenceStore.open(old, label="evidence.sqlite") as store:
        assert len(store) == 40
        assert store.get(key(2)) is not None
        with pytest.raises(EvidenceError) as caught:
            store.get(key(3))
    assert caught.value.message.startswith(f"evidence.sqlite: trial {key(3)[:12]} is damaged: {problem}")
    (damage,) = verify(old, label="evidence.sqlite").damages
    assert damage.key == key(3)[:12]


@pytest.mark.parametrize(
    "statement",
    [
        "CREATE TRIGGER t AFTER INSERT ON trials BEGIN DELETE FROM trials; END",
        "CREATE VIEW v AS SELECT 1",
        "CREATE TABLE pieces (name TEXT)",
        "ALTER TABLE trials ADD COLUMN more TEXT",
    ],
)
def test_an_old_schema_with_surprises_is_refused_and_left_as_it_is(old, change, statement):
    change(old, statement)
    with pytest.raises(EvidenceError) as caught:
        EvidenceStore.open(old, label="evidence.sqlite")
    assert caught.value.message == "evidence.sqlite has a foreign schema"
    assert raw(old)[0] == 1


def test_an_old_store_with_a_damaged_index_is_refused_before_a_row_is_lost(old):
    connection = sqlite3.connect(old, isolation_level=None)
    connection.execute("PRAGMA journal_mode = DELETE")
    (page,) = connection.execute("SELECT rootpage FROM sqlite_master WHERE type = 'index'").fetchone()
    connection.close()
    content = bytearray(old.read_bytes())
    # The index says that it has no entries.
    content[(page - 1) * 4096 : (page - 1) * 4096 + 8] = b"\x0a\x00\x00\x00\x00\x10\x00\x00"
    old.write_bytes(content)
    with pytest.raises(EvidenceError) as caught:
        EvidenceStore.open(old, label="evidence.sqlite")
    assert caught.value.message.startswith("evidence.sqlite is damaged: ")
    assert caught.value.hint == "move the file away and run the sweep again"
    assert raw_version(old) == 1


def raw_version(path):
    connection = sqlite3.connect(path)
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    connection.close()
    return version


PROGRAM = """\
import os, signal, sys
from pathlib import Path
import rgss.evidence.store.migration as migration
from rgss.evidence import EvidenceStore

left = int(sys.argv[2])
names = migration._names
def killed(record):
    global left
    left -= 1
    if left < 0:
        os.kill(os.getpid(), signal.SIGKILL)
    return names(record)
migration._names = killed
EvidenceStore.open(Path(sys.argv[1]))
"""


@pytest.mark.parametrize("rows", [0, 1, 39])
def test_one_that_is_killed_on_the_way_leaves_the_old_store(old, rows):
    before = raw(old)
    done = subprocess.run([sys.executable, "-c", PROGRAM, str(old), str(rows)], check=False)
    assert done.returncode == -signal.SIGKILL
    assert raw(old) == before
    assert before[0] == 1
    with EvidenceStore.open(old) as store:
        assert len(store.all()) == 40


def test_one_that_is_killed_at_any_statement_leaves_the_old_store_or_the_new_one(old, tmp_path):
    program = (
        "import os, signal, sqlite3, sys; from pathlib import Path; from rgss.evidence import EvidenceStore\n"
        "path, *steps = sys.argv[1:]\n"
        "connect = sqlite3.connect\n"
        "for number, step in enumerate(steps):\n"
        "    child = os.fork()\n"
        "    if child == 0:\n"
        "        def killing(*arguments, **options):\n"
        "            connection = connect(*arguments, **options)\n"
        "            connection.set_progress_handler(lambda: os.kill(os.getpid(), signal.SIGKILL), int(step))\n"
        "            return connection\n"
        "        sqlite3.connect = killing\n"
        "        EvidenceStore.open(Path(path) / str(number))\n"
        "        os._exit(0)\n"
        "    os.waitpid(child, 0)\n"
    )
    choose = random.Random(11)  # noqa: S311
    # The whole takes some ten thousand steps of SQLite's machine.
    steps = [*(choose.randrange(1, 400) for _ in range(10)), *(choose.randrange(400, 12_000) for _ in range(20))]
    folder = tmp_path / "copies"
    folder.mkdir()
    for number in range(len(steps)):
        shutil.copy(old, folder / str(number))
    subprocess.run([sys.executable, "-c", program, str(folder), *map(str, steps)], check=True)
    before = raw(old)
    versions = set()
    for number in range(len(steps)):
        version, rows = raw(folder / str(number))
        versions.add(version)
        assert len(rows) == 40
        if version == 1:
            assert rows == before[1]
        assert verify(folder / str(number), label="store").damages == ()
    assert 1 in versions


def test_several_processes_that_open_an_old_store_at_once_agree(old):
    program = "import sys; from pathlib import Path; from rgss.evidence import EvidenceStore; sys.stdin.readline()\n"
    program += "with EvidenceStore.open(Path(sys.argv[1])) as store: print(len(store.all()))"
    readers = [
        subprocess.Popen(
            [sys.executable, "-c", program, str(old)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        for _ in range(3)
    ]
    assert [reader.communicate("\n", timeout=PATIENCE_S)[0] for reader in readers] == ["40\n"] * 3
    assert raw(old)[0] == 3


def test_an_old_rgss_that_still_has_the_store_open_is_told_and_does_no_harm(old, first_store):
    then = sqlite3.connect(old, isolation_level=None)
    assert then.execute("SELECT count(*) FROM trials").fetchone() == (40,)
    EvidenceStore.open(old).close()
    with pytest.raises(sqlite3.OperationalError, match="table trials has 8 columns but 5 values were supplied"):
        then.execute("INSERT OR IGNORE INTO trials VALUES (?, ?, ?, ?, ?)", ("k", "c", "s", "r", "p"))
    then.close()
    assert verify(old, label="store").sound["trial"] == 40
