"""A project that cannot be written, such as one that is shared or mounted: all that only reads works."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest


@pytest.fixture
def shared(with_evidence, tmp_path, monkeypatch):
    """A copy of the project with evidence that is said to be unwritable, as it would be for an ordinary user."""
    for user in ("store", "verification"):
        monkeypatch.setattr(f"rgss.evidence.store.{user}.is_writable", lambda path: False)
    return Path(shutil.copytree(with_evidence, tmp_path / "shared"))


def content(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize(
    "words",
    [
        ["check"],
        ["check", "--evidence"],
        ["variants"],
        ["evidence"],
        ["evidence", "verify"],
        ["evidence", "gc"],
        ["measure"],
        ["trade", "--brief"],
        ["trace", "SYS-005"],
        ["sweep", "--dry-run"],
    ],
    ids=" ".join,
)
def test_what_only_reads_works_and_leaves_all_as_it_is(rgss, shared, words):
    before = content(shared)
    told = rgss(*words, "--project", shared)

    assert told.errors == ""
    # The tests of the project stayed behind, which the check of its evidence finds.
    assert told.status == (1 if words == ["check", "--evidence"] else 0)
    assert told.output
    assert content(shared) == before
