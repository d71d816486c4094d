"""Pages of a study whose variants have unequal numbers of replicates."""

from __future__ import annotations

import pytest

from rgss.evidence import EvidenceStore, Provenance
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.trial_keys import key_of
from tests.cli.conftest import made_record

STUDY = "studies/pick_place.yaml"
MORE = (10, 28)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A project with 3 replicates of every variant, and 6 of two of them."""
    from tests.fixtures.shipped_project import copy_project

    folder = copy_project(tmp_path_factory.mktemp("sequential"))
    text = (folder / STUDY).read_text(encoding="utf-8")
    fewest = load_project(folder).study.replicates
    (folder / STUDY).write_text(
        text.replace(f"replicates: {fewest}\n", "replicates: 3\nuntil_decided: {cap: 20}\n", 1), encoding="utf-8"
    )
    project = load_project(folder)
    with EvidenceStore.open(project.evidence) as store:
        more = trial_specs(project, variants=[project.designs.variant(each) for each in MORE], seeds=range(4, 7))
        rows = [
            (key_of(spec), made_record(spec), Provenance(inputs={}, versions={}))
            for spec in (*trial_specs(project), *more)
        ]
        store.put_many(trials=rows)
    return folder


def test_the_decision_reads_all_and_says_so(rgss, folder):
    told = rgss("trade", "--project", folder)
    lines = told.output.splitlines()
    assert told.errors == ""
    assert lines[0].endswith("72 variants, 222 trials")
    assert lines[1] == "Seeds read: 1 to 3 of variants 1–9, 11–27, 29–72; 1 to 6 of variants 10, 28."
    assert (
        lines[2] == "Effects of levels are of the 3 seeds that all variants have; '--replicates 3' reads these alone."
    )
    assert lines[3].startswith("Replicates were added where the decision was open; intervals and verdicts allow for it")
    assert "not computed" not in told.output


def test_a_fixed_number_is_read_alone(rgss, folder):
    told = rgss("trade", "--brief", "--replicates", "3", "--project", folder)
    assert told.output.splitlines()[0].endswith("72 variants, 216 trials")
    assert "Seeds read" not in told.output


def test_documents_have_the_seeds(rgss, folder):
    seeds = rgss("trade", "--brief", "--json", "--project", folder).document["conclusion"]["seeds"]
    assert [(one["first"], one["last"], len(one["variants"])) for one in seeds] == [(1, 3, 70), (1, 6, 2)]
    rows = rgss("measure", "--json", "--project", folder).document
    assert {row["n"] for row in rows if row["measure"] == "S"} == {3, 6}
    assert "Seeds read: 1 to 3 of" in rgss("measure", "--project", folder).output


def test_the_evidence_of_the_study_counts_them(rgss, folder):
    studies = rgss("evidence", "--json", "--project", folder).document["studies"]
    (row,) = (one for one in studies if one["study"] == STUDY)
    assert (row["trials"], row["with_evidence"], row["missing"]) == (222, 222, 0)
