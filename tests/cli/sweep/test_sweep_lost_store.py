"""``rgss sweep`` whose store is lost while it runs, or whose workers say what is hostile: one line, status 3."""

from __future__ import annotations

import json

import pytest

from rgss.evidence import EvidenceStore
from rgss.evidence.records.run_failures import LONGEST_DETAIL
from rgss.sweep.task_end import Ended, TaskError

WORDS = ("--fidelity", "kinematic", "--only", "57", "--jobs", "1", "--replicates", 2)


@pytest.mark.engine
@pytest.mark.parametrize(
    ("loss", "words"),
    [
        (lambda path: path.unlink(), "was removed"),
        (lambda path: path.write_bytes(b""), "was truncated from"),
    ],
    ids=["removed", "cut"],
)
def test_a_store_that_is_lost_is_one_line_and_status_3(rgss, folder, monkeypatch, loss, words):
    path = folder / ".rgss" / "evidence.sqlite"
    put_many = EvidenceStore.put_many
    calls = []

    def losing(store, **rows):
        put = put_many(store, **rows)
        calls.append(put)
        if len(calls) == 1:
            loss(path)
        return put

    monkeypatch.setattr(EvidenceStore, "put_many", losing)
    told = rgss("sweep", "--project", folder, *WORDS)
    assert (told.status, told.output) == (3, "")
    assert f"evidence.sqlite {words}" in told.complaint
    assert "are saved in evidence.sqlite.rescued beside it (remove the rest of evidence.sqlite" in told.complaint

    # As the line says: then the sweep goes on from what was saved.
    monkeypatch.setattr(EvidenceStore, "put_many", put_many)
    for left in path.parent.glob("evidence.sqlite*"):
        if not left.name.endswith(".rescued"):
            left.unlink()
    path.with_name("evidence.sqlite.rescued").rename(path)
    assert rgss("evidence", "verify", "--project", folder).status == 0
    again = rgss("sweep", "--project", folder, *WORDS)
    assert again.status == 0
    assert rgss("sweep", "--project", folder, *WORDS).output.startswith("2 trials: 0 run, 2 from evidence; ")


class Hostile:
    """Workers whose every task fails with a detail that would steer a terminal and is far too long."""

    size = 1
    DETAIL = "\x1b]0;owned\x07\x1b[2Jgone\nrgss: all is well \u202eabc\u2066 [bold]x[/bold] " + "y" * 100_000

    def __init__(self, function):
        self.keys = []
        self.free = 1

    def prepare_for(self, tasks):
        pass

    def begin(self, key, arguments):
        self.keys.append(key)

    def wait(self, timeout_s):
        from rgss.evidence import RunFailureKind

        failure = TaskError(kind=RunFailureKind.RAISED, detail=self.DETAIL, may_pass=False)
        ended = [Ended(key=key, result=None, failure=failure, took_s=0.0) for key in self.keys]
        self.keys = []
        return ended

    def close(self):
        pass


@pytest.mark.parametrize("as_json", [False, True])
def test_details_are_cut_and_steer_nothing_wherever_they_are_shown(rgss, folder, monkeypatch, as_json):
    monkeypatch.setattr(
        "rgss.sweep.persistent_pool.PersistentWorkerPool.workers", lambda self, function: Hostile(function)
    )
    more = ("--json",) if as_json else ()
    told = rgss("sweep", "--project", folder, *WORDS, *more)
    assert told.status == 3
    shown = [
        told,
        rgss("evidence", "--project", folder, *more),
        rgss("sweep", "--dry-run", "--project", folder, *WORDS, *more),
    ]
    for one in shown:
        assert "owned" in one.output + one.errors
        for line in (one.output + one.errors).splitlines():
            assert line.isprintable(), line
            assert len(line) < LONGEST_DETAIL + 200
    assert "[bold]x[/bold]" in shown[0].output + shown[0].errors
    assert not any(line.startswith("rgss: all is well") for line in told.errors.splitlines())
    if as_json:
        details = [json.loads(one.output) for one in shown]
        assert details[0]["run_failures"][0]["detail"].endswith("y…")
