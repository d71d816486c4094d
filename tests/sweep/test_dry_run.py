"""What a sweep would make, and why."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.assessment.staleness import outdated_trials
from rgss.errors import DefinitionError
from rgss.evidence import EvidenceStore, PieceKind, Provenance, RunFailure, RunFailureKind
from rgss.studies import input_names as naming
from rgss.studies.expansion import trial_specs
from rgss.studies.input_names import named_inputs
from rgss.studies.project import load_project
from rgss.sweep.evidence_writer import Origin
from rgss.sweep.preview import Cause, PieceCount, Reason, dry_run
from rgss.sweep.running import sweep
from rgss.sweep.trial_keys import trials_of
from rgss.trials.code.piece_versions import versions
from tests.fixtures.shipped_project import REPOSITORY

DOUBLES = Path(__file__).parent / "doubles"
SPACE, SCENE, STUDY = "designs/grasping_system.yaml", "scenes/restaurant.yaml", "studies/pick_place.yaml"
CATALOGUE, GRIPPER, ROBOT = "designs/catalogue.yaml", "scenes/grippers/kg-2.yaml", "scenes/robots/ur10.yaml"


@pytest.fixture(scope="module")
def quick():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(DOUBLES)
        import worker_doubles

        yield worker_doubles.quick


@pytest.fixture
def store(tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as opened:
        yield opened


@pytest.fixture(scope="module")
def swept_file(shipped, quick, tmp_path_factory):
    """The evidence of a study of one replicate, which is only copied."""
    file = tmp_path_factory.mktemp("swept") / "evidence.sqlite"
    with EvidenceStore.open(file) as store:
        sweep(trial_specs(shipped, seeds=[1]), store, jobs=0, on_finished=lambda _: None, maker=quick)
    return file


@pytest.fixture
def swept(swept_file, tmp_path):
    """A copy of the evidence of a study of one replicate."""
    assert [*swept_file.parent.iterdir()] == [swept_file]
    with EvidenceStore.open(shutil.copy(swept_file, tmp_path / "swept.sqlite")) as store:
        yield store


def made(found):
    return {kind.value: count.make for kind, count in found.pieces.items() if count.make}


@pytest.mark.parametrize(("recorded", "asked"), [(STUDY, "studies/lite6_cubes.yaml"), ("", "studies/lite6_cubes.yaml")])
def test_evidence_of_another_study_is_no_earlier_evidence(shipped, store, quick, recorded, asked):
    """Designs of both have the numbers 1 to 72; an earlier release did not record the study, but the scene."""
    origin = Origin(study=recorded)
    specs = trial_specs(shipped, seeds=[1])
    sweep(specs, store, jobs=0, on_finished=lambda _: None, maker=quick, origin=lambda: origin)
    other = load_project(REPOSITORY, asked)
    missing = trial_specs(other, seeds=[1])
    assert {due.causes for due in dry_run(missing, store, study=asked).due} == {(Cause(reason=Reason.NEW),)}
    assert outdated_trials(missing, store, study=asked) == {}
    own = trial_specs(shipped.with_fidelity("contact"), seeds=[1])
    changed = [replace(spec, scene=replace(spec.scene, gravity_m_s2=9.7)) for spec in own]
    if recorded:
        of_renamed = dry_run(changed, store, study="studies/renamed.yaml").due
        assert {cause.reason for due in of_renamed for cause in due.causes} == {Reason.NEW}
    of_own = dry_run(changed, store, study=STUDY).due
    assert {cause.name for due in of_own for cause in due.causes} == {"scene.gravity_m_s2"}


def test_without_evidence_everything_is_new(shipped):
    found = dry_run(trial_specs(shipped, seeds=[1]), None)

    assert (found.trials, found.run, found.kept) == (72, 72, 0)
    assert found.pieces == {
        PieceKind.PLAN: PieceCount(make=6, stored=0, uses=72),
        PieceKind.TIMING: PieceCount(make=12, stored=0, uses=72),
        PieceKind.EXECUTION: PieceCount(make=24, stored=0, uses=72),
        PieceKind.BENCH: PieceCount(make=4, stored=0, uses=72),
    }
    (due,) = found.due
    assert due.causes == (Cause(reason=Reason.NEW),)
    assert due.pieces == tuple(PieceKind)
    assert due.trials == tuple((variant, 1) for variant in range(1, 73))


def test_without_sharing_every_trial_makes_its_own(shipped, swept):
    found = dry_run(trial_specs(shipped, seeds=[1, 2]), swept, share=False)

    assert made(found) == {"plan": 72, "timing": 72, "execution": 72, "bench": 72}
    assert found.due[0].pieces == tuple(PieceKind)


def test_after_a_sweep_nothing_is_due(shipped, swept):
    found = dry_run(trial_specs(shipped, seeds=[1]), swept)

    assert (found.trials, found.run, found.kept, found.pieces, found.due) == (72, 0, 72, {}, ())


def test_a_dry_run_makes_nothing(shipped, swept):
    before = len(swept)
    dry_run(trial_specs(shipped, seeds=[1, 2]), swept)

    assert len(swept) == before


def test_another_seed_is_new_and_takes_the_benches_that_are_there(shipped, swept):
    found = dry_run(trial_specs(shipped, seeds=[1, 2]), swept)

    assert (found.run, found.kept) == (72, 72)
    assert found.pieces[PieceKind.BENCH] == PieceCount(make=0, stored=4, uses=72)
    assert made(found) == {"plan": 6, "timing": 12, "execution": 24}
    (due,) = found.due
    assert due.causes == (Cause(reason=Reason.NEW),)
    assert due.pieces == (PieceKind.PLAN, PieceKind.TIMING, PieceKind.EXECUTION)
    assert {seed for _, seed in due.trials} == {2}


def cause(name, then, now):
    return Cause(reason=Reason.INPUT, name=name, then=then, now=now)


ON_CONTACT = {"execution": 24, "bench": 4}
EDITS = {
    "mass": (SCENE, "mass: 0.25 kg", "mass: 0.4 kg", "scene.workpiece.mass_kg", "0.25", "0.4", {"execution": 24}, 72),
    "pads": (SPACE, "d6: 0.7", "d6: 0.6", "gripper.friction", "0.7", "0.6", {"execution": 24, "bench": 4}, 72),
    "limit": (SPACE, "d9: 6 s", "d9: 5 s", "planning_limit_s", "6.0", "5.0", {}, 24),
    "speed": (SPACE, "d7: 1 m/s", "d7: 0.9 m/s", "tool_speed_m_s", "1.0", "0.9", {"timing": 6, "execution": 12}, 36),
    "charge": (
        STUDY,
        "charge_per_check: 0.25 ms",
        "charge_per_check: 0.5 ms",
        "settings.planning.clock.charge_s",
        "0.00025",
        "0.0005",
        {"plan": 6, "timing": 12, "execution": 24},
        72,
    ),
    "rate": (STUDY, "rate: 240 Hz", "rate: 480 Hz", "settings.physics.rate_hz", "240.0", "480.0", ON_CONTACT, 72),
    "opening": (
        GRIPPER,
        "largest_opening: 70 mm",
        "largest_opening: 72 mm",
        "gripper.geometry.largest_opening_m",
        "0.07",
        "0.072",
        {"plan": 3, "timing": 6, "execution": 12, "bench": 2},
        36,
    ),
    "range": (
        ROBOT,
        "range: [0 deg, 160 deg]",
        "range: [0.1 rad, 160 deg]",
        "scene.robot.joints[elbow_joint].lower_rad",
        "0.0",
        "0.1",
        {"plan": 6, "timing": 12, "execution": 24},
        72,
    ),
    "acceleration": (
        ROBOT,
        "tool_acceleration: 1.2",
        "tool_acceleration: 1.3",
        "scene.robot.tool_acceleration_m_s2",
        "1.2",
        "1.3",
        {"timing": 12, "execution": 24, "bench": 4},
        72,
    ),
    "torque": (
        ROBOT,
        "torque: 150 N*m",
        "torque: 140 N*m",
        "scene.robot.joints[elbow_joint].torque_n_m",
        "150.0",
        "140.0",
        {"execution": 24},
        72,
    ),
}


@pytest.mark.parametrize("name", EDITS)
def test_a_changed_input_is_told_by_its_name_and_reaches_what_depends_on_it(folder, edit, swept, name):
    file, old, new, dotted, then, now, pieces, trials = EDITS[name]
    edit(file, old, new)
    found = dry_run(trial_specs(load_project(folder), seeds=[1]), swept)

    (due,) = found.due
    assert due.causes == (cause(dotted, then, now),)
    assert made(found) == pieces
    assert [kind.value for kind in due.pieces] == list(pieces)
    assert len(due.trials) == found.run == trials


NO_TRIAL_DEPENDS_ON = {
    "requirement": ("requirements/system/2-gripper.yaml", 'threshold: "0.8 kg"', 'threshold: "0.9 kg"'),
    "stakeholder": ("requirements/stakeholder.yaml", "priority: high", "priority: medium"),
    "measure": ("requirements/measures.yaml", "value: 145 mm", "value: 150 mm"),
    "cost": (CATALOGUE, "value: 34000 USD", "value: 33000 USD"),
    "value": (STUDY, "worst: 25 s", "worst: 24 s"),
    "margin": (STUDY, "practical_margin: 0.01", "practical_margin: 0.02"),
    "until": (STUDY, "planning:\n", "until_decided: {cap: 60}\nplanning:\n"),
    "colour": (SCENE, 'colour: "#d9d4cc"', 'colour: "#000000"'),
    "level": (SPACE, "id: medium", "id: middling"),
}


@pytest.mark.parametrize("name", NO_TRIAL_DEPENDS_ON)
def test_what_no_trial_depends_on_asks_for_none(folder, edit, swept, name):
    edit(*NO_TRIAL_DEPENDS_ON[name])
    found = dry_run(trial_specs(load_project(folder), seeds=[1]), swept)

    assert (found.run, found.kept, found.due) == (0, 72, ())


def test_a_mass_of_the_catalogue_is_told_by_what_becomes_of_it_in_each_gripper(folder, edit, swept):
    edit(CATALOGUE, "value: 0.05 kg", "value: 0.075 kg")
    found = dry_run(trial_specs(load_project(folder), seeds=[1]), swept)

    assert made(found) == ON_CONTACT
    told = {(each.name, each.then, each.now) for due in found.due for each in due.causes}
    # Three or two actuators more, each of 25 g.
    assert {name for name, _, _ in told} == {"gripper.base_mass_kg"}
    assert {round(float(now) - float(then), 9) for _, then, now in told} == {0.075, 0.05}


def test_a_body_is_told_by_its_id(shipped, folder, edit, swept):
    body = shipped.scene.bodies[0]
    text = (folder / SCENE).read_text(encoding="utf-8")
    first = next(line for line in text.splitlines() if "friction:" in line)
    edit(SCENE, first, first.split("friction:")[0] + "friction: 0.123")
    found = dry_run(trial_specs(load_project(folder), seeds=[1]), swept)

    (due,) = found.due
    (only,) = due.causes
    assert (only.name, only.now) == (f"scene.bodies[{body.id}].friction", "0.123")


def test_two_edits_are_two_causes(folder, edit, swept):
    edit(SCENE, "mass: 0.25 kg", "mass: 0.4 kg")
    edit(SPACE, "d9: 6 s", "d9: 5 s")
    found = dry_run(trial_specs(load_project(folder), seeds=[1]), swept)

    mass, limit = cause("scene.workpiece.mass_kg", "0.25", "0.4"), cause("planning_limit_s", "6.0", "5.0")
    assert {due.causes: len(due.trials) for due in found.due} == {(mass,): 48, (limit, mass): 24}


def test_of_several_earlier_studies_the_nearest_tells(shipped, folder, edit, swept, quick):
    edit(SCENE, "mass: 0.25 kg", "mass: 0.4 kg")
    edit(SPACE, "d6: 0.7", "d6: 0.6")
    sweep(trial_specs(load_project(folder), seeds=[1]), swept, jobs=0, on_finished=lambda _: None, maker=quick)
    edit(SPACE, "d6: 0.6", "d6: 0.5")
    found = dry_run(trial_specs(load_project(folder), seeds=[1]), swept)

    (due,) = found.due
    assert due.causes == (cause("gripper.friction", "0.6", "0.5"),)


@pytest.fixture
def with_versions(monkeypatch):
    """Lets other versions and other code be in use."""

    def use(found, code=None):
        monkeypatch.setattr("rgss.sweep.preview.versions", lambda: found)
        monkeypatch.setattr("rgss.sweep.trial_keys.versions", lambda: found)
        naming._inputs_of.cache_clear()
        if code is not None:
            monkeypatch.setattr(naming, "code_of_trials", lambda: code)

    yield use
    monkeypatch.undo()
    naming._inputs_of.cache_clear()


def test_a_changed_engine_is_told_with_its_versions(shipped, swept, with_versions):
    now = {**versions(), "toppra": "9.9.9"}
    with_versions(now)
    found = dry_run(trial_specs(shipped, seeds=[1]), swept)

    (due,) = found.due
    assert due.causes == (Cause(reason=Reason.ENGINE, name="toppra", then=versions()["toppra"], now="9.9.9"),)
    assert made(found) == {"timing": 12, "execution": 24}


def test_changed_code_is_told_by_its_modules(shipped, swept, with_versions):
    code = {**naming.code_of_trials(), "rgss.trials.monitors.phase_monitor": "0" * 12}
    with_versions({**versions(), "rgss-execution": "0" * 64}, code)
    found = dry_run(trial_specs(shipped, seeds=[1]), swept)

    (due,) = found.due
    assert [(each.reason, each.name) for each in due.causes] == [(Reason.CODE, "rgss.trials.monitors.phase_monitor")]
    assert made(found) == {"execution": 24}


def test_evidence_that_says_nothing_of_its_inputs_is_of_unknown_inputs(shipped, store, record_of):
    specs = trial_specs(shipped, seeds=[1])
    old = Provenance(inputs={}, versions={"ompl": "1.6.0", "rgss-source": "a" * 64})
    store.put_many(trials=[(f"{spec.variant:064x}", record_of(spec), old) for spec in specs])
    found = dry_run(specs, store)

    (due,) = found.due
    assert {each.reason for each in due.causes} == {Reason.ENGINE, Reason.CODE, Reason.UNKNOWN}
    assert Cause(reason=Reason.UNKNOWN) in due.causes
    assert Cause(reason=Reason.ENGINE, name="ompl", then="1.6.0", now=versions()["ompl"]) in due.causes


def test_a_failure_of_the_run_is_told_with_what_failed(shipped, swept):
    specs = trial_specs(shipped, seeds=[1, 2])
    trials = trials_of(specs)
    plan = next(trial.digests.plan for trial in trials if trial.spec.seed == 2)
    failure = RunFailure(key=plan, what="plan", kind=RunFailureKind.TIMED_OUT, detail="not done after 3 s", attempts=2)
    swept.put_failure(failure)
    found = dry_run(specs, swept)

    failed = Cause(reason=Reason.FAILED, name="plan", then="timed_out: not done after 3 s")
    assert {due.causes: len(due.trials) for due in found.due} == {(failed,): 12, (Cause(reason=Reason.NEW),): 60}


def test_a_limit_beyond_the_search_is_refused(shipped):
    from dataclasses import replace

    spec = trial_specs(shipped, seeds=[1])[0]
    with pytest.raises(DefinitionError, match=r"the planning limit of 8.5 s exceeds the search"):
        dry_run([replace(spec, planning_limit_s=8.5)], None)


def test_named_inputs_are_those_of_all_seeds_and_leave_out_what_is_none(shipped):
    one, two, other = trial_specs(shipped, variants=[shipped.designs.variant(n) for n in (1, 2)], seeds=[1, 2])[:3]
    inputs = named_inputs(one)

    assert named_inputs(two) is inputs
    assert named_inputs(other).digest != inputs.digest
    assert {*inputs.values} == {
        "fidelity",
        "scene",
        "gripper",
        "planner",
        "planner_settings",
        "planning_limit_s",
        "tool_speed_m_s",
        "settings",
        "uncertainty",
        "workload",
        "task",
        "code",
    }
    assert "colour" not in repr(inputs.values)
    assert len(inputs.values["scene"]["robot"]["urdf"]) == 12
    assert "rgss.trials.planning.plan" in inputs.values["code"]
