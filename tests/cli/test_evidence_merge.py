"""``rgss evidence``: another store added to the project's, and studies that cannot be reached."""

from __future__ import annotations

import json
import shutil
import sqlite3

import pytest

from rgss.evidence import EvidenceStore
from rgss.studies.project import EVIDENCE


@pytest.fixture
def folder(with_evidence, tmp_path):
    """A copy without evidence."""
    return shutil.copytree(with_evidence, tmp_path / "copy", ignore=shutil.ignore_patterns(".rgss"))


def test_another_store_is_merged(rgss, with_evidence, folder):
    other = with_evidence / EVIDENCE
    told = rgss("evidence", "merge", other, "--project", folder)

    assert (told.status, told.errors) == (0, "")
    assert told.output == f"216 trials and 0 pieces added to {folder / EVIDENCE}; 0 of {other} were there already.\n"
    with EvidenceStore.open(folder / EVIDENCE) as store:
        assert len(store) == 216
    again = json.loads(rgss("evidence", "merge", other, "--project", folder, "--json").output)
    assert {name: again[name] for name in ("trials", "pieces", "present", "left_out")} == {
        "trials": 0,
        "pieces": 0,
        "present": 216,
        "left_out": 0,
    }


def test_damaged_rows_are_told(rgss, with_evidence, folder, tmp_path):
    other = shutil.copy(with_evidence / EVIDENCE, tmp_path / "damaged.sqlite")
    connection = sqlite3.connect(other, isolation_level=None)
    connection.execute("UPDATE trials SET record = x'00' WHERE variant = 3 AND seed = 1")
    connection.close()
    told = rgss("evidence", "merge", other, "--project", folder)

    assert told.status == 1
    assert told.output.endswith(f"1 damaged row of {other} left out.\n")


def test_hints_name_the_project_that_was_given(rgss, with_evidence, folder):
    shutil.copytree((with_evidence / EVIDENCE).parent, (folder / EVIDENCE).parent)
    connection = sqlite3.connect(folder / EVIDENCE, isolation_level=None)
    connection.execute("UPDATE trials SET record = x'00' WHERE variant = 3 AND seed = 1")
    connection.close()
    told = rgss("measure", "--project", folder)

    assert told.status == 2
    assert f"run 'rgss evidence verify --mend --project {folder}' to remove it" in told.errors


def test_what_is_no_other_store_is_refused(rgss, with_evidence, folder):
    own = with_evidence / EVIDENCE
    told = rgss("evidence", "merge", own, "--project", with_evidence)
    assert (told.status, told.errors) == (2, f"rgss: {own} is the store of this project (name another store)\n")

    missing = folder / "nothing.sqlite"
    told = rgss("evidence", "merge", missing, "--project", folder)
    assert (told.status, told.errors) == (
        2,
        f"rgss: there is no store {missing} (name the file of another store)\n",
    )
    told = rgss("evidence", "merge", with_evidence, "--project", folder)
    assert (told.status, told.errors) == (
        2,
        f"rgss: {with_evidence} is a folder, not a store (its store is {own})\n",
    )
    told = rgss("evidence", "merge", folder / "studies", "--project", folder)
    assert told.errors.endswith("is a folder, not a store (name the file of another store)\n")
    assert rgss("evidence", "merge", folder / "studies" / "pick_place.yaml", "--project", folder).status == 2
    # Nothing was made of it.
    assert not (folder / EVIDENCE).exists()


@pytest.mark.parametrize("words", [(), ("gc",)])
def test_a_study_that_is_a_link_to_itself_is_a_finding(rgss, with_evidence, tmp_path, words):
    folder = shutil.copytree(with_evidence, tmp_path / "circle")
    (folder / "studies" / "circle.yaml").symlink_to("circle.yaml")
    told = rgss("evidence", *words, "--project", folder)

    assert told.status == 2
    assert "studies/circle.yaml:1:1: error: cannot be read: Too many levels of symbolic links" in told.errors
