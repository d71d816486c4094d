"""The digest of a measure changes with all that it is computed from, and with nothing else."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.errors import DefinitionError
from rgss.measures import definition_digest, load_measures

SOURCE = (Path(__file__).parents[2] / "requirements" / "measures.yaml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def digests(tmp_path_factory):
    """The digest of each measure of the shipped file, with some text in it replaced."""
    folder = tmp_path_factory.mktemp("measures")

    def read(old: str = "", new: str = ""):
        assert SOURCE.count(old) == 1 or not old, f"{old!r} is not there exactly once"
        path = folder / "measures.yaml"
        path.write_text(SOURCE.replace(old, new) if old else SOURCE, encoding="utf-8")
        measures = load_measures(path)
        return {measure.id: definition_digest(measures, measure.id) for measure in measures.measures}

    return read


def changed(digests, old, new):
    before, after = digests(), digests(old, new)
    assert before.keys() == after.keys()
    return {name for name, digest in before.items() if after[name] != digest}


def test_digests_are_of_their_own_and_repeatable(digests):
    first = digests()

    assert first == digests()
    assert len(set(first.values())) == len(first)
    assert all(len(digest) == 64 for digest in first.values())


def test_a_constant_reaches_all_above_it(digests):
    touched = changed(digests, "value: 48 mm", "value: 49 mm")

    assert {"t_gc", "t_e"} <= touched
    assert not {"P_max", "C_total", "S", "t_p"} & touched


def test_the_source_of_an_input_reaches_all_above_it(digests):
    touched = changed(digests, "source: component.gripper.cost", "source: component.planner.cost")

    assert touched == {"C_g", "C_total"}


def test_words_of_a_definition_count(digests):
    assert "t_e" in changed(digests, "Travel of a finger in one grasp cycle.", "Travel of a finger each way.")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("title: Measures of the grasping system", "title: Measures"),
        ("# Design\n", "# The design\n"),
        ("Travel of a finger in one grasp cycle.", "Travel of a finger\n      in one grasp cycle."),
        ("value: 48 mm\n    unit: m", "value: 0.048 m\n    unit: mm"),
        ("rationale: >-\n      With one 10 N for every design,", "rationale: >-\n      With 10 N for every design,"),
    ],
)
def test_what_is_no_definition_changes_nothing(digests, old, new):
    assert changed(digests, old, new) == set()


def test_a_measure_that_is_not_there(digests, tmp_path):
    path = tmp_path / "measures.yaml"
    path.write_text(SOURCE, encoding="utf-8")
    with pytest.raises(DefinitionError, match="no measure 'x' is defined"):
        definition_digest(load_measures(path), "x")
