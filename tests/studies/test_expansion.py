"""From a project to its trials."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.errors import DefinitionError
from rgss.motion import ClockKind
from rgss.scenes.uncertainty import NOTHING_UNCERTAIN
from rgss.studies.expansion import trial_settings, trial_specs
from rgss.studies.project import load_project

SPACE, STUDY = "designs/grasping_system.yaml", "studies/pick_place.yaml"


@pytest.mark.verifies("SYS-029")
def test_variants_are_outermost_and_have_the_same_seeds(shipped):
    specs = trial_specs(shipped)

    assert [(spec.variant, spec.seed) for spec in specs] == [
        (variant, seed) for variant in range(1, 73) for seed in shipped.study.seeds
    ]
    assert len({spec.fidelity for spec in specs}) == 1
    assert len({id(spec.settings) for spec in specs}) == 1


def test_chosen_variants_and_seeds(shipped):
    variants = [shipped.designs.variant(number) for number in (65, 3)]

    assert [(spec.variant, spec.seed) for spec in trial_specs(shipped, variants=variants, seeds=[9, 4])] == [
        (65, 9),
        (65, 4),
        (3, 9),
        (3, 4),
    ]


def test_seeds_count_up_from_the_studys(folder, edit):
    edit(STUDY, "seed: 1\nreplicates: 3", "seed: 40\nreplicates: 2")

    assert {spec.seed for spec in trial_specs(load_project(folder))} == {40, 41}


@pytest.mark.verifies("SYS-010")
def test_a_trial_has_the_values_of_its_design(shipped):
    for spec in trial_specs(shipped, seeds=[1]):
        variant = shipped.designs.variant(spec.variant)
        values, gripper = variant.parameters, spec.gripper
        actuator_kg = variant.components["finger_actuator"].mass_kg

        assert gripper.geometry.fingers == values["d1"]
        assert gripper.finger_mass_kg == values["d2"]
        assert gripper.base_mass_kg == pytest.approx(values["d3"] + values["d1"] * actuator_kg)
        assert gripper.finger_velocity_m_s == values["d4"]
        assert gripper.finger_force_n == values["d5"]
        assert gripper.friction == values["d6"]
        assert spec.tool_speed_m_s == values["d7"]
        assert spec.planner == values["d8"]
        assert spec.planning_limit_s == values["d9"]
        assert spec.scene == replace(shipped.scene, uncertainty=NOTHING_UNCERTAIN)
        assert spec.uncertainty == shipped.uncertainty


def test_settings_are_the_studys_and_searches_as_long_as_the_longest_limit(folder, edit):
    edit(STUDY, "clock: counted", "clock: wall")
    edit(STUDY, "rate: 240 Hz", "rate: 1 kHz")
    edit(STUDY, "clearance: 8 mm", "clearance: 1 cm")
    edit(STUDY, "solver_iterations: 20", "solver_iterations: 90")
    edit(SPACE, "d9: 6 s", "d9: 11 s")
    settings = trial_settings(load_project(folder))

    assert settings.planning.clock.kind is ClockKind.WALL
    assert settings.planning.clearance_m == 0.01
    assert settings.planning.search_limit_s == 11.0
    assert (settings.physics.solver_iterations, settings.physics.free_iterations) == (90, 90)
    assert settings.physics.rate_hz == 1000.0


def test_a_variant_without_a_number(shipped):
    variant = shipped.designs.variant(1)
    broken = replace(variant, parameters={**variant.parameters, "d7": "fast"})

    with pytest.raises(DefinitionError, match=r"robot\.tool_speed of variant 1 must be a number, got 'fast'"):
        trial_specs(shipped, variants=[broken])


def test_a_variant_whose_gripper_has_another_shape(shipped):
    variant, other = shipped.designs.variant(1), shipped.designs.variant(19)
    broken = replace(variant, components={**variant.components, "gripper": other.components["gripper"]})

    with pytest.raises(
        DefinitionError,
        match=r"gripper\.fingers of variant 1 must equal azimuths in the gripper file, which is 2, got 3 \(let the",
    ):
        trial_specs(shipped, variants=[broken])


def test_a_variant_whose_gripper_has_no_shape(shipped):
    variant = shipped.designs.variant(1)
    shapeless = replace(variant.components["gripper"], geometry="")
    broken = replace(variant, components={**variant.components, "gripper": shapeless})

    with pytest.raises(DefinitionError, match="names no geometry"):
        trial_specs(shipped, variants=[broken])


def test_a_variant_without_a_required_quantity(shipped):
    variant = shipped.designs.variant(1)
    definitions = tuple(replace(one, sets="") if one.sets == "robot.tool_speed" else one for one in variant.definitions)

    with pytest.raises(DefinitionError, match=r"variant 1 has no value of robot\.tool_speed \(add a design parameter"):
        trial_specs(shipped, variants=[replace(variant, definitions=definitions)])
