"""What a change to an id would touch."""

from __future__ import annotations

import pytest

from rgss.errors import DefinitionError
from rgss.measures import Verdict, load_measures
from rgss.trace.evidence.verdict_evidence import TraceEvidence
from rgss.trace.views.impact import TouchedVerdict, impact_of


@pytest.fixture
def model(tmp_path, story):
    return story.model(story.write(tmp_path / "requirements"))


def test_a_need(model, story):
    impact = impact_of(model, story.evidence(), "STK-1")

    assert impact.requirements == ("SYS-1", "SYS-2", "SYS-3")
    assert impact.needs == ()
    assert set(impact.elements) == {"BLK-gripper", "ACT-lift", "BLK-finger", "UC-serve"}
    assert impact.measures == ("P",)
    assert impact.verdicts == (
        TouchedVerdict(requirement="SYS-1", verdict=Verdict.MET, variants=3),
        TouchedVerdict(requirement="SYS-2", verdict=Verdict.MET, variants=0),
        TouchedVerdict(requirement="SYS-3", verdict=Verdict.NOT_RUN, variants=0),
    )
    assert impact.trials == (story.KEYS[1], story.KEYS[2])
    assert impact.tests == (story.TESTS["SYS-2"][0], story.TESTS["SYS-3"][0])


def test_a_requirement_in_the_middle_leaves_alone_what_stands_above(model, story):
    impact = impact_of(model, story.evidence(), "SYS-2")

    assert (impact.requirements, impact.elements, impact.measures, impact.trials) == ((), ("BLK-finger",), (), ())
    assert impact.needs == ("STK-1",)
    assert [one.requirement for one in impact.verdicts] == ["SYS-2"]
    assert impact.tests == (story.TESTS["SYS-2"][0],)


def test_an_element_touches_whether_requirements_are_fulfilled(model, story):
    impact = impact_of(model, story.evidence(), "BLK-gripper")

    assert impact.elements == ("BLK-finger", "BLK-hook", "ACT-lift")
    assert impact.requirements == ("SYS-1", "SYS-2")
    assert impact.needs == ("STK-1",)
    assert impact.trials == (story.KEYS[1], story.KEYS[2])


def test_a_measure_touches_what_is_computed_from_it_and_what_it_decides(model, story):
    impact = impact_of(model, story.evidence(), "P_g")

    assert impact.measures == ("P",)
    assert (impact.requirements, impact.needs) == (("SYS-1",), ("STK-1",))
    assert [one.requirement for one in impact.verdicts] == ["SYS-1"]


def test_a_test_touches_the_verdict_that_it_is_for(model, story):
    impact = impact_of(model, story.evidence(), story.TESTS["SYS-2"][0])

    assert [one.requirement for one in impact.verdicts] == ["SYS-2"]
    assert (impact.tests, impact.measures, impact.elements) == ((), (), ())


def test_a_trial_touches_the_measures_that_it_gives_a_value(model, story):
    impact = impact_of(model, story.evidence(), "7/3")

    assert impact.measures == ("P_g", "P")
    assert impact.trials == (story.KEYS[3],)
    assert [one.requirement for one in impact.verdicts] == ["SYS-1"]


def test_callers_of_a_behaviour_are_touched(tmp_path, story):
    calls = "ACT-lift, name: Lift, kind: activity, allocated_to: [BLK-gripper], refines: [UC-serve], text: Lifts.}"
    flow = """
  - id: ACT-serve
    name: Serve
    kind: activity
    text: Serves.
    flow:
      nodes:
        - {id: start, kind: initial}
        - {id: lift, kind: action, text: Lift., does: ACT-lift}
        - {id: end, kind: final}
      edges:
        - {source: start, target: lift}
        - {source: lift, target: end}"""
    folder = story.write(tmp_path / "requirements", {"architecture.yaml": {calls: calls + flow}})

    assert impact_of(story.model(folder), story.evidence(), "ACT-lift").elements == ("ACT-serve",)


def test_reviews_that_rest_on_it_have_to_be_renewed(tmp_path, story):
    folder = story.write(tmp_path / "requirements")
    digest = "0" * 64
    (folder / "reviews.yaml").write_text(
        "reviews:\n"
        f"  STK-1: {{digest: '{digest}', upstream: {{}}, reviewer: A}}\n"
        f"  SYS-1: {{digest: '{digest}', upstream: {{STK-1: '{digest}'}}, reviewer: A}}\n"
        f"  SYS-3: {{digest: '{digest}', upstream: {{STK-2: '{digest}'}}, reviewer: A}}\n",
        encoding="utf-8",
    )

    assert impact_of(story.model(folder), story.evidence(), "STK-1").reviews == ("STK-1", "SYS-1")


def test_without_evidence_verdicts_are_named_all_the_same(model):
    impact = impact_of(model, TraceEvidence(), "SYS-1")

    assert [(one.requirement, one.verdict) for one in impact.verdicts] == [
        ("SYS-1", Verdict.NOT_RUN),
        ("SYS-2", Verdict.NOT_RUN),
        ("SYS-3", Verdict.NOT_RUN),
    ]
    assert (impact.trials, impact.tests) == ((), ())


def test_a_symbol_touches_the_measures_that_use_it(model, tmp_path, story):
    path = tmp_path / "measures.yaml"
    measure = """\
  - id: {id}
    kind: {kind}
    name: N
    definition: D.
    unit: kg
    expression: {expression}
    better: higher
    {more}
"""
    path.write_text(
        "title: T\nconstants:\n  - {id: k, value: 2 kg, unit: kg, definition: A mass., source: Given}\nmeasures:\n"
        + measure.format(id="P_g", kind="mop", expression="k", more="contributes_to: [P]")
        + measure.format(id="P", kind="moe", expression="P_g", more="traces: [STK-1]")
        + measure.format(id="C", kind="moe", expression="1 * k", more="traces: [STK-2]")
        + measure.format(id="x", kind="supplementary", expression="C", more="traces: []"),
        encoding="utf-8",
    )
    definitions = load_measures(path)

    assert impact_of(model, story.evidence(), "k", definitions=definitions).measures == ("P_g", "P", "C", "x")
    assert impact_of(model, story.evidence(), "C", definitions=definitions).measures == ("x",)


def test_an_id_that_is_not_there(model, story):
    with pytest.raises(DefinitionError, match="'SYS-9' is not an id"):
        impact_of(model, story.evidence(), "SYS-9")
