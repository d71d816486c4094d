"""A disk that fills: by a limit of the size of files, which the system sets for a process without rights."""

import subprocess
import sys

import pytest

from rgss.evidence import EvidenceStore, record_to_json
from rgss.evidence.store.verification import verify

LIMITED = """\
import resource, sys
from dataclasses import replace
from pathlib import Path
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, Piece, PieceKind, Provenance, record_from_json, trial_key
from rgss.evidence.store.exporting import export_trials
from rgss.evidence.store.collection import collect_garbage

path, record = Path(sys.argv[1]), record_from_json(sys.argv[2])
hard = resource.getrlimit(resource.RLIMIT_FSIZE)[1]
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[3]), hard))

def put(number):
    name = trial_key({"trial": number})
    provenance = Provenance(inputs={"plan": name}, versions={})
    piece = Piece(digest=name, kind=PieceKind.PLAN, text='"%s"' % ("x" * 4000))
    store.put_many(trials=[(name, replace(record, variant=number), provenance)], pieces=[piece])

try:
"""

WRITE = """\
    with EvidenceStore.open(path, label="it") as store:
        for number in range(len(store), 100_000):
            put(number)
            print(number)
except EvidenceError as error:
    print(error, file=sys.stderr)
"""


def limited(body, path, text, size, *words):
    command = [sys.executable, "-c", LIMITED + body, str(path), text, str(size), *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    (complaint,) = done.stderr.splitlines()
    return [int(line) for line in done.stdout.split()], complaint


FULL = (
    "the evidence store it cannot be used: disk I/O error "
    "(free space on the disk or check its health; earlier entries are stored)"
)


@pytest.mark.parametrize("size", [0, 5000, 50_000, 100_000, 300_000])
def test_what_was_put_is_kept_and_the_store_goes_on_when_there_is_space(path, record, size):
    text = record_to_json(record())
    said, complaint = limited(WRITE, path, text, size)
    assert complaint == FULL
    assert bool(said) == (size >= 50_000)
    with EvidenceStore.open(path) as store:
        assert sorted(trial.record.variant for trial in store.iterate()) == said
        assert store.has_pieces(trial.key for trial in store.iterate()) == {trial.key for trial in store.iterate()}
    assert verify(path, label="it").damages == ()
    more, complaint = limited(WRITE, path, text, size + 200_000)
    assert complaint == FULL
    assert more
    with EvidenceStore.open(path) as store:
        assert sorted(trial.record.variant for trial in store.iterate()) == said + more


def test_an_old_store_is_left_as_it_is(path, record, first_store):
    first_store(path, range(200))
    before = path.read_bytes()
    said, complaint = limited(WRITE, path, record_to_json(record()), len(before) - 4096)
    assert (said, complaint) == ([], FULL)
    assert path.read_bytes() == before
    with EvidenceStore.open(path) as store:
        assert len(store.all()) == 200


def test_a_table_that_cannot_be_written_whole_is_not_written(filled, tmp_path, record):
    body = """\
    with EvidenceStore.open(path, label="it") as store:
        resource.setrlimit(resource.RLIMIT_FSIZE, (500, hard))
        export_trials(store.iterate(), Path(sys.argv[4]))
except EvidenceError as error:
    print(error, file=sys.stderr)
"""
    for ending in ("csv", "parquet"):
        target = tmp_path / f"trials.{ending}"
        target.write_text("what was there before", encoding="utf-8")
        _, complaint = limited(body, filled, record_to_json(record()), 10**9, target)
        assert complaint == f"{target} cannot be written: File too large"
        assert target.read_text(encoding="utf-8") == "what was there before"
        assert sorted(left.name for left in tmp_path.iterdir()) == ["evidence.sqlite", f"trials.{ending}"]
        target.unlink()


def test_garbage_is_removed_or_not_but_never_half(path, record, provenance, key):
    body = """\
    keep = {trial_key({"trial": number}) for number in range(0, 60, 2)}
    collect_garbage(path, trials=keep, pieces=keep, label="it")
except EvidenceError as error:
    print(error, file=sys.stderr)
"""
    with EvidenceStore.open(path) as store:
        store.put_many(trials=[(key(number), record(variant=number), provenance) for number in range(60)])
    size = path.stat().st_size
    _, complaint = limited(body, path, record_to_json(record()), size // 2)
    assert complaint == FULL
    with EvidenceStore.open(path) as store:
        assert len(store.all()) == 60


READ = """\
    with EvidenceStore.open(path, create=False, label="it") as store:
        print(len(store))
except EvidenceError as error:
    print(error, file=sys.stderr)
"""


def test_what_is_stored_can_be_read_on_a_full_disk(path, record):
    """SQLite cannot make the index of its log there, which nobody needs who only reads."""
    text = record_to_json(record())
    said, _ = limited(WRITE, path, text, 100_000)
    with EvidenceStore.open(path):
        pass
    assert not path.with_name(f"{path.name}-wal").exists()
    command = [sys.executable, "-c", LIMITED + READ, str(path), text, "0"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == (f"{len(said)}\n", "")


def test_a_store_that_is_to_be_written_is_not_opened_on_a_full_disk(path, record):
    text = record_to_json(record())
    limited(WRITE, path, text, 100_000)
    _, complaint = limited(WRITE, path, text, 0)
    assert complaint == FULL
