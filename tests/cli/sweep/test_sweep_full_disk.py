"""A disk that fills in the middle of a sweep: one line, its own exit status, and nothing lost that was put."""

from __future__ import annotations

import resource

import pytest

from rgss.evidence import EvidenceStore

WORDS = ("--fidelity", "kinematic", "--only", "57", "--jobs", "1", "--replicates")


def filling(size_bytes):
    """Limits the size of files, which SQLite meets as a disk that takes no more."""

    def limit():
        hard = resource.getrlimit(resource.RLIMIT_FSIZE)[1]
        resource.setrlimit(resource.RLIMIT_FSIZE, (size_bytes, hard))

    return limit


@pytest.mark.engine
def test_a_disk_that_fills_is_a_failure_of_the_run_and_loses_nothing(rgss, rgss_process, folder):
    path = folder / ".rgss" / "evidence.sqlite"
    assert rgss("sweep", "--project", folder, *WORDS, 1).status == 0
    log = 15_000

    full = rgss_process("sweep", "--project", folder, *WORDS, 5, preexec_fn=filling(path.stat().st_size + log))

    assert (full.returncode, full.stdout) == (3, "")
    (line,) = full.stderr.splitlines()
    assert line.startswith("rgss: the evidence store ")
    hint = "(free space on the disk or check its health; earlier entries are stored)"
    assert line.endswith(f"cannot be used: disk I/O error {hint}")
    with EvidenceStore.open(path) as store:
        kept = {trial.record.seed for trial in store.all()}
    assert 1 in kept
    assert len(kept) < 5
    # With space, the same command goes on from there, and what was kept is sound.
    again = rgss("sweep", "--project", folder, *WORDS, 5)
    assert again.status == 0
    assert f"5 trials: {5 - len(kept)} run, {len(kept)} from evidence" in again.output
    assert rgss("evidence", "verify", "--project", folder).status == 0


def test_no_space_from_the_start_is_the_same(rgss_process, folder):
    full = rgss_process("sweep", "--project", folder, *WORDS, 1, preexec_fn=filling(0))

    assert (full.returncode, full.stdout, len(full.stderr.splitlines())) == (3, "", 1)


def test_a_store_that_cannot_be_a_store_is_bad_input_still(rgss, folder):
    (folder / ".rgss").mkdir()
    (folder / ".rgss" / "evidence.sqlite").write_text("no store at all, whatever its name says")

    told = rgss("sweep", "--project", folder, *WORDS, 1)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.endswith("(use another file; this one is unchanged)")
