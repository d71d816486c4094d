"""The chain of an id: up to the need, down to the trials and tests that decide."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from rgss.errors import DefinitionError
from rgss.measures import StaleCause, load_measures
from rgss.trace.evidence.verdict_evidence import TraceEvidence
from rgss.trace.views.chain import chain_of
from rgss.trace.views.figures import metric_in_words
from rgss.trace.views.neighbours import Relation, ThingKind


@pytest.fixture
def model(tmp_path, story):
    return story.model(story.write(tmp_path / "requirements"))


def told(steps):
    return [(step.depth, step.relation.value, step.id) for step in steps]


def test_a_requirement_up_to_the_need_and_down_to_the_trials(model, story):
    chain = chain_of(model, story.evidence(), "SYS-1")

    assert (chain.kind, chain.text) == (ThingKind.REQUIREMENT, "The gripper shall lift at least 0.8 kg.")
    assert chain.note == "met by variant 7; asked for: P >= 800 g"
    assert told(chain.up) == [(1, "derives from", "STK-1")]
    assert told(chain.down) == [
        (1, "is decided by", "P"),
        (2, "is computed from", "P_g"),
        (2, "is observed in", story.KEYS[1]),
        (2, "is observed in", story.KEYS[2]),
        (1, "is the origin of", "SYS-2"),
        (2, "is verified by", story.TESTS["SYS-2"][0]),
        (2, "is satisfied by", "BLK-finger"),
        (1, "contains", "SYS-2"),
        (1, "is traced to by", "SYS-3"),
        (1, "is satisfied by", "BLK-gripper"),
        (1, "is satisfied by", "ACT-lift"),
    ]


def test_what_is_told_again_is_told_without_what_follows(model, story):
    chain = chain_of(model, story.evidence(), "SYS-1")

    again = {(step.relation, step.id) for step in chain.down if step.repeated}
    assert again == {(Relation.CONTAINS, "SYS-2")}


def test_trials_are_told_with_the_value_of_the_measure_and_the_command(model, story):
    chain = chain_of(model, story.evidence(), "SYS-1")
    notes = {step.id: step.note for step in chain.down}
    texts = {step.id: step.text for step in chain.down}

    assert notes["P"] == "0.865 kg (0.86 to 0.87), 2 trials"
    assert notes[story.KEYS[1]] == f"P = 0.86 kg; rgss replay {story.KEYS[1][:12]}"
    assert texts[story.KEYS[1]] == "variant 7, seed 1, contact: success"
    assert notes[story.TESTS["SYS-2"][0]] == "passed"


def test_from_the_need_down(model, story):
    chain = chain_of(model, story.evidence(), "STK-2")

    assert chain.up == ()
    assert told(chain.down) == [
        (1, "is the origin of", "SYS-3"),
        (2, "is verified by", "tests/test_x.py::t"),
        (1, "is answered by", "C"),
    ]
    assert {step.id: step.note for step in chain.down}["C"] == "38,800 USD, from the design alone"


def test_a_test_leads_up_to_the_need(model, story):
    chain = chain_of(model, story.evidence(), story.TESTS["SYS-2"][0])

    assert told(chain.up) == [
        (1, "verifies", "SYS-2"),
        (2, "derives from", "SYS-1"),
        (3, "derives from", "STK-1"),
        (2, "is contained in", "SYS-1"),
    ]
    assert chain.note == "passed"


@pytest.mark.parametrize("name", ["7/1", f"{1:064x}", "0" * 63])
def test_a_trial_leads_up_to_what_it_decides(model, name, story):
    chain = chain_of(model, story.evidence(), name)

    assert chain.kind is ThingKind.TRIAL
    assert told(chain.up)[:3] == [(1, "gives a value of", "P"), (2, "decides", "SYS-1"), (3, "derives from", "STK-1")]


def test_structure_and_behaviour(model, story):
    block = chain_of(model, story.evidence(), "BLK-gripper")
    behaviour = chain_of(model, story.evidence(), "ACT-lift")

    assert block.text == "Gripper: Grips."
    assert told(block.up) == [
        (1, "satisfies", "SYS-1"),
        (2, "derives from", "STK-1"),
        (1, "is part of", "BLK-system"),
    ]
    assert told(block.down) == [
        (1, "has the part", "BLK-finger"),
        (1, "has the kind", "BLK-hook"),
        (1, "does", "ACT-lift"),
    ]
    assert told(behaviour.up) == [
        (1, "satisfies", "SYS-1"),
        (2, "derives from", "STK-1"),
        (1, "refines", "UC-serve"),
        (2, "refines", "STK-1"),
    ]
    assert told(behaviour.down) == [(1, "is done by", "BLK-gripper")]


def test_a_stale_verdict_says_what_changed(model, story):
    evidence = story.evidence(causes=(StaleCause.REQUIREMENT,))

    assert chain_of(model, evidence, "SYS-1").note == "stale (requirement) by variant 7; asked for: P >= 800 g"


def test_without_evidence_the_links_are_told_all_the_same(model):
    chain = chain_of(model, TraceEvidence(), "SYS-1")

    assert chain.note == "not run; asked for: P >= 800 g"
    assert (1, "is decided by", "P") in told(chain.down)
    assert not [step for step in chain.down if step.kind in (ThingKind.TRIAL, ThingKind.TEST)]


def test_every_step_of_a_long_chain_is_told(tmp_path, story):
    """Deeper than a recursion may go."""
    folder = story.write(tmp_path / "requirements")
    path = folder / "system.yaml"
    entry = path.read_text(encoding="utf-8").split("  - id: SYS-4\n")[1]
    parents = ["SYS-1", *(f"S{n}" for n in range(2000))]
    entries = [f"  - id: {name}\n{entry}    derived_from: [{parent}]\n" for parent, name in pairwise(parents)]
    path.write_text(path.read_text(encoding="utf-8") + "".join(entries), encoding="utf-8")

    chain = chain_of(story.model(folder), TraceEvidence(), "S1999")

    assert len(chain.up) == 2001
    assert (chain.up[-1].depth, chain.up[-1].id) == (2001, "STK-1")


MEASURES = """\
title: T
constants:
  - {id: k, value: 2, unit: "1", definition: A factor., source: Given}
inputs:
  - {id: m, source: trial.mass_kg, unit: kg, definition: A mass.}
equations:
  - {id: "4.1", relation: "P = k m"}
assumptions:
  - {id: factor, statement: The factor is 2., rationale: Measured once., concerns: [k]}
measures:
  - id: P
    kind: moe
    name: Payload
    definition: What it carries.
    unit: kg
    expression: k * m
    equation: "4.1"
    better: higher
    traces: [STK-1]
    estimate: {statistic: mean, over: successful}
"""


@pytest.fixture
def definitions(tmp_path):
    path = tmp_path / "measures.yaml"
    path.write_text(MEASURES, encoding="utf-8")
    return load_measures(path)


@pytest.mark.parametrize(
    ("name", "kind", "text"),
    [
        ("k", ThingKind.CONSTANT, "A factor."),
        ("m", ThingKind.INPUT, "A mass. (trial.mass_kg)"),
        ("trial.mass_kg", ThingKind.SOURCE, "A mass."),
        ("4.1", ThingKind.EQUATION, "P = k m"),
        ("factor", ThingKind.ASSUMPTION, "The factor is 2."),
    ],
)
def test_what_a_measure_uses_leads_up_to_the_need(model, definitions, name, kind, text, story):
    chain = chain_of(model, story.evidence(), name, definitions=definitions)

    assert (chain.kind, chain.text) == (kind, text)
    assert told(chain.up)[:3] == [(1, "is used by", "P"), (2, "decides", "SYS-1"), (3, "derives from", "STK-1")]
    assert chain.up[0].text == "Payload"


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("SYS-11", "did you mean 'SYS-1'?"),
        ("nothing", "name one, such as SYS-1, BLK-system, P, 7/1"),
        ("000", ""),
    ],
)
def test_an_id_that_is_not_there(model, name, hint, story):
    with pytest.raises(DefinitionError) as caught:
        chain_of(model, story.evidence(), name)

    assert caught.value.message.startswith(f"{name!r} is not an id of the requirements, the architecture, the measures")
    assert hint in caught.value.hint


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("7/9", "variant 7 has trials of seeds 1 to 3; --replicates shows others"),
        ("28/1", "those of variant 7 are; --variant 28 shows those of variant 28"),
    ],
)
def test_a_trial_that_is_not_shown(model, name, hint, story):
    with pytest.raises(DefinitionError) as caught:
        chain_of(model, story.evidence(), name)

    assert (caught.value.message, caught.value.hint) == (f"trial {name} is not one of the trials shown", hint)


def test_a_trial_where_none_is_shown(model, story):
    evidence = story.evidence()
    for shown, hint in (
        (None, "no variant is shown; --variant 7 shows those of variant 7"),
        (replace(evidence.shown, trials=()), "variant 7 has no evidence of this fidelity; run 'rgss sweep' first"),
    ):
        with pytest.raises(DefinitionError) as caught:
            chain_of(model, replace(evidence, shown=shown), "7/1")
        assert caught.value.hint == hint


def test_a_trial_is_told_with_what_was_observed_of_all_that_the_measure_stands_on(model, definitions, story):
    chain = chain_of(model, story.evidence(), "SYS-1", definitions=definitions)
    (note,) = [step.note for step in chain.down if step.id == story.KEYS[1]]

    assert note == f"P = 0.86 kg; rgss replay {story.KEYS[1][:12]}; mass_kg = 0.41"


def test_rows_of_numbers_are_told_one_by_one():
    assert metric_in_words((0.5, None, 12345)) == "0.5 – 12,345"
    assert metric_in_words(None) == "–"
