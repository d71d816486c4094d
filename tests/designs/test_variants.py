"""Variants of a small project: values, digests, components, tables."""

import hashlib
import json
import os
import subprocess
import sys

import pytest

from rgss.designs import load_catalogue, load_design_space, sources, variants_csv
from rgss.errors import DefinitionError


def test_levels_multiply_with_the_last_factor_fastest(project):
    assert variants_csv(project.load().expand()) == (
        "design_id,d1_mass_kg,d2_fingers,d3_planner,d4_force_n\n"
        "1,0.1,2,RRT,3\n2,0.1,2,PRM,3\n3,0.1,3,RRT,3\n4,0.1,3,PRM,3\n"
        "5,0.2,2,RRT,3\n6,0.2,2,PRM,3\n7,0.2,3,RRT,3\n8,0.2,3,PRM,3\n"
    )


def test_a_variant_knows_what_it_is_made_of(project):
    variant = project.load().variant(6)
    assert variant.parameters == {"d1": 0.2, "d2": 2, "d3": "PRM", "d4": 3.0}
    assert variant.levels == {"mass": "high", "fingers": "two", "planner": "prm"}
    assert {role: component.id for role, component in variant.components.items()} == {
        "gripper": "large",
        "planner": "prm",
    }
    assert sources(variant) == {
        "design.d1": 0.2,
        "design.d2": 2,
        "design.d3": "PRM",
        "design.d4": 3.0,
        "component.gripper.cost": 2.0,
        "component.gripper.force": 10.0,
        "component.planner.cost": 0.0,
    }


def test_the_digest_is_that_of_the_content_written_out(project):
    text = (
        '{"components":{"gripper":{"geometry":"scenes/grippers/small.yaml","id":"small","values":{"cost":1.0,"force":5.0}},'
        '"planner":{"geometry":"","id":"rrt","values":{"cost":0.0}}},"parameters":{"d1":0.1,"d2":2,"d3":"RRT","d4":3.0}}'
    )
    assert json.loads(text)["parameters"]["d1"] == 0.1
    assert project.load().variant(1).digest == hashlib.sha256(text.encode()).hexdigest()


def test_the_digest_follows_content_and_not_prose_or_position(project):
    before = project.load().variant(5).digest
    project.change("rationale: Invented.", "rationale: Told by a friend.").change("0.1 kg", "300 g")
    changed = project.load()
    assert changed.variant(5).digest == before
    project.change("0.01 kN", "11 N")
    assert project.load().variant(5).digest != before


@pytest.mark.parametrize("seed", ["0", "7"])
def test_digests_do_not_depend_on_the_process(project, seed):
    here = [variant.digest for variant in project.load().expand()]
    program = (
        "import sys; from pathlib import Path; from rgss.designs import *; folder = Path(sys.argv[1])\n"
        "space = load_design_space(folder / 'space.yaml', load_catalogue(folder / 'catalogue.yaml'))\n"
        "print(*(variant.digest for variant in space.expand()))"
    )
    environment = {**os.environ, "PYTHONHASHSEED": seed}
    command = [sys.executable, "-c", program, str(project.folder)]
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert result.stdout.split() == here


def test_numbers_are_written_so_that_they_read_back(project):
    project.change("0.1 kg", "0.30000000000000004 kg").change("100 g", "0.30000000000000004 kg")
    assert ",0.30000000000000004," in variants_csv(project.load().expand())


def test_no_variants_make_an_empty_table():
    assert variants_csv([]) == ""


def test_an_unknown_variant_is_refused_with_the_known_range(project):
    with pytest.raises(DefinitionError) as caught:
        project.load().variant(9)
    assert str(caught.value) == "unknown variant 9 (ids of variants: from 1 to 8)"


def test_a_space_without_factors_has_one_variant(project):
    head, _, _ = project.space_text.partition("factors:")
    project.space_text = head.replace("d4: 3 N", "d4: 3 N\n  d1: 100 g\n  d2: 2\n  d3: RRT")
    (variant,) = project.load().expand()
    assert (variant.id, variant.levels) == (1, {})


def test_files_are_named_by_their_path_without_a_label(project, tmp_path):
    project.load()
    catalogue = load_catalogue(tmp_path / "catalogue.yaml")
    assert catalogue.document.label == str(tmp_path / "catalogue.yaml")
    assert load_design_space(tmp_path / "space.yaml", catalogue).expand() == project.load().expand()
