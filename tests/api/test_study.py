"""What a study does beyond its numbers: it is frozen, says what is missing, and runs it."""

from __future__ import annotations

import copy
import dataclasses
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import rgss
from rgss.api import sweep as analysis_sweep
from rgss.api.columns import FRAMES
from rgss.assessment.recorded_verdicts import read_record, study_key
from rgss.errors import DefinitionError, DocumentError, EvidenceError, SimulationError
from rgss.evidence import EvidenceStore, RunFailure, RunFailureKind
from rgss.sweep.results import LostTrials, SweepResult
from rgss.trials.code.piece_versions import ENTRIES, source_of

from .conftest import ASKED

FEW = ["fingers=two", "velocity=fast"]


def test_it_is_found_from_within_the_project(empty, monkeypatch):
    monkeypatch.chdir(empty / "studies")

    assert repr(rgss.load_study()) == "Study('pick_place', 8 variants × 3 seeds, contact fidelity)"
    assert repr(rgss.load_study("..", "studies/pick_place.yaml", **ASKED)) == (
        "Study('pick_place', 8 variants × 2 seeds, kinematic fidelity)"
    )


def test_a_portfolio_as_a_frame(told, changeable):
    text = (changeable / "studies/pick_place.yaml").read_text(encoding="utf-8")
    text = text.replace("replicates: 3", "replicates: 2", 1).replace("fidelity: contact", "fidelity: kinematic", 1)
    (changeable / "studies/quick.yaml").write_text(text, encoding="utf-8")
    head, rest = text.split("trade_off:\n", 1)
    payload = "trade_off:\n  values:\n    - {measure: P_max, weight: 1.0, worst: 0.8 kg, best: 1.4 kg}\n"
    (changeable / "studies/payload.yaml").write_text(head + payload, encoding="utf-8")
    portfolio = (
        "trade_off:\n  portfolio:\n    at_most: 1\n    aim: mean\n    member: component.gripper\n    studies:\n"
        "      - {study: studies/quick.yaml, weight: 0.5}\n      - {study: studies/payload.yaml, weight: 0.5}\n"
    )
    (changeable / "studies/both.yaml").write_text(head + portfolio + rest, encoding="utf-8")
    found = rgss.load_study(changeable / "studies/both.yaml").portfolio()
    said = told("trade", "--brief", "--json", "studies/both.yaml", "--project", changeable)["portfolio"]

    assert list(found.index) == ["studies/quick.yaml", "studies/payload.yaml"]
    assert found.drop(columns=["status", "gap"]).reset_index().to_dict("records") == said["assignments"]
    assert set(found["status"]) == {said["status"]}
    assert set(found["member"]) == set(said["members"])
    assert {name: str(kind) for name, kind in found.dtypes.items()} == {
        column.name: column.kind.value for column in FRAMES["portfolio"].columns
    }


def test_a_study_that_asks_for_no_portfolio(study):
    with pytest.raises(DefinitionError, match="portfolio"):
        study.portfolio()


def test_a_study_file_names_its_project(empty, monkeypatch):
    other = empty / "studies" / "other.yaml"
    text = (empty / "studies" / "pick_place.yaml").read_text(encoding="utf-8")
    other.write_text(text.replace("replicates: 3", "replicates: 5", 1), encoding="utf-8")
    monkeypatch.chdir(empty / "scenes")

    for path in (other, str(other), "../studies/other.yaml"):
        study = rgss.load_study(path)
        assert study.project.study.label == "studies/other.yaml"
        assert study.project.folder.samefile(empty)
        assert study.project.study.replicates == 5


def test_a_study_file_that_cannot_be_meant(empty, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lonely.yaml").write_text("study: lonely\n", encoding="utf-8")
    with pytest.raises(DefinitionError) as caught:
        rgss.load_study(tmp_path / "lonely.yaml")
    assert caught.value.message == f"the study '{tmp_path}/lonely.yaml' lies in no project"
    assert caught.value.hint == "a project has requirements/, designs/, scenes/, studies/"
    with pytest.raises(DefinitionError) as caught:
        rgss.load_study(empty / "studies/pick_place.yaml", "studies/other.yaml")
    assert caught.value.message == (f"'{empty}/studies/pick_place.yaml' and 'studies/other.yaml' are both studies")
    with pytest.raises(DocumentError, match=r"studies/none\.yaml:1:1: error: no such file"):
        rgss.load_study(empty / "studies/none.yaml")
    with pytest.raises(DefinitionError, match="lies in no project"):
        rgss.load_study("a\0b.yaml")


def test_it_is_frozen(study):
    with pytest.raises(dataclasses.FrozenInstanceError):
        study.project = None
    with pytest.raises(dataclasses.FrozenInstanceError):
        study.trade().scenario = None


def test_a_changed_frame_changes_nothing_else(study):
    frame = study.measures
    frame["value"] = 0.0

    assert (study.measures["value"] != 0.0).any()


def test_without_evidence_there_are_designs_alone(empty):
    study = rgss.load_study(empty, **ASKED)
    hint = (
        f"call sweep(), or run 'rgss sweep studies/pick_place.yaml --project {empty} --fidelity kinematic "
        "--replicates 2'"
    )

    assert study.variants["feasible"].isna().all()
    assert study.variants["trials"].eq(0).all()
    assert study.variants["missing"].eq(2).all()
    for ask in (
        lambda: study.trials,
        lambda: study.phases,
        lambda: study.measures,
        lambda: study.verdicts,
        lambda: study.decision,
        lambda: study.ranking,
        lambda: study.pareto,
        study.effects,
        study.robustness,
        study.trade,
        lambda: study.trade({"weight.t_e": 0.3}),
    ):
        with pytest.raises(EvidenceError) as caught:
            ask()
        assert caught.value.message == f"there is no evidence in {empty / '.rgss/evidence.sqlite'}"
        assert caught.value.hint == hint
    assert not (empty / ".rgss").exists()


def test_evidence_of_another_model_is_none(changeable):
    scene = changeable / "scenes/restaurant.yaml"
    text = scene.read_text(encoding="utf-8")
    assert "gravity: 9.81 m/s^2" in text
    scene.write_text(text.replace("gravity: 9.81 m/s^2", "gravity: 9.8 m/s^2"), encoding="utf-8")
    study = rgss.load_study(changeable, **ASKED)

    with pytest.raises(EvidenceError) as caught:
        _ = study.trials
    assert caught.value.message == (
        "no trial of study 'pick_place' at kinematic fidelity has evidence for the project as it is now; "
        "16 have evidence of an earlier model, code or engine"
    )
    assert caught.value.hint.startswith("call sweep(), or run 'rgss sweep ")
    assert set(study.verdicts["verdict"]) == {"met", "stale"}


def test_a_part_of_the_evidence_gives_no_decision(empty):
    there = []
    study = rgss.load_study(empty, **ASKED).sweep(FEW, jobs=0, on_trial=lambda done, all_: there.append((done, all_)))
    variants = study.variants

    assert there == [(number, 4) for number in range(1, 5)]
    assert variants.index[variants["trials"] == 2].tolist() == [4, 8]
    assert variants["missing"].sum() == 12
    assert variants["feasible"].isna().all()
    assert study.trials.index.tolist() == [(4, 1), (4, 2), (8, 1), (8, 2)]
    assert study.measures.loc[(4, "t_e"), "n"] == 2
    assert study.measures.loc[(1, "t_e"), "n"] == 0
    assert set(read_record(empty).of_study(study_key("studies/pick_place.yaml", "kinematic"))["SYS-005"]) == {4, 8}
    with pytest.raises(EvidenceError, match=r"12 of 16 trials have no evidence.*call sweep\(\) first"):
        _ = study.decision


def test_a_second_sweep_runs_nothing(changeable):
    def trials():
        with EvidenceStore.open(changeable / ".rgss/evidence.sqlite", create=False) as store:
            return [(trial.key, trial.content_digest) for trial in store.iterate()]

    before = trials()
    study = rgss.load_study(changeable, **ASKED)
    again = study.sweep(jobs=0)

    assert trials() == before
    assert again is not study
    assert again.measures.equals(study.measures)


@pytest.mark.parametrize(
    ("only", "ids"),
    [(3, [3]), (np.int64(3), [3]), ("1,5", [1, 5]), ([1], [1]), (["1-6", "fingers=two"], [3, 4])],
)
def test_which_variants_are_swept(empty, monkeypatch, only, ids):
    asked = []

    def sweep(specs, store, **options):
        asked.extend(specs)
        return SweepResult(made={}, reused={}, lost=())

    monkeypatch.setattr(analysis_sweep, "sweep", sweep)
    rgss.load_study(empty, **ASKED).sweep(only, jobs=0)

    assert sorted({spec.variant for spec in asked}) == ids
    assert len(asked) == 2 * len(ids)


def test_a_study_with_screening_tries_the_survivors_alone(empty):
    file = empty / "studies/pick_place.yaml"
    text = file.read_text(encoding="utf-8")
    wanted = "fidelity: [kinematic, dynamic]\npromotion: {keep: 2}"
    file.write_text(text.replace("\nfidelity: contact\n", f"\n{wanted}\n", 1), encoding="utf-8")
    study = rgss.load_study(empty, replicates=1).sweep(jobs=0)
    variants, fates = study.variants, study.variants["screening"]
    promoted = variants.index[fates == "promoted"]

    assert set(fates) == {"promoted", "outranked"}
    assert variants["missing"].eq(0).all()
    assert set(study.trials.index.get_level_values("variant")) == set(promoted)
    assert set(study.trials["fidelity"]) == {"dynamic"}
    assert variants["feasible"].notna().sum() == len(promoted) < 8


def test_lost_trials_are_an_error(empty, monkeypatch):
    failure = RunFailure(
        key="0" * 64, what="plan", kind=RunFailureKind.CRASHED, detail="killed by signal 9", attempts=2
    )
    lost = LostTrials(failure=failure, trials=((1, 1), (1, 2)))
    monkeypatch.setattr(
        analysis_sweep, "sweep", lambda *specs, **options: SweepResult(made={}, reused={}, lost=(lost,))
    )

    with pytest.raises(SimulationError) as caught:
        rgss.load_study(empty, **ASKED).sweep(jobs=0)
    assert str(caught.value) == (
        f"2 trials could not be run; first failure: plan: {failure.kind.value}: killed by signal 9 "
        "(the others are stored; sweep again to retry these)"
    )


@pytest.mark.parametrize(
    ("guarded", "said"), [(False, "needs 'if __name__ == \"__main__\":'; or pass jobs=0"), (True, "")]
)
def test_a_script_that_sweeps_with_processes(empty, guarded, said):
    sweep = "rgss.load_study(fidelity='kinematic', replicates=1).sweep(4, jobs=1)"
    guard = "if __name__ == '__main__': " if guarded else ""
    (empty / "script.py").write_text(f"import rgss\n{guard}{sweep}\n", encoding="utf-8")
    run = subprocess.run([sys.executable, "script.py"], cwd=empty, capture_output=True, text=True, check=False)

    assert (run.returncode == 0) is guarded
    assert said in run.stderr.splitlines()[-1] if said else run.stderr == ""
    assert (len(rgss.load_study(empty, fidelity="kinematic", replicates=1).trials) if guarded else 1) == 1


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda study: study.columns("trial"), "unknown frame 'trial' (frames: variants, trials, phases,"),
        (
            lambda study: study.sweep(jobs=-1),
            "jobs must be at least 0, got -1 (0 runs all trials in one child process)",
        ),
        (lambda study: study.sweep("d8=PRM", jobs=0), "only: "),
        (lambda study: study.trade({"weight.x": 1}), "what_if: unknown input 'weight.x'"),
        (lambda study: study.trade("weight.t_e"), "what_if: supposition must be NAME=VALUE, got 'weight.t_e'"),
        (
            lambda study: study.trade({"weight.t_p": None}),
            "what_if: weight.t_p must be a finite number, got None (such",
        ),
        (lambda study: study.trade({"weight.t_p": [0.4]}), "what_if: weight.t_p must be a finite number, got [0.4]"),
        (
            lambda study: study.trade([("weight.t_p", 0.4)]),
            "an entry of what_if must be a text, got ('weight.t_p', 0.4)",
        ),
        (lambda study: study.trade(None), "what_if must be a list of texts, got None (such as {'weight.t_p': 0.4"),
        (lambda study: study.sweep(None), "only must be a term or a list of terms, got None (give ids such as '1,5'"),
        (lambda study: study.sweep(on_trial=5), "on_trial must be a function of two numbers, got 5 (or omit it)"),
        (lambda study: study.columns([]), "frame must be a text, got [] (frames: variants, trials"),
        (lambda study: study.columns("trails"), "unknown frame 'trails' (frames: variants, trials"),
        (lambda study: study.trial(99), "unknown variant 99"),
        (lambda study: study.trial(1, -1), "seed must be from 0 to 2147483647, got -1 (omit it for the study's own)"),
        (lambda study: study.trial(1.5), "variant must be a whole number, got 1.5 (give an id and a seed)"),
        (lambda study: study.trial(1, "2"), "seed must be a whole number, got '2'"),
        (lambda study: study.trial(True), "variant must be a whole number, got True"),
        (
            lambda study: study.trial(1, rate_hz="x"),
            "rate_hz must be a finite number, got 'x' (omit it for the study's own)",
        ),
        (lambda study: study.payload(1, friction=True), "friction must be a finite number, got True"),
        (lambda study: study.payload(1, finger_force_n="20 N"), "finger_force_n must be a finite number, got '20 N'"),
        (lambda study: study.sweep(jobs=1.5), "jobs must be a whole number, got 1.5"),
        (lambda study: study.trial(1, fidelity="real"), "unknown fidelity 'real'"),
        (
            lambda study: study.trial(1, rate_hz=1),
            "rate_hz must be from 60 to 10000, got 1 (omit it for the study's own)",
        ),
        (
            lambda study: study.trial(1, fidelity="contact", rate_hz=100),
            "contact physics needs at least 120 Hz and 2400 solver iterations a second, got rate_hz=100 and ",
        ),
        (
            lambda study: study.payload(1, friction=-0.1),
            "friction must be at least 0, got -0.1 (omit it for that of the gripper's file)",
        ),
        (lambda study: study.payload(1, finger_force_n=-1.0), "the force of a finger"),
    ],
)
def test_what_cannot_be(study, ask, message):
    with pytest.raises(DefinitionError) as caught:
        ask(study)
    assert message in str(caught.value)


@pytest.mark.parametrize("asked", [ASKED, {}])
def test_a_study_is_pickled_by_its_arguments(swept, tmp_path, monkeypatch, asked):
    """The folder is absolute; what the study's file states is not overridden."""
    monkeypatch.chdir(swept)
    study = rgss.load_study(**asked)
    written = pickle.dumps(study)
    monkeypatch.chdir(tmp_path)
    again = pickle.loads(written)  # noqa: S301 - written above
    assert len(written) < 1000
    assert repr(again) == repr(study)
    assert again.project.study == study.project.study
    if asked:
        assert again.ranking.equals(study.ranking)
    assert copy.copy(study).project is study.project


def test_what_cannot_be_loaded(empty, tmp_path):
    with pytest.raises(DefinitionError, match="is not a project"):
        rgss.load_study(tmp_path)
    with pytest.raises(DefinitionError, match="replicates must be from 1 to 10000, got"):
        rgss.load_study(empty, replicates=0)
    for number in (1.5, True, "2", float("nan")):
        with pytest.raises(DefinitionError, match=f"replicates must be a whole number, got {number!r}"):
            rgss.load_study(empty, replicates=number)
    assert rgss.load_study(empty, Path("studies/pick_place.yaml")).project.study.label == "studies/pick_place.yaml"
    for number in (5, b"x", [], "", " "):
        with pytest.raises(DefinitionError, match="folder must be a path, got"):
            rgss.load_study(number)
        with pytest.raises(DefinitionError, match="study must be a path, got"):
            rgss.load_study(empty, number)
    with pytest.raises(DefinitionError, match="unknown fidelity 'real'"):
        rgss.load_study(empty, fidelity="real")
    with pytest.raises(DocumentError):
        rgss.load_study(empty, "studies/none.yaml")
    assert issubclass(DocumentError, rgss.RgssError)


def test_what_is_public():
    assert rgss.__all__ == ["RgssError", "load_study"]


def test_the_interface_is_no_part_of_the_code_that_makes_trials():
    for piece in ENTRIES:
        modules = source_of(piece).modules
        assert "rgss" not in modules
        assert not any(name.startswith(("rgss.studies", "rgss.reports")) for name in modules)


def test_loading_draws_nothing_and_starts_no_engine(swept):
    script = (
        f"import sys, rgss; rgss.load_study({str(swept)!r}, fidelity='kinematic', replicates=2).measures; "
        "print(*sorted({'matplotlib', 'PIL', 'pybullet', 'ompl', 'cvxpy'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)

    assert (run.returncode, run.stdout.strip(), run.stderr) == (0, "", "")


def test_suppositions_on_how_trials_are_made_need_their_trials(changeable):
    """They are counted; a run makes them once, and they are evidence as any other."""
    study = rgss.load_study(changeable, **ASKED)
    with pytest.raises(EvidenceError, match="the suppositions need 16 trials of 16 that were not run") as caught:
        study.trade({"planning.resolution": "0.06 rad"})
    assert caught.value.hint == "call trade(…, run=True) to run them"
    made = study.trade({"planning.resolution": "0.06 rad"}, run=True, jobs=0)
    again = study.trade("planning.resolution=0.06 rad")

    assert made.decision == again.decision
    assert "planning.resolution=0.06 rad" in made.changes.reset_index()["what"].tolist()
    with pytest.raises(DefinitionError, match="jobs must be at least 0, got -1"):
        study.trade({"planning.resolution": "0.07 rad"}, run=True, jobs=-1)


def test_the_assumptions_are_a_frame(study):
    frame = study.assumptions()
    charge = frame.loc["planning.charge_per_check"]

    assert (charge["trials"] == 16).all()
    assert charge["missing"].isna().sum() == 0
    assert frame.loc["prices"]["changes_choice"].tolist() in ([True], [False])
    assert "fidelity" not in frame.index.get_level_values(0)
