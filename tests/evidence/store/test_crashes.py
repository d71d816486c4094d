"""What a crash leaves: a process killed at any instant, a log cut off anywhere, a file that lost its log."""

import json
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.evidence import EvidenceStore, record_to_json
from rgss.evidence.store.verification import verify

ROUNDS = 60
PROGRAM = Path(__file__).with_name("kill_rounds.py")

WRITER = """\
import os, signal, sys
from dataclasses import replace
from pathlib import Path
from rgss.evidence import EvidenceStore, Provenance, record_from_json, trial_key

record = record_from_json(sys.argv[2])
store = EvidenceStore.open(Path(sys.argv[1]))
for number in range(12):
    numbers = [10 * number + part for part in range(3)]
    provenance = Provenance(inputs={}, versions={})
    store.put_many(trials=[(trial_key({"trial": n}), replace(record, variant=n), provenance) for n in numbers])
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_process_killed_at_any_instant_costs_nothing_but_what_it_had_in_hand(path, record):
    done = subprocess.run(
        [sys.executable, str(PROGRAM), str(path), record_to_json(record()), str(ROUNDS), "7"],
        capture_output=True,
        text=True,
        check=True,
    )
    seen = json.loads(done.stdout)
    assert seen["wrong"] == []
    # A third and more of the rounds wait until the writer has put something.
    assert seen["put"] > ROUNDS / 3
    assert seen["same"]
    assert seen["damages"] == []
    trials = seen["put"] + 5
    assert seen["sound"] == {"trial": trials, "piece": 3 * trials, "inputs": trials, "failure": 0}


@pytest.fixture
def crashed(path, record):
    """The path of a store with twelve transactions of three trials, all still in the log."""
    done = subprocess.run([sys.executable, "-c", WRITER, str(path), record_to_json(record())], check=False)
    assert done.returncode == -signal.SIGKILL
    assert path.with_name("evidence.sqlite-wal").stat().st_size > 50_000
    return path


def transactions(path):
    """How many transactions a store has; each must be whole, and none may be missing between two."""
    with EvidenceStore.open(path) as store:
        variants = sorted(trial.record.variant for trial in store.iterate())
    whole = [10 * number + part for number in range(len(variants) // 3) for part in range(3)]
    assert variants == whole
    return len(whole) // 3


def test_what_a_killed_process_left_in_the_log_is_kept(crashed):
    assert transactions(crashed) == 12
    assert verify(crashed, label="store").damages == ()
    # The last to close the file has brought the log into it.
    assert [left.name for left in crashed.parent.iterdir()] == ["evidence.sqlite"]


def test_a_log_that_is_cut_off_anywhere_holds_the_transactions_before(crashed, tmp_path):
    log = crashed.with_name("evidence.sqlite-wal").read_bytes()
    choose = random.Random(3)  # noqa: S311
    found = set()
    for number, length in enumerate([0, 1, 31, 32, 33, len(log) - 1, *(choose.randrange(len(log)) for _ in range(25))]):
        copy = tmp_path / str(number) / "evidence.sqlite"
        copy.parent.mkdir()
        shutil.copy(crashed, copy)
        # What a loss of power tears off may also come back as noise.
        tail = choose.randbytes(choose.choice([0, 100, 5000]))
        copy.with_name("evidence.sqlite-wal").write_bytes(log[:length] + tail)
        found.add(transactions(copy))
        assert verify(copy, label="store").damages == ()
    assert {0, 11} <= found <= set(range(12))
    assert len(found) > 5


def test_what_is_beside_the_file_may_be_missing_or_nonsense(crashed):
    crashed.with_name("evidence.sqlite-shm").write_bytes(b"nonsense" * 4096)
    assert transactions(crashed) == 12


def test_the_log_of_a_file_that_was_moved_away_does_no_harm(crashed, tmp_path):
    crashed.rename(tmp_path / "moved.sqlite")
    with EvidenceStore.open(crashed) as store:
        assert len(store) == 0
    assert verify(crashed, label="store").damages == ()


def test_a_process_killed_while_it_gives_space_back_loses_nothing(path, record, provenance, key):
    with EvidenceStore.open(path) as store:
        store.put_many(trials=[(key(number), record(variant=number), provenance) for number in range(60)])
    program = (
        "import os, signal, sys; from pathlib import Path; import rgss.evidence.store.collection as collection\n"
        "from rgss.evidence import trial_key; keep = {trial_key({'trial': number}) for number in range(50)}\n"
        "give_back = collection._compact\n"
        "def killed(connection):\n"
        "    connection.set_progress_handler(lambda: os.kill(os.getpid(), signal.SIGKILL), int(sys.argv[2]))\n"
        "    give_back(connection)\n"
        "collection._compact = killed\n"
        "collection.collect_garbage(Path(sys.argv[1]), trials=keep, pieces=frozenset(), label='store')"
    )
    for steps in (1, 10, 100, 300):
        done = subprocess.run([sys.executable, "-c", program, str(path), str(steps)], check=False)
        assert done.returncode == -signal.SIGKILL
        with EvidenceStore.open(path) as store:
            assert sorted(trial.record.variant for trial in store.iterate()) == list(range(50))
        assert verify(path, label="store").damages == ()
    connection = sqlite3.connect(path)
    assert connection.execute("PRAGMA journal_mode").fetchone() == ("wal",)
    connection.close()
