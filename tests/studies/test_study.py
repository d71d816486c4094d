"""Reading a study: each finding at its place."""

from __future__ import annotations

import pytest

from rgss.errors import DocumentError
from rgss.evidence import Fidelity
from rgss.motion import ClockKind
from rgss.studies.expansion import trial_settings
from rgss.studies.project import load_project
from rgss.studies.study import named_file, read_study

STUDY = "studies/pick_place.yaml"
TEXT = """\
# A study that does not change when the shipped one does.
#
study: carry
design_space: designs/grasping_system.yaml
catalogue: designs/catalogue.yaml
scene: scenes/restaurant.yaml

seed: 1
replicates: 3
fidelity: contact

planning:
  clock: counted
  charge_per_check: 0.25 ms
  resolution: 0.01 rad
  simplification_checks: 1500
  clearance: 8 mm

physics:
  rate: 240 Hz
  solver_iterations: 50

trade_off:
  values:
    - {measure: P_max, weight: 0.25, worst: 0.8 kg, best: 1.4 kg}
    - {measure: C_total, weight: 0.25, worst: 44000 USD, best: 38000 USD}
    - {measure: t_e, weight: 0.20, worst: 25 s, best: 5 s}
    - {measure: t_p, weight: 0.10, worst: 15 s, best: 1 s}
    - {measure: S, weight: 0.20, worst: 0.8, best: 1.0}
"""
LONG = "x" * 5000

MOVES = "moves:\n  move_to_grasp: straight\n  move_to_place: joint\n"
FINDINGS = [
    (
        "physics:\n",
        "moves: {move_to_grasp: curved}\nphysics:\n",
        "19:24: error: move_to_grasp: 'curved' is not one of 'planned', 'straight' or 'joint'",
    ),
    ("physics:\n", "moves: {lift: straight}\nphysics:\n", "19:9: error: "),
    ("charge_per_check: 0.25 ms", "charge_per_check: 0 ms", "14:21: error: charge_per_check must be greater than zero"),
    ("resolution: 0.01 rad", "resolution: -0.01 rad", "15:15: error: resolution must be greater than zero"),
    ("clearance: 8 mm", "clearance: -8 mm", "17:14: error: clearance must not be negative [study.negative]"),
    ("rate: 240 Hz", "rate: 0 Hz", "20:9: error: rate must be greater than zero [study.not-positive]"),
    (
        "scene: scenes/restaurant.yaml",
        "scene: scenes/kitchen.yaml",
        "6:8: error: there is no file 'scenes/kitchen.yaml' (file names are relative to the project)",
    ),
    ("scene: scenes/restaurant.yaml", f"scene: {LONG}", "6:8: error: there is no file 'xxxxxxxxxxxx"),
    ("scene: scenes/restaurant.yaml", 'scene: "a\\0b"', "6:8: error: there is no file 'a\\x00b'"),
    ("scene: scenes/restaurant.yaml", "scene: scenes", "6:8: error: there is no file 'scenes'"),
    (
        "catalogue: designs/catalogue.yaml",
        "catalogue: ../catalogue.yaml",
        "5:12: error: '../catalogue.yaml' lies outside the project (name a file in it) [study.outside]",
    ),
    (
        "catalogue: designs/catalogue.yaml",
        "catalogue: /catalogue.yaml",
        "5:12: error: '/catalogue.yaml' lies outside the project (name a file in it) [study.outside]",
    ),
    ("measure: t_p,", "measure: t_q,", "28:17: error: no measure 't_q' is defined (did you mean 't_p'?)"),
    ("measure: t_p,", "measure: t_e,", "28:17: error: measure 't_e' is valued twice (keep one) [study.repeated]"),
    ("worst: 0.8 kg", "worst: 0.8", "25:45: error: '0.8' has no unit (write \"0.8 kg\") [study.quantity]"),
    ("best: 1.4 kg", "best: 1.4 s", "25:59: error: unit 's' does not measure what 'kg' measures (give it in kg"),
    (
        "best: 1.4 kg",
        "best: 800 g",
        "25:59: error: the value function of 'P_max' has no range: worst and best are both 0.8 (set worst",
    ),
    (
        "weight: 0.10",
        "weight: -0.10",
        "28:30: error: weight of 't_p' must be at least 0, got -0.1 (give a number from 0 to 1)",
    ),
    ("weight: 0.10", "weight: 0.20", "25:5: error: weights must sum to 1, got 1.1 (change them by -0.1 in all, or"),
    ("weight: 0.10", "weight: 10 kg", "28:30: error: weight: '10 kg' has a unit where a pure number"),
    ("seed: 1", "seed: 2147483648", "8:7: error: seed: input should be less than or equal to 2147483647"),
    ("replicates: 3", "replicates: 0", "9:13: error: replicates: input should be greater than or equal to 1"),
    ("replicates: 3", "replicates: 10001", "9:13: error: replicates: input should be less than or equal to 10000"),
    ("replicates: 3", "replicates: few", "9:13: error: replicates: "),
    ("fidelity: contact", "fidelity: magic", "10:11: error: fidelity: 'magic' is not one of 'kinematic', 'dynamic'"),
    ("clock: counted", "clock: sundial", "13:10: error: clock: 'sundial' is not one of 'counted' or 'wall'"),
    ("solver_iterations: 50", "solver_iterations: 0", "21:22: error: solver_iterations: input should be greater"),
    (
        "simplification_checks: 1500",
        "simplification_checks: 1500\n  simplification_limit: -1 s",
        "17:25: error: simplification_limit must",
    ),
    (
        "rate: 240 Hz",
        "rate: 60 Hz",
        "20:9: error: contact physics needs at least 120 Hz, got 60 Hz (240 Hz is validated) [study.coarse-physics]",
    ),
    (
        "solver_iterations: 50",
        "solver_iterations: 9",
        "21:22: error: contact physics at 240 Hz needs at least 10 solver iterations, got 9 (20 are validated) [study.",
    ),
    ("simplification_checks: 1500", "simplification_checks: -1", "16:26: error: simplification_checks: input should"),
]


@pytest.fixture
def folder(folder):
    (folder / STUDY).write_text(TEXT, encoding="utf-8")
    return folder


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize(("old", "new", "expected"), FINDINGS)
def test_finding(edit, problems, old, new, expected):
    edit(STUDY, old, new)
    (problem,) = problems()

    assert problem.startswith(f"{STUDY}:{expected}")


def test_each_move_is_planned_unless_the_study_says_otherwise(edit, folder):
    was = load_project(folder, STUDY)
    edit(STUDY, "physics:\n", f"{MOVES}physics:\n")
    project = load_project(folder, STUDY)

    assert [kind.value for kind in was.study.planning.settings.moves] == ["planned"] * 5
    assert [kind.value for kind in project.study.planning.settings.moves] == [
        "straight",
        "planned",
        "planned",
        "joint",
        "planned",
    ]
    assert trial_settings(project).planning.moves == project.study.planning.settings.moves


@pytest.mark.parametrize("fidelity", ["kinematic", "dynamic"])
def test_a_study_without_contact_may_step_coarsely(edit, folder, fidelity):
    edit(STUDY, "fidelity: contact", f"fidelity: {fidelity}")
    edit(STUDY, "rate: 240 Hz", "rate: 60 Hz")

    assert load_project(folder, STUDY).study.rate_hz == 60.0


def test_several_findings_in_the_order_of_their_places(edit, problems):
    edit(STUDY, "scene: scenes/restaurant.yaml", "scene: scenes/kitchen.yaml")
    edit(STUDY, "rate: 240 Hz", "rate: 0 Hz")
    edit(STUDY, "measure: t_p,", "measure: t_q,")
    edit(STUDY, "worst: 0.8 kg", "worst: heavy")

    assert [problem.split(": ")[0] for problem in problems()] == [
        f"{STUDY}:{place}" for place in ("6:8", "20:9", "25:45", "28:17")
    ]


def test_a_study(folder, shipped):
    study = read_study(folder / STUDY, shipped.measures, project=folder, label=STUDY)

    assert (study.id, study.label) == ("carry", STUDY)
    assert (study.design_space, study.catalogue, study.scene) == (
        "designs/grasping_system.yaml",
        "designs/catalogue.yaml",
        "scenes/restaurant.yaml",
    )
    assert (study.seed, study.replicates, study.seeds) == (1, 3, (1, 2, 3))
    assert study.fidelity is Fidelity.CONTACT
    assert study.planning.settings.clock.kind is ClockKind.COUNTED
    assert study.planning.settings.clock.charge_s == 0.00025
    assert study.planning.settings.clearance_m == 0.008
    assert (study.rate_hz, study.solver_iterations) == (240.0, 50)
    assert [(anchors.measure, anchors.worst, anchors.best) for anchors in study.values] == [
        ("P_max", 0.8, 1.4),
        ("C_total", 44000.0, 38000.0),
        ("t_e", 25.0, 5.0),
        ("t_p", 15.0, 1.0),
        ("S", 0.8, 1.0),
    ]


def test_quantities_are_in_the_units_of_the_measures(folder, edit, shipped):
    edit(STUDY, "worst: 0.8 kg, best: 1.4 kg", "worst: 700 g, best: 0.0015 t")
    study = read_study(folder / STUDY, shipped.measures, project=folder, label=STUDY)
    payload = study.values[0]

    assert (payload.measure, payload.worst, payload.best) == ("P_max", pytest.approx(0.7), pytest.approx(1.5))


def test_values_are_not_looked_at_without_measures(folder, edit):
    edit(STUDY, "measure: t_p,", "measure: t_q,")
    study = read_study(folder / STUDY, None, project=folder, label=STUDY)

    assert study.values == ()


def test_weights_are_looked_at_without_measures(folder, edit):
    edit(STUDY, "weight: 0.10", "weight: 0.11")

    with pytest.raises(DocumentError, match=r"weights must sum to 1, got 1\.01"):
        read_study(folder / STUDY, None, project=folder, label=STUDY)


def test_named_files_lie_in_the_project(folder, tmp_path):
    (tmp_path / "secret.yaml").write_text("a: 1\n")
    (folder / "scenes" / "link.yaml").symlink_to(tmp_path / "secret.yaml")

    assert named_file(folder, "scenes/restaurant.yaml") == (folder / "scenes/restaurant.yaml").resolve()
    for name in ("scenes/link.yaml", "../secret.yaml", "scenes", "scenes/none.yaml", LONG, "a\0b"):
        assert named_file(folder, name) is None
