"""``rgss evidence``: what the store holds, checked, exported and cleared up."""

from __future__ import annotations

import csv
import shutil
import sqlite3
import sys
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from rgss.evidence import EvidenceStore, Provenance, RunFailure, RunFailureKind
from rgss.studies.expansion import trial_specs
from rgss.studies.project import EVIDENCE, load_project
from rgss.sweep.trial_keys import key_of

STUDY = "studies/pick_place.yaml"
FAILED = RunFailure(key="e" * 64, what="execution", kind=RunFailureKind.TIMED_OUT, detail="60 s", attempts=2)


@pytest.fixture
def spoilt(with_evidence, tmp_path):
    """A copy with evidence that the test may spoil."""
    return Path(shutil.copytree(with_evidence, tmp_path / "spoilt"))


def change(folder, statement, *values):
    connection = sqlite3.connect(folder / EVIDENCE, isolation_level=None)
    connection.execute(statement, values)
    connection.close()


def edit(folder, file, old, new):
    text = (folder / file).read_text(encoding="utf-8")
    assert old in text
    (folder / file).write_text(text.replace(old, new, 1), encoding="utf-8")


def studies_of(folder):
    return sorted(path.relative_to(folder).as_posix() for path in (folder / "studies").glob("*.yaml"))


def count(folder):
    with EvidenceStore.open(folder / EVIDENCE) as store:
        return len(store)


def test_a_summary(rgss, with_evidence):
    told = rgss("evidence", "--project", with_evidence)

    assert (told.status, told.errors) == (0, "")
    first, trials, pieces, *rest = told.output.splitlines()
    assert first.startswith("Evidence: ")
    assert first.endswith((" kB", " MB"))
    assert trials == "Trials: 216; 216 current (216 contact), 0 stale"
    assert pieces == "Pieces: 0"
    rows = [line.split() for line in rest if line.startswith("studies/")]
    assert sorted(row[0] for row in rows) == studies_of(with_evidence)
    assert [STUDY, "contact", "216", "216", "0", "0"] in rows
    # What was put there is of the default study, and nothing of another one.
    assert {row[3] for row in rows if row[0] != STUDY} <= {"0"}


def test_a_summary_of_stale_evidence_and_of_failures(rgss, spoilt):
    edit(spoilt, "scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg")
    project = load_project(spoilt)
    (spec, *_) = trial_specs(project)
    with EvidenceStore.open(spoilt / EVIDENCE) as store:
        store.put_failure(FAILED)
        store.put_failure(
            RunFailure(key=key_of(spec), what="trial", kind=RunFailureKind.CRASHED, detail="SIGSEGV", attempts=2)
        )
    told = rgss("evidence", "--project", spoilt)

    assert (told.status, told.errors) == (0, "")
    assert "Trials: 216; 0 current, 216 stale (216 contact)" in told.output
    assert [STUDY, "contact", "216", "0", "216", "1"] in [line.split() for line in told.output.splitlines()]
    assert "  execution eeeeeeeeeeee: timed_out, 60 s" in told.output.splitlines()
    assert "'rgss evidence gc' shows them" in told.output

    document = rgss("evidence", "--json", "--project", spoilt).document
    assert (document["trials"], document["current"], document["stale"]) == (216, {}, {"contact": 216})
    (told_of,) = [one for one in document["studies"] if one["study"] == STUDY]
    assert told_of == {
        "study": STUDY,
        "fidelity": "contact",
        "trials": 216,
        "with_evidence": 0,
        "missing": 216,
        "failures_of_the_run": 1,
    }
    assert sorted(one["study"] for one in document["studies"]) == studies_of(spoilt)
    assert {one["kind"] for one in document["failures_of_the_run"]} == {"timed_out", "crashed"}


def test_many_failures_are_shown_in_part(rgss, spoilt):
    with EvidenceStore.open(spoilt / EVIDENCE) as store:
        for number in range(15):
            store.put_failure(
                RunFailure(key=f"{number:064x}", what="plan", kind=RunFailureKind.RAISED, detail="\x1b[2J", attempts=1)
            )
    told = rgss("evidence", "--project", spoilt)

    assert told.output.count("raised, �[2J") == 12
    assert "… and 3 more" in told.output


@pytest.mark.parametrize("action", [[], ["verify"], ["export", "trials.csv"], ["gc"], ["gc", "--apply"]])
def test_no_evidence(rgss, untouched, action, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = rgss("evidence", *action, "--project", untouched)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith("rgss: there is no evidence in ")
    assert told.complaint.endswith("(run the sweep first)")
    assert list(tmp_path.iterdir()) == []
    assert not (untouched / ".rgss").exists()


def test_the_project_may_be_named_before_the_action(rgss, with_evidence):
    before = rgss("evidence", "--project", with_evidence, "--json", "verify")
    after = rgss("evidence", "verify", "--json", "--project", with_evidence)

    assert before.document == after.document


def test_a_sound_store(rgss, with_evidence):
    told = rgss("evidence", "verify", "--project", with_evidence)

    assert (told.status, told.errors) == (0, "")
    assert told.output == "Sound: 216 trials, 0 pieces, 0 inputs, 0 failures.\n"


def test_what_no_trial_refers_to_is_told_but_no_damage(rgss, spoilt):
    with EvidenceStore.open(spoilt / EVIDENCE) as store:
        store.put_many(inputs=[{"seed": 1}])
    told = rgss("evidence", "verify", "--project", spoilt)

    assert told.status == 0
    assert "No trial refers to 1 of the inputs, which is no damage" in told.output


def test_damaged_rows_are_told_line_by_line_and_mended(rgss, spoilt):
    change(spoilt, "UPDATE trials SET record = x'00' WHERE variant = 7 AND seed = 2")
    change(spoilt, "UPDATE trials SET key = 'k' || char(27) WHERE variant = 8 AND seed = 2")
    told = rgss("evidence", "verify", "--project", spoilt)

    assert (told.status, told.errors) == (1, "")
    one, other, ledger, summary, advice = told.output.splitlines()
    assert one.endswith(": its record cannot be unpacked")
    assert other.endswith(": its key is none")
    assert "\x1b" not in told.output
    assert ledger.endswith(": ledger trials: the 216 rows are not those that were stored")
    assert summary == "3 damages; sound: 214 trials, 0 pieces, 0 inputs, 0 failures."
    assert advice == (
        "To repair it: 'rgss evidence verify --mend' removes these rows, and 'rgss sweep' makes them again."
    )
    assert [each["what"] for each in rgss("evidence", "verify", "--json", "--project", spoilt).document["damages"]] == [
        "trial",
        "trial",
        "ledger",
    ]

    told = rgss("evidence", "verify", "--mend", "--project", spoilt)
    assert told.status == 1
    assert told.output.splitlines()[-1] == "2 damaged rows removed; 'rgss sweep' makes their contents again."
    assert rgss("evidence", "verify", "--project", spoilt).status == 0
    assert count(spoilt) == 214


def test_rows_that_were_deleted_are_told_by_every_command_until_they_are_mended(rgss, spoilt):
    change(spoilt, "DELETE FROM trials WHERE variant = 7 AND seed = 2")
    for words in (["measure"], ["trade"], ["sweep", "--only", "7"], ["evidence"], ["evidence", "export", "x.csv"]):
        told = rgss(*words, "--project", spoilt)
        assert (told.status, told.output) == (2, "")
        assert told.complaint.endswith(
            " was changed outside rgss: table trials: 216 rows were stored, 215 are present "
            f"(run 'rgss evidence verify --project {spoilt}' to see the damage, and with --mend to keep the valid rows)"
        )
    told = rgss("evidence", "verify", "--project", spoilt)
    assert told.status == 1
    assert told.output.splitlines()[1:] == [
        "1 damage; sound: 215 trials, 0 pieces, 0 inputs, 0 failures.",
        "To repair it: 'rgss evidence verify --mend' keeps the rows that exist.",
    ]
    told = rgss("evidence", "verify", "--mend", "--project", spoilt)
    assert told.output.splitlines()[-1] == (
        "The ledger is rewritten for the rows that exist; 'rgss sweep' makes the others again as needed."
    )
    assert rgss("evidence", "verify", "--project", spoilt).status == 0
    assert count(spoilt) == 215


def test_a_store_that_was_cut_to_nothing_is_not_taken_for_a_new_one(rgss, spoilt):
    (spoilt / EVIDENCE).write_bytes(b"")
    for words in (["sweep", "--only", "7"], ["measure"], ["evidence", "gc", "--apply"]):
        told = rgss(*words, "--project", spoilt)
        assert (told.status, told.output) == (2, "")
        assert "is empty: an evidence store is never empty, so it was truncated" in told.complaint
    told = rgss("evidence", "verify", "--project", spoilt)
    assert told.status == 1
    assert "pages: the file is empty" in told.output
    assert (spoilt / EVIDENCE).stat().st_size == 0


def test_a_damaged_file_is_told_and_its_sound_rows_saved(rgss, spoilt):
    path = spoilt / EVIDENCE
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2 // 4096 * 4096])
    told = rgss("evidence", "verify", "--project", spoilt)

    assert (told.status, told.errors) == (1, "")
    assert ": pages: " in told.output
    assert told.output.splitlines()[-1] == (
        "To repair it: 'rgss evidence verify --mend' saves the sound rows in a new file."
    )
    told = rgss("evidence", "verify", "--mend", "--json", "--project", spoilt)
    assert told.status == 1
    assert "sound rows are saved in evidence.sqlite.mended beside it" in told.document["mended"]
    path.with_name("evidence.sqlite.mended").replace(path)
    assert rgss("evidence", "verify", "--project", spoilt).status == 0
    assert 0 < count(spoilt) < 216


@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_an_export_has_a_row_for_each_trial(rgss, with_evidence, tmp_path, ending):
    target = tmp_path / f"trials.{ending}"
    told = rgss("evidence", "export", target, "--project", with_evidence)

    assert (told.status, told.errors) == (0, "")
    assert told.output == f"216 trials written to {target}\n"
    table = pd.read_csv(target) if ending == "csv" else pd.read_parquet(target)
    assert len(table) == 216
    with EvidenceStore.open(with_evidence / EVIDENCE) as store:
        for row, trial in zip(table.to_dict("records"), store.iterate(), strict=True):
            assert (row["key"], row["variant"], row["seed"]) == (trial.key, trial.record.variant, trial.record.seed)
            assert row["motion_time_s"] == pytest.approx(trial.record.metrics["motion_time_s"], rel=1e-15)
    assert [path.name for path in tmp_path.iterdir()] == [target.name]
    assert rgss("evidence", "export", target, "--json", "--project", with_evidence).document["trials"] == 216


def test_an_export_of_a_study_has_its_trials_alone(rgss, spoilt, tmp_path):
    project = load_project(spoilt)
    with EvidenceStore.open(spoilt / EVIDENCE) as store:
        other = trial_specs(project.with_replicates(4))[3]
        record = replace(next(store.iterate()).record, variant=other.variant, seed=other.seed)
        store.put(key_of(other), record, Provenance(inputs={}, versions={}))
    change(spoilt, "DELETE FROM trials WHERE variant = 7 AND seed = 2")
    assert rgss("evidence", "verify", "--mend", "--project", spoilt).status == 1
    target = tmp_path / "trials.csv"

    def exported(*words):
        told = rgss("evidence", "export", target, *words, "--project", spoilt)
        assert (told.status, told.errors) == (0, "")
        with target.open(encoding="utf-8-sig") as file:
            return told.output.splitlines(), sum(1 for _ in file) - 1

    assert other.seed == 4
    assert exported() == ([f"216 trials written to {target}"], 216)
    assert exported("studies/pick_place.yaml") == (
        [
            f"215 trials written to {target}",
            f"1 more has no evidence yet; 'rgss sweep studies/pick_place.yaml --project {spoilt}' makes it.",
        ],
        215,
    )
    assert exported("--replicates", "4")[1] == 216
    assert exported("--fidelity", "kinematic") == (
        [
            f"0 trials written to {target}",
            f"216 more have no evidence yet; 'rgss sweep --project {spoilt} --fidelity kinematic' makes it.",
        ],
        0,
    )
    told = rgss("evidence", "export", "--json", target, "studies/pick_place.yaml", "--project", spoilt).document
    assert (told["trials"], told["missing"]) == (215, 1)
    complaint = rgss("evidence", "export", target, "studies/none.yaml", "--project", spoilt).complaint
    assert complaint.startswith("studies/none.yaml:1:1: error: no such file")


def test_an_export_to_another_ending(rgss, with_evidence, tmp_path):
    told = rgss("evidence", "export", tmp_path / "trials.xlsx", "--project", with_evidence)

    assert (told.status, told.output) == (2, "")
    assert told.complaint == (
        f"rgss: {tmp_path / 'trials.xlsx'} must end in .parquet or .csv (the suffix selects the format)"
    )


def test_an_export_to_parquet_without_its_library(rgss, with_evidence, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    told = rgss("evidence", "export", tmp_path / "trials.parquet", "--project", with_evidence)

    assert told.status == 2
    assert told.complaint == (
        "rgss: a Parquet file needs pyarrow, which is not installed (pip install 'rgss[parquet]', or name a .csv file)"
    )


def test_an_export_into_a_folder_that_is_not_there(rgss, with_evidence, tmp_path):
    told = rgss("evidence", "export", tmp_path / "none" / "trials.csv", "--project", with_evidence)

    assert told.status == 2
    assert told.complaint.endswith("trials.csv cannot be written: No such file or directory")


def test_no_garbage(rgss, with_evidence):
    told = rgss("evidence", "gc", "--project", with_evidence)

    assert (told.status, told.errors) == (0, "")
    assert told.output == "The studies name everything that is stored; there is nothing to remove.\n"


def test_garbage_is_shown_and_removed_only_on_demand(rgss, spoilt):
    edit(spoilt, "scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg")
    specs = trial_specs(load_project(spoilt))
    with EvidenceStore.open(spoilt / EVIDENCE) as store:
        old = next(store.iterate())
        store.put(key_of(specs[0]), old.record, Provenance(inputs={}, versions={}))
        store.put_failure(FAILED)
        store.put_many(inputs=[{"seed": 1}])
    for words in (["gc"], ["gc", "--dry-run"]):
        told = rgss("evidence", *words, "--project", spoilt)
        assert (told.status, told.errors) == (0, "")
        first, trials, inputs, failures, last = told.output.splitlines()
        assert first == "With the present inputs and code, no study of the project names:"
        assert trials == "  216 trials (216 contact) of 72 variants"
        assert (inputs, failures) == ("  1 set of inputs", "  1 failure of the run")
        assert last.endswith("'rgss evidence gc --apply' removes it.")
    assert count(spoilt) == 217

    document = rgss("evidence", "gc", "--apply", "--json", "--project", spoilt).document
    assert document["removed"]
    assert len(document["trials"]) == 216
    assert (document["inputs"], document["failures"]) == (1, 1)
    assert document["freed_bytes"] > 0
    assert count(spoilt) == 1
    assert "nothing to remove" in rgss("evidence", "gc", "--apply", "--project", spoilt).output


def test_garbage_is_removed_and_the_file_shrinks(rgss, spoilt):
    edit(spoilt, "scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg")
    size = (spoilt / EVIDENCE).stat().st_size
    told = rgss("evidence", "gc", "--apply", "--project", spoilt)

    assert (told.status, told.errors) == (0, "")
    assert told.output.splitlines()[-1].startswith("Removed; the file is ")
    assert (spoilt / EVIDENCE).stat().st_size < size / 2


def test_more_replicates_are_garbage_only_in_the_strict_sense(rgss, spoilt):
    edit(spoilt, STUDY, "replicates: 3", "replicates: 2")

    assert "nothing to remove" in rgss("evidence", "gc", "--project", spoilt).output
    strict = rgss("evidence", "gc", "--strict", "--json", "--project", spoilt).document
    assert {trial["seed"] for trial in strict["trials"]} == {3}
    assert len(strict["trials"]) == 72


def test_a_study_that_cannot_be_read_keeps_everything(rgss, spoilt):
    (spoilt / "studies/other.yaml").write_text("study: other\n", encoding="utf-8")
    told = rgss("evidence", "gc", "--apply", "--project", spoilt)

    assert (told.status, told.output) == (2, "")
    assert "studies/other.yaml:" in told.errors
    assert count(spoilt) == 216


def test_a_store_in_use_is_not_cleared_up(rgss, spoilt, monkeypatch):
    monkeypatch.setattr("rgss.evidence.store.collection._PATIENCE_MS", 50)
    edit(spoilt, "scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg")
    with EvidenceStore.open(spoilt / EVIDENCE) as store:
        told = rgss("evidence", "gc", "--apply", "--project", spoilt)
        assert len(store) == 216

    assert (told.status, told.output) == (2, "")
    assert told.complaint.endswith(" open (wait until the sweep has finished)")


def test_a_csv_file_is_one_that_spreadsheets_read(rgss, with_evidence, tmp_path):
    target = tmp_path / "trials.csv"
    rgss("evidence", "export", target, "--project", with_evidence)

    with target.open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    assert len({len(row) for row in [head, *rows]}) == 1
    assert len(set(head)) == len(head)


def test_a_store_that_is_a_circle_of_links_is_named(rgss, spoilt):
    (spoilt / EVIDENCE).unlink()
    (spoilt / EVIDENCE).symlink_to(spoilt / EVIDENCE)
    for verb in (["evidence"], ["evidence", "verify"], ["measure"]):
        told = rgss(*verb, "--project", spoilt)
        assert told.status == 2
        assert told.output == ""
        assert len(told.errors.splitlines()) == 1, told.errors
