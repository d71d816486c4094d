"""Uncertainty and workload of a study: over the scene's, into its trials, and what contradicts itself."""

from __future__ import annotations

import pytest

from rgss.scenes.uncertainty import NOTHING_UNCERTAIN, ONE_WORKLOAD, Normal
from rgss.studies.expansion import trial_specs
from rgss.studies.input_names import named_inputs
from rgss.studies.project import load_project
from rgss.trials.conditions import conditions_of
from rgss.trials.pieces.input_digests import digests_of

STUDY, SCENE = "studies/pick_place.yaml", "scenes/restaurant.yaml"
OF_SCENE = """
uncertainty:
  perception.x: {normal: {mean: 0 mm, sd: 6 mm}, rationale: camera}
  workpiece.friction: {uniform: {low: 0.5, high: 1.2}, rationale: water}
"""
OF_STUDY = """
uncertainty:
  perception.x: {normal: {mean: 0 mm, sd: 2 mm}, rationale: a better camera}
  perception.y: {normal: {mean: 0 mm, sd: 2 mm}, rationale: a better camera}
correlations:
  - {quantities: [perception.y, workpiece.friction], matrix: [[1, 0.3], [0.3, 1]], rationale: glare}
workload:
  - {case: cup, replicates: 2, rationale: as it is}
  - {case: full, mass: 0.6 kg, rationale: with water}
"""


@pytest.fixture
def append(folder):
    """Adds a text to the end of a file of the copy."""

    def add(file, text):
        path = folder / file
        path.write_text(path.read_text(encoding="utf-8") + text, encoding="utf-8")

    return add


def test_a_study_overrides_its_scene_quantity_by_quantity(folder, append):
    append(SCENE, OF_SCENE)
    append(STUDY, OF_STUDY)
    project = load_project(folder)

    by_name = {one.quantity: one.distribution for one in project.uncertainty.values}
    assert set(by_name) == {"workpiece.friction", "perception.x", "perception.y"}
    assert by_name["perception.x"] == Normal(mean=0.0, sd=0.002)
    assert [group.quantities for group in project.uncertainty.correlations] == [("perception.y", "workpiece.friction")]
    (spec,) = trial_specs(project, variants=[project.designs.variant(65)], seeds=[1])
    assert spec.uncertainty == project.uncertainty
    # What counts is named once.
    assert spec.scene.uncertainty == NOTHING_UNCERTAIN
    assert conditions_of(spec).case == "full"
    assert conditions_of(spec).scene.workpiece.mass_kg == 0.6
    assert set(conditions_of(spec).draws) == set(by_name)


def test_nominal_switches_all_of_it_off(folder, append, edit):
    append(SCENE, OF_SCENE)
    append(STUDY, OF_STUDY)
    varied = load_project(folder)
    edit(STUDY, "seed: 1\n", "seed: 1\nnominal: true\n")
    nominal = load_project(folder)

    assert (nominal.uncertainty, nominal.workload) == (NOTHING_UNCERTAIN, ONE_WORKLOAD)
    assert varied.nominal().uncertainty == NOTHING_UNCERTAIN
    keys = [
        {digests_of(spec, {}).trial for spec in trial_specs(project, variants=[project.designs.variant(65)])}
        for project in (varied, nominal, varied.nominal())
    ]
    assert keys[1] == keys[2]
    assert keys[0].isdisjoint(keys[1])


def test_the_shipped_study_without_uncertainty_is_nominal(shipped):
    assert {digests_of(spec, {}).trial for spec in trial_specs(shipped)} == {
        digests_of(spec, {}).trial for spec in trial_specs(shipped.nominal())
    }


def test_the_named_inputs_have_the_distributions_and_not_the_draws(folder, append):
    append(SCENE, OF_SCENE)
    project = load_project(folder)
    one, other = trial_specs(project, variants=[project.designs.variant(65)], seeds=[1, 2])

    assert named_inputs(one).digest == named_inputs(other).digest
    assert {"quantity": "perception.x", "distribution": {"mean": 0.0, "sd": 0.006}} in named_inputs(one).values[
        "uncertainty"
    ]["values"]


@pytest.mark.parametrize(
    ("text", "anchor", "expected"),
    [
        (
            "\ncorrelations:\n  - {quantities: [perception.x, perception.z], matrix: [[1, 0], [0, 1]], rationale: r}\n",
            "[perception.x, perception.z]",
            "perception.z has no distribution (give it one under 'uncertainty', here or in the scene)",
        ),
        (
            "\nworkload:\n  - {case: wet, friction: 0.4, rationale: r}\n",
            "0.4, rationale: r}",
            (
                "case 'wet' gives the friction that workpiece.friction draws (take it out of the case, or out of "
                "'uncertainty'; workpiece.mass_factor varies a case's mass)"
            ),
        ),
        (
            "\nuncertainty:\n  perception.lid.x: {constant: 1 mm, rationale: r}\n",
            "{constant: 1 mm, rationale: r}",
            (
                "perception.lid.x: no object 'lid' under the scene's 'workpieces' (the scene has one object: its "
                "quantity is 'perception.x')"
            ),
        ),
        (
            "\nworkload:\n  - {case: wide, radius: 70 mm, rationale: r}\n",
            "70 mm, rationale: r}",
            "an object of radius 70 mm does not fit into a hand that opens 70 mm (take a thinner one)",
        ),
        (
            "\nworkload:\n  - {case: a, rationale: r}\n  - {case: a , rationale: r}\n",
            "a , rationale",
            "case 'a' is taken by an earlier one",
        ),
        (
            "\nworkload:\n  - {case: a, mass: 0 kg, rationale: r}\n",
            "0 kg, rationale: r}",
            "mass must be greater than zero",
        ),
        (
            "\nworkload:\n  - {case: a, friction: -1, rationale: r}\n",
            "-1, rationale: r}",
            "friction must be greater than zero",
        ),
    ],
)
def test_what_contradicts_itself_is_told_at_its_place(append, problems, place_of, text, anchor, expected):
    append(SCENE, OF_SCENE)
    append(STUDY, text)

    assert [problem for problem in problems() if f"{place_of(STUDY, anchor)}: error: {expected} [" in problem]


def test_a_constant_of_the_scene_cannot_be_correlated_by_a_study(append, problems, place_of):
    append(SCENE, f"{OF_SCENE}  perception.z: {{constant: 1 mm, rationale: fixture}}\n")
    group = "[perception.x, perception.z]"
    append(STUDY, f"\ncorrelations:\n  - {{quantities: {group}, matrix: [[1, 0.2], [0.2, 1]], rationale: r}}\n")

    message = "perception.z is constant in the scene and cannot be correlated (take it out of the group)"
    assert [problem for problem in problems() if f"{place_of(STUDY, group)}: error: {message} [" in problem]


def test_a_quantity_that_is_no_number_is_bad_input(append, problems, place_of):
    append(STUDY, "\nuncertainty:\n  workpiece.mass: {constant: heavy, rationale: r}\n")

    (problem,) = problems()
    assert problem.startswith(
        f"{place_of(STUDY, 'heavy, rationale')}: error: workpiece.mass: 'heavy' is not a quantity"
    )
