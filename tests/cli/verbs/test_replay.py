"""``rgss replay``: exit status, what it prints for people and for programs, and what it refuses."""

from __future__ import annotations

import contextlib
import json
import shutil
import sqlite3
from dataclasses import replace

import pytest

from rgss.cli.main import main
from rgss.errors import SimulationError
from rgss.evidence import EvidenceStore, Provenance
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.trial_keys import key_of
from rgss.trials.code.numeric_probe import fixed_numerics
from rgss.trials.code.piece_versions import versions
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.pieces.run import run_trial
from tests.fixtures.shipped_project import copy_project

TRIAL = "65/2"


@pytest.fixture(scope="module")
def evidence(tmp_path_factory):
    """A copy of the project, its study kinematic, with the evidence of one trial."""
    folder = copy_project(tmp_path_factory.mktemp("evidence") / "project")
    study = folder / "studies" / "pick_place.yaml"
    study.write_text(
        study.read_text(encoding="utf-8").replace("fidelity: contact", "fidelity: kinematic"), encoding="utf-8"
    )
    project = load_project(folder)
    (spec,) = trial_specs(project, variants=[project.designs.variant(65)], seeds=[2])
    provenance = Provenance(inputs=digests_of(spec, versions()).as_mapping(), versions=versions())
    with EvidenceStore.open(project.evidence) as store:
        store.put(key_of(spec), run_trial(spec), provenance)
    return folder, key_of(spec)


@pytest.fixture
def folder(evidence, tmp_path):
    """A copy that a test may spoil."""
    copy = tmp_path / "project"
    shutil.copytree(evidence[0], copy)
    return copy


@pytest.fixture
def key(evidence):
    return evidence[1]


def edit(folder, file, old, new):
    text = (folder / file).read_text(encoding="utf-8")
    assert old in text
    (folder / file).write_text(text.replace(old, new, 1), encoding="utf-8")


def replay(folder, *arguments):
    return main(["replay", *arguments, "--project", str(folder)])


def refused(capsys, folder, *arguments):
    """The one line with which it is refused."""
    assert replay(folder, *arguments) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    (line,) = captured.err.splitlines()
    return line.removeprefix("rgss: ")


@pytest.mark.engine
def test_the_same_bits_are_clean(capsys, folder, key):
    assert replay(folder, TRIAL) == 0
    captured = capsys.readouterr()
    lines = captured.out.splitlines()
    assert lines[0] == f"Trial {key[:12]}: variant 65, seed 2, kinematic"
    assert lines[1].startswith("The same, bit for bit: ")
    assert len(lines) == 2
    assert captured.err == ""


@pytest.mark.engine
def test_a_key_names_the_trial_and_json_is_one_document(capsys, folder, key):
    assert replay(folder, key[:10], "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert list(found) == [
        "key",
        "variant",
        "seed",
        "same",
        "agreement",
        "numerics_then",
        "numerics_now",
        "digest_then",
        "digest_now",
        "versions",
        "changed_inputs",
        "inputs",
        "differences",
    ]
    assert (found["key"], found["variant"], found["seed"], found["same"]) == (key, 65, 2, True)
    assert found["digest_then"] == found["digest_now"]
    assert (found["versions"], found["changed_inputs"], found["differences"]) == ([], [], [])


@pytest.mark.engine
def test_another_result_is_a_finding_that_says_what_changed(capsys, folder):
    edit(folder, "designs/grasping_system.yaml", "d4: 0.04 m/s", "d4: 0.05 m/s")
    assert replay(folder, TRIAL) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[1] == "  changed inputs: execution, trial"
    assert lines[2] == "7 values differ:"
    assert lines[3].split() == ["value", "then", "now"]
    assert lines[5].split()[0] == "phases[grasp].duration_s"
    assert len(lines) == 12


@pytest.mark.engine
def test_another_result_as_json(capsys, folder):
    edit(folder, "designs/grasping_system.yaml", "d4: 0.04 m/s", "d4: 0.05 m/s")
    assert replay(folder, TRIAL, "--json") == 1
    found = json.loads(capsys.readouterr().out)
    assert found["same"] is False
    assert found["digest_then"] != found["digest_now"]
    assert found["changed_inputs"] == ["execution", "trial"]
    assert len(found["differences"]) == 7
    assert all(set(change) == {"name", "then", "now", "deviation"} for change in found["differences"])
    assert found["agreement"] == "different"


@pytest.mark.engine
def test_of_many_differences_the_first_are_shown(capsys, folder):
    edit(folder, "designs/grasping_system.yaml", "d7: 1 m/s", "d7: 0.8 m/s")
    edit(folder, "designs/grasping_system.yaml", "d4: 0.04 m/s", "d4: 0.05 m/s")
    assert replay(folder, TRIAL) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[1] == "  changed inputs: timing, execution, trial"
    count = int(lines[2].split()[0])
    assert count > 12
    assert lines[-1] == f"… and {count - 12} more (--json shows them)"
    assert len(lines) == 3 + 2 + 12 + 1


@pytest.mark.engine
def test_other_versions_are_named_even_if_the_bits_are_the_same(capsys, folder, key, monkeypatch):
    now = {**versions(), "ompl": "9.9.9"}
    monkeypatch.setattr("rgss.sweep.replaying.versions", lambda: now)
    assert replay(folder, key) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1] == f"  version of ompl: {versions()['ompl']} then, 9.9.9 now"
    assert lines[2].startswith("The same, bit for bit: ")
    assert replay(folder, key, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["versions"] == [{"name": "ompl", "then": versions()["ompl"], "now": "9.9.9"}]


@pytest.mark.engine
def test_the_fidelity_tells_trials_of_a_variant_and_seed_apart(capsys, folder, key):
    edit(folder, "studies/pick_place.yaml", "fidelity: kinematic", "fidelity: contact")
    sweep = f"rgss sweep --project {folder}"
    assert refused(capsys, folder, TRIAL) == f"there is no trial '65/2' in the evidence (run '{sweep}' first)"
    assert replay(folder, TRIAL, "--fidelity", "kinematic") == 0
    assert replay(folder, key) == 0


def test_what_names_no_trial_is_bad_input(capsys, folder):
    sweep = f"rgss sweep --project {folder}"
    assert refused(capsys, folder, "66/2") == f"there is no trial '66/2' in the evidence (run '{sweep}' first)"
    assert refused(capsys, folder, "abc") == "'abc' names no trial (give 6 digits of its key or more, or 28/1)"
    assert refused(capsys, folder, "a/b") == "'a/b' names no trial (write a variant and a seed, such as 28/1)"


def test_a_trial_of_another_study_is_not_compared_with_this_one(capsys, folder, key):
    """It would differ by the inputs of the two studies, which is no finding."""
    path = folder / ".rgss" / "evidence.sqlite"
    with EvidenceStore.open(path) as store:
        (stored,) = store.all()
        provenance = replace(stored.provenance, study="studies/pick_place.yaml")
    path.unlink()
    with EvidenceStore.open(path) as store:
        store.put(key, stored.record, provenance)
    study = (folder / "studies" / "pick_place.yaml").read_text(encoding="utf-8")
    other = study.replace("study: pick_place", "study: other").replace("clearance: 8 mm", "clearance: 9 mm")
    (folder / "studies" / "other.yaml").write_text(other, encoding="utf-8")
    assert refused(capsys, folder, TRIAL, "--study", "other") == (
        "there is no trial '65/2' of studies/other.yaml in the evidence, only of studies/pick_place.yaml "
        f"(run 'rgss sweep other --project {folder}' first)"
    )


@pytest.mark.engine
def test_a_damaged_trial_does_not_keep_another_one_from_being_replayed_by_its_key(folder, key):
    path = folder / ".rgss" / "evidence.sqlite"
    with EvidenceStore.open(path) as store:
        (stored,) = store.all()
        store.put("0" * 64, replace(stored.record, seed=3), stored.provenance)
    with contextlib.closing(sqlite3.connect(path, isolation_level=None)) as connection:
        connection.execute("UPDATE trials SET record = x'00' WHERE seed = 3")
    assert replay(folder, key[:12]) == 0


def test_without_evidence_it_says_so(capsys, folder, monkeypatch):
    shutil.rmtree(folder / ".rgss")
    monkeypatch.chdir(folder)
    refusal = f"there is no evidence in .rgss/evidence.sqlite (run 'rgss sweep --project {folder}' first)"
    assert refused(capsys, folder, TRIAL) == refusal
    assert not (folder / ".rgss").exists()


def test_evidence_that_is_damaged_is_bad_input(capsys, folder):
    (folder / ".rgss" / "evidence.sqlite").write_bytes(b"nothing of the kind" * 100)
    assert "cannot be used" in refused(capsys, folder, TRIAL)


def test_a_variant_that_is_gone_is_bad_input(capsys, folder, key):
    # Without the second planning time there are 48 variants.
    edit(folder, "designs/grasping_system.yaml", "      - id: medium\n        sets: {d9: 6 s}\n", "")
    assert refused(capsys, folder, key) == "unknown variant 65 (ids of variants: from 1 to 48)"


def test_a_run_that_fails_is_told_as_such(capsys, folder, monkeypatch):
    def fail(spec):
        raise SimulationError("the engine gave up", hint="try again")

    monkeypatch.setattr("rgss.sweep.replaying.run_trial", fail)
    assert replay(folder, TRIAL) == 3
    assert capsys.readouterr().err == "rgss: the engine gave up (try again)\n"


def test_the_trial_must_be_named(capsys, folder):
    with pytest.raises(SystemExit) as caught:
        replay(folder)
    assert caught.value.code == 2
    assert "the following arguments are required: TRIAL" in capsys.readouterr().err


@pytest.fixture
def computed_elsewhere(folder):
    """Stores the trial anew as if it had been computed with other numerics, its path lengths moved by some amount."""

    def store(by_m, *, numerics=None, **changes):
        project = load_project(folder)
        (spec,) = trial_specs(project, variants=[project.designs.variant(65)], seeds=[2])
        record = run_trial(spec)
        lengths = tuple(None if one is None else one + by_m for one in record.metrics["path_length_m"])
        record = replace(record, metrics={**record.metrics, "path_length_m": lengths}, **changes)
        elsewhere = {**fixed_numerics(), "libm": "another library 0123456789ab"} if numerics is None else numerics
        provenance = Provenance(
            inputs=digests_of(spec, versions()).as_mapping(), versions=versions(), numerics=elsewhere
        )
        project.evidence.unlink()
        with EvidenceStore.open(project.evidence) as store:
            store.put(key_of(spec), record, provenance)

    return store


@pytest.mark.engine
def test_other_numerics_explain_a_small_deviation_which_has_a_status_of_its_own(capsys, folder, computed_elsewhere):
    computed_elsewhere(1e-6)
    assert replay(folder, TRIAL) == 4
    lines = capsys.readouterr().out.splitlines()
    here = fixed_numerics()["libm"]
    assert lines[1] == f"Computed with other numerics: libm: another library 0123456789ab then, {here} now"
    assert lines[2].startswith("The same within the tolerance of other numerics, not bit for bit: ")
    assert lines[3].split() == ["value", "then", "now", "deviation"]
    assert lines[5].split()[0] == "metrics.path_length_m[0]"
    assert float(lines[5].split()[3]) == pytest.approx(1e-6)
    assert replay(folder, TRIAL, "--json") == 4
    found = json.loads(capsys.readouterr().out)
    assert (found["same"], found["agreement"]) == (False, "within tolerance")
    assert found["numerics_then"]["libm"] == "another library 0123456789ab"
    assert found["numerics_now"] == fixed_numerics()


@pytest.mark.engine
@pytest.mark.parametrize("case", ["too far", "same numerics", "numerics not recorded", "another outcome"])
def test_nothing_else_is_explained_by_numerics(capsys, folder, computed_elsewhere, case):
    numerics = {"same numerics": fixed_numerics(), "numerics not recorded": {}}.get(case)
    changes = {"failure_detail": "it was dropped"} if case == "another outcome" else {}
    computed_elsewhere(1e-2 if case == "too far" else 1e-6, numerics=numerics, **changes)
    assert replay(folder, TRIAL) == 1
    assert ("beyond the tolerance" in capsys.readouterr().out) == (case in ("too far", "another outcome"))


@pytest.mark.engine
def test_a_changed_input_is_no_matter_of_numerics(folder, computed_elsewhere):
    computed_elsewhere(1e-6)
    edit(folder, "designs/grasping_system.yaml", "d9: 6 s", "d9: 5.9 s")
    assert replay(folder, TRIAL) == 1


@pytest.mark.engine
def test_verify_tells_with_which_numerics_trials_were_computed(capsys, folder, computed_elsewhere):
    def lines(**numerics):
        computed_elsewhere(1e-6, **numerics)
        assert main(["evidence", "verify", "--project", str(folder)]) == 0
        return [line for line in capsys.readouterr().out.splitlines() if "replay" in line]

    (line,) = lines(numerics=fixed_numerics())
    assert line.startswith("1 trial: computed as on this machine, so 'rgss replay' must agree bit for bit (blas: ")
    (line,) = lines()
    assert line.startswith("1 trial: computed with other numerics, so 'rgss replay' compares within a tolerance here (")
    # That of an earlier rgss, which its code has made stale, says nothing of it.
    assert lines(numerics={}) == []
