"""Several processes on one store, and processes that end before they are done."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, record_digest, record_to_json, trial_key
from rgss.evidence.store.verification import verify
from tests.fixtures.processes import PATIENCE_S

WRITER = """\
import sys
from dataclasses import replace
from pathlib import Path
from rgss.evidence import EvidenceStore, Piece, PieceKind, Provenance, inputs_digest, record_from_json, trial_key

path, text, first, last, seed = sys.argv[1:]
record = record_from_json(text)
print("ready", flush=True)
sys.stdin.readline()
with EvidenceStore.open(Path(path)) as store:
    for number in range(int(first), int(last)):
        piece = Piece(digest=trial_key({"piece": number // 2}), kind=PieceKind.PLAN, text=str(number // 2))
        inputs = {"scene": number // 5}
        provenance = Provenance(inputs={"plan": piece.digest}, versions={}, inputs_digest=inputs_digest(inputs))
        trial = (trial_key({"trial": number}), replace(record, variant=number, seed=int(seed)), provenance)
        store.put_many(trials=[trial], pieces=[piece], inputs=[inputs])
        print(number, flush=True)
"""


def start(path, text, first, last, seed=7):
    command = [sys.executable, "-c", WRITER, str(path), text, str(first), str(last), str(seed)]
    writer = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert writer.stdout.readline() == "ready\n"
    return writer


def go(writer):
    writer.stdin.write("\n")
    writer.stdin.flush()


def end(writer):
    # Read from the stream that lines were read from: `communicate` passes by what it has buffered.
    output = writer.stdout.read()
    _, problems = writer.communicate(timeout=PATIENCE_S)
    return writer.returncode, [int(line) for line in output.split()], problems


def numbers(path):
    with EvidenceStore.open(path, create=False) as store:
        return {trial.record.variant for trial in store.all()}


@pytest.mark.parametrize("after", [1, 7, 20])
def test_a_process_killed_while_writing_leaves_every_trial_that_it_had_put(tmp_path, record, after):
    path = tmp_path / "evidence.sqlite"
    writer = start(path, record_to_json(record()), 0, 1_000_000)
    go(writer)
    said = [int(writer.stdout.readline()) for _ in range(after)]
    writer.send_signal(signal.SIGKILL)
    code, more, _ = end(writer)
    assert code == -signal.SIGKILL
    kept = numbers(path)
    put = set(said + more)
    # The trial in hand when the signal came is there as a whole or not at all.
    assert kept in (put, put | {len(put)})
    again = start(path, record_to_json(record()), 0, len(kept) + 3)
    go(again)
    assert end(again)[0] == 0
    assert numbers(path) == set(range(len(kept) + 3))


def test_several_processes_make_and_fill_one_store_at_once(tmp_path, record):
    path = tmp_path / "evidence.sqlite"
    writers = [start(path, record_to_json(record()), first, first + 20) for first in (0, 10, 20)]
    for writer in writers:
        go(writer)
    results = [end(writer) for writer in writers]
    assert [(code, problems) for code, _, problems in results] == [(0, "")] * 3
    assert numbers(path) == set(range(40))
    found = verify(path, label="store")
    assert found.damages == ()
    assert found.sound == {"trial": 40, "piece": 20, "inputs": 8, "failure": 0}


def test_processes_that_disagree_are_found_out(tmp_path, record):
    path = tmp_path / "evidence.sqlite"
    writers = [start(path, record_to_json(record()), 0, 1, seed) for seed in (1, 2)]
    for writer in writers:
        go(writer)
    results = [end(writer) for writer in writers]
    assert sorted(code for code, _, _ in results) == [0, 1]
    assert "EvidenceError: non-determinism: trial " in "".join(problems for _, _, problems in results)
    with EvidenceStore.open(path) as store:
        (trial,) = store.all()
        assert trial.record.seed in (1, 2)
        assert trial.content_digest == record_digest(trial.record)


def test_a_store_half_made_by_a_process_that_died_is_completed(tmp_path):
    program = (
        "import os, sys; from pathlib import Path; import rgss.evidence.store.creation as creation\n"
        "creation.make = lambda connection: (connection.execute('BEGIN IMMEDIATE'),"
        " connection.execute('CREATE TABLE trials (key TEXT)'), os._exit(9))\n"
        "from rgss.evidence import EvidenceStore; EvidenceStore.open(Path(sys.argv[1]))"
    )
    path = tmp_path / "evidence.sqlite"
    assert subprocess.run([sys.executable, "-c", program, str(path)], check=False).returncode == 9
    # What it had begun is under another name, and goes with the next one that makes the store.
    assert not path.exists()
    assert [file.suffix for file in tmp_path.iterdir() if "journal" not in file.name] == [".new"]
    with EvidenceStore.open(path) as store:
        assert store.get(trial_key({})) is None
    assert [file.name for file in tmp_path.iterdir()] == ["evidence.sqlite"]


def test_opening_what_is_not_there_does_not_make_it(tmp_path):
    with pytest.raises(EvidenceError):
        EvidenceStore.open(Path(tmp_path / "a" / "b.sqlite"), create=False)
    assert list(tmp_path.iterdir()) == []
