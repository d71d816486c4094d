"""Design spaces with any number of parameters, in any order, under any ids."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.designs import SETTABLE_QUANTITIES, Application, ParameterKind, picked
from rgss.errors import DocumentError
from rgss.studies import uncounted_mass_findings, unused_findings
from rgss.studies.expansion import trial_settings, trial_specs
from rgss.studies.project import load_project
from rgss.studies.scaffolding import write_scaffold
from rgss.studies.trial_values import field_of, with_values

REPOSITORY = Path(__file__).parents[2]
SPACE, CATALOGUE, STUDY = "designs/design_space.yaml", "designs/catalogue.yaml", "studies/pick_place.yaml"
MEASURES = "requirements/measures.yaml"


@pytest.fixture
def small(tmp_path):
    """A new project whose gripper files, robot and study give all that a trial needs."""
    folder = tmp_path / "small"
    write_scaffold(folder)
    for fingers in (2, 3):
        _edit(folder, f"scenes/grippers/kg-{fingers}.yaml", "height: 85 mm", "height: 85 mm, mass: 0.4 kg")
        given = "length: 90 mm, mass: 0.2 kg, speed: 0.04 m/s, force: 9 N, friction: 0.6"
        _edit(folder, f"scenes/grippers/kg-{fingers}.yaml", "length: 90 mm", given)
    _edit(folder, "scenes/robots/ur10.yaml", "payload: 10 kg", "payload: 10 kg\ntool_speed: 0.7 m/s")
    _edit(folder, STUDY, "  clearance: 8 mm", "  clearance: 8 mm\n  planner: TRRT\n  time_limit: 5 s")
    _edit(
        folder,
        CATALOGUE,
        "    matches: {planner: RRTConnect} # any geometric planner of the library, by its name\n",
        "",
    )
    for name, value, unit in (("finger_force", "9 N", "N"), ("friction", "0.6", "1")):
        text = (folder / MEASURES).read_text(encoding="utf-8")
        (line,) = [line for line in text.splitlines() if f"source: design.{name}," in line]
        _edit(folder, MEASURES, f"{line}\n", "")
        constant = f'{{id: {name}, value: {value}, unit: "{unit}", definition: Fixed., source: The gripper file}}'
        _edit(folder, MEASURES, "constants:\n", f"constants:\n  - {constant}\n")
    return folder


def _edit(folder, file, old, new):
    text = (folder / file).read_text(encoding="utf-8")
    assert old in text, (file, old)
    (folder / file).write_text(text.replace(old, new, 1), encoding="utf-8")


def _space(folder, text):
    (folder / SPACE).write_text(text, encoding="utf-8")
    return load_project(folder)


TWO = """\
parameters:
  - {id: pace, name: pace, symbol: v, unit: m/s, sets: robot.tool_speed, description: Speed.}
  - {id: fingers, name: fingers, symbol: n, kind: count, sets: gripper.fingers, description: Fingers.}
constants: {fingers: 3}
factors:
  - {id: pace, name: Pace, levels: [{id: a, sets: {pace: 0.3 m/s}}, {id: b, sets: {pace: 20 cm/s}}]}
"""


def test_two_parameters(small):
    project = _space(small, TWO)
    specs = trial_specs(project, seeds=[1])
    assert [spec.tool_speed_m_s for spec in specs] == [0.3, 0.2]
    one = specs[0]
    assert (one.planner, one.planning_limit_s, one.settings.planning.search_limit_s) == ("TRRT", 5.0, 5.0)
    assert (one.gripper.base_mass_kg, one.gripper.finger_mass_kg) == (0.4 + 3 * 0.05, 0.2)
    assert (one.gripper.finger_velocity_m_s, one.gripper.finger_force_n, one.gripper.friction) == (0.04, 9.0, 0.6)
    chosen = picked(project.designs, ["robot.tool_speed < 0.25 m/s", "gripper.fingers=3"])
    assert [variant.id for variant in chosen] == [2]
    assert not list(unused_findings(project))


def test_a_speed_that_is_a_fixed_value_of_the_robot(small):
    project = _space(small, TWO.replace("sets: robot.tool_speed, ", ""))
    assert {spec.tool_speed_m_s for spec in trial_specs(project)} == {0.7}
    (finding,) = unused_findings(project)
    assert str(finding) == (
        f"{SPACE}:2:10: warning: pace sets nothing, and no component, rule or measure uses it "
        "(say what it sets under 'sets', or remove it) [design.unused-parameter]"
    )


def test_actuators_whose_mass_is_in_no_trial(small):
    assert not list(uncounted_mass_findings(_space(small, TWO)))
    _edit(small, CATALOGUE, "    sets: {mass: gripper.actuator.mass}", "   ")
    (finding,) = uncounted_mass_findings(load_project(small))
    assert "warning: the mass of a finger_actuator is in no trial (add 'sets: {mass: gripper.actuator.mass}'" in str(
        finding
    )
    assert finding.file == CATALOGUE
    assert finding.rule == "design.uncounted-mass"


def test_parameters_of_every_quantity_in_any_order(small):
    others = ("gripper.actuator.mass", "gripper.mounting")
    names = [name for name in reversed(SETTABLE_QUANTITIES) if name not in others]
    values = {
        "planning.planner": "STRIDE",
        "gripper.fingers": 2,
        "planning.simplification_checks": 700,
        "timing.profile": "trapezoid",
        "timing.peak_speed": 0.9,
        "timing.peak_acceleration": 0.8,
        "control.mode": "velocity",
    }
    lines, constants = [], []
    for number, name in enumerate(names):
        quantity = SETTABLE_QUANTITIES[name]
        of = "fingers" if name == "gripper.fingers" else f"x{number}"
        kind = f"unit: '{quantity.unit}'" if quantity.kind is ParameterKind.QUANTITY else f"kind: {quantity.kind.value}"
        lines.append(f"  - {{id: {of}, name: {of}, symbol: x, {kind}, sets: {name}, description: X.}}")
        constants.append(f"  {of}: {values.get(name, f'0.{number + 1} {quantity.unit}'.removesuffix(' 1'))}")
    assert len(lines) == 24
    project = _space(small, "\n".join(["parameters:", *lines, "constants:", *constants, ""]))

    (spec,) = trial_specs(project, seeds=[1])
    for number, name in enumerate(names):
        quantity = SETTABLE_QUANTITIES[name]
        expected = values.get(name, float(f"0.{number + 1}"))
        expected += 2 * 0.05 if name == "gripper.base.mass" else "" if isinstance(expected, str) else 0
        found = field_of(spec, quantity.field)
        if quantity.application is Application.PLACEMENT:
            coordinate = name.rpartition(".")[2]
            yaw = found.roll_pitch_yaw_rad()[2]
            found, expected = (
                {**dict(zip("xyz", found.position_m, strict=True)), "yaw": yaw}[coordinate],
                pytest.approx(expected),
            )
        assert found == expected, name


def test_components_whose_properties_set_several_quantities(small):
    _edit(small, CATALOGUE, "properties: {mass: kg, force: N}", "properties: {mass: kg, force: N, pace: m/s}")
    _edit(
        small,
        CATALOGUE,
        "sets: {mass: gripper.actuator.mass}",
        "sets: {mass: gripper.actuator.mass, force: gripper.finger.force, pace: gripper.finger.speed}",
    )
    _edit(
        small,
        CATALOGUE,
        "      force: {value: 15 N",
        "      pace: {value: 2 cm/s, source: X}\n      force: {value: 15 N",
    )
    for spec in trial_specs(_space(small, TWO)):
        assert (spec.gripper.finger_force_n, spec.gripper.finger_velocity_m_s) == (15.0, 0.02)


def test_a_sample_whose_limits_are_a_range_searches_to_its_end(small):
    text = TWO.replace("unit: m/s, sets: robot.tool_speed", "unit: s, sets: planning.time_limit")
    levels = "levels: [{id: a, sets: {pace: 0.3 m/s}}, {id: b, sets: {pace: 20 cm/s}}]"
    text = text.replace(levels, "parameter: pace, range: [1 s, 9 s], resolution: 1 s")
    project = _space(small, text + "sample: {method: sobol, size: 2, seed: 1}\n")
    assert trial_settings(project).planning.search_limit_s == 9.0


def test_every_quantity_is_applied_to_a_field_of_a_trial(shipped):
    (spec, *_) = trial_specs(shipped, variants=[shipped.designs.variant(1)])
    values = {one.name: field_of(spec, one.field) for one in SETTABLE_QUANTITIES.values()}
    values["gripper.actuator.mass"] = 0.0
    assert with_values(spec, values) == spec
    for quantity in SETTABLE_QUANTITIES.values():
        if quantity.application is Application.REPLACE:
            names = quantity.choices[:1] if values[quantity.name] not in quantity.choices[:1] else quantity.choices[1:]
            is_name = quantity.kind is ParameterKind.NAME
            other = (*names, "STRIDE")[0] if is_name else values[quantity.name] + 1
            changed = with_values(spec, {**values, quantity.name: other})
            assert changed != spec
            assert field_of(changed, quantity.field) == other


def test_the_page_lists_every_quantity():
    page = (REPOSITORY / "docs/designs.md").read_text(encoding="utf-8")
    for one in SETTABLE_QUANTITIES.values():
        unit = one.kind.value if one.kind is not ParameterKind.QUANTITY else one.unit
        assert f"| `{one.name}` | {unit} | {one.meaning} | {one.default} |\n" in page


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        ("scenes/robots/ur10.yaml", "0.7 m/s", "0.1 mm/s", "tool_speed must be at least 1 mm/s (a slower arm or hand"),
        ("scenes/robots/ur10.yaml", "0.7 m/s", "0 m/s", "tool_speed must be greater than zero"),
        ("scenes/grippers/kg-2.yaml", "0.04 m/s", "0.1 mm/s", "speed must be at least 1 mm/s (a slower"),
        ("scenes/grippers/kg-2.yaml", "force: 9 N", "force: 0 N", "force must be greater than zero"),
        (STUDY, "time_limit: 5 s", "time_limit: 0 s", "time_limit must be greater than zero"),
    ],
)
def test_values_of_files_are_checked(small, file, old, new, expected):
    _edit(small, file, old, new)
    with pytest.raises(DocumentError) as caught:
        _space(small, TWO)
    assert [str(finding) for finding in caught.value.findings if expected in str(finding)], caught.value.findings
