"""Suppositions, against a project whose files say what is supposed."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose, trade_problem
from rgss.decision.what_if import Change, measured_in, suppose
from rgss.errors import DefinitionError, EvidenceError, TradeoffError
from rgss.scenes.uncertainty import Case, Workload
from rgss.studies.project import load_project
from rgss.tradeoff import CriterionNode, ElicitedInterval, RequirementAnchor

CATALOGUE, STUDY = "designs/catalogue.yaml", "studies/pick_place.yaml"


@pytest.fixture(scope="module")
def store(shipped, filled, record_of):
    return filled(
        shipped, lambda spec: record_of(spec, planning_s=0.2 * (1 + spec.variant % 7), path_m=0.4 + 0.01 * spec.seed)
    )


@pytest.fixture(scope="module")
def measured(shipped, store):
    return measure_variants(shipped, store)


@pytest.fixture
def supposed(shipped, measured):
    """The trade-off under suppositions."""

    def build(*texts):
        scenario = suppose(shipped, texts)
        return scenario, trade_problem(scenario.project, measured_in(scenario, measured))

    return build


def weights_of(problem):
    return dict(problem.weighting.weights)


def test_a_weight_and_the_others_scaled(supposed):
    scenario, problem = supposed("weight.t_e=0.4")

    assert weights_of(problem) == pytest.approx(
        {"P_max": 0.25 * 0.75, "C_total": 0.25 * 0.75, "t_e": 0.4, "t_p": 0.1 * 0.75, "S": 0.2 * 0.75}
    )
    assert scenario.changes == (Change(id="weight.t_e", before=0.2, after=0.4, unit="1"),)
    assert [change.id for change in scenario.rescaled] == ["weight.P_max", "weight.C_total", "weight.t_p", "weight.S"]


def test_two_weights_and_a_percentage(supposed):
    _, problem = supposed("weight.t_e=40 %", "weight.t_p = 0.1")

    assert weights_of(problem) == pytest.approx(
        {"P_max": 0.25 / 0.7 * 0.5, "C_total": 0.25 / 0.7 * 0.5, "t_e": 0.4, "t_p": 0.1, "S": 0.2 / 0.7 * 0.5}
    )


def test_all_weights_and_one_of_everything(supposed):
    _, problem = supposed("weight.P_max=0.1", "weight.C_total=0.2", "weight.t_e=0.3", "weight.t_p=0.4", "weight.S=0")
    assert weights_of(problem) == pytest.approx({"P_max": 0.1, "C_total": 0.2, "t_e": 0.3, "t_p": 0.4, "S": 0.0})
    _, problem = supposed("weight.C_total=1")
    assert weights_of(problem) == pytest.approx({"P_max": 0.0, "C_total": 1.0, "t_e": 0.0, "t_p": 0.0, "S": 0.0})


def grouped(project, intervals=()):
    """The study with its two times under one criterion."""
    times = CriterionNode(
        name="time",
        weight=0.3,
        members=(CriterionNode(name="t_e", weight=2 / 3), CriterionNode(name="t_p", weight=1 / 3)),
    )
    others = [CriterionNode(name=name, weight=weight) for name, weight in (("P_max", 0.25), ("C_total", 0.25))]
    criteria = (*others, times, CriterionNode(name="S", weight=0.2))
    trade_off = replace(project.study.trade_off, criteria=criteria, intervals=tuple(intervals))
    return replace(project, study=replace(project.study, trade_off=trade_off))


def test_the_weight_of_a_group(shipped):
    scenario = suppose(grouped(shipped), ["weight.time=0.6"])

    assert scenario.changes == (Change(id="weight.time", before=0.3, after=0.6, unit="1"),)
    assert dict(scenario.project.study.trade_off.weighting.weights) == pytest.approx(
        {"P_max": 0.25 * 4 / 7, "C_total": 0.25 * 4 / 7, "t_e": 0.4, "t_p": 0.2, "S": 0.2 * 4 / 7}
    )


def test_a_group_and_its_member(shipped):
    with pytest.raises(DefinitionError, match=r"weight.t_e and weight.time both are of t_e \(name one\)"):
        suppose(grouped(shipped), ["weight.time=0.6", "weight.t_e=0.1"])


def test_a_weight_outside_of_what_was_elicited(shipped):
    bounded = grouped(shipped, [ElicitedInterval(name="t_e", measures=("t_e",), least=0.1, most=0.3)])

    with pytest.raises(TradeoffError, match=r"the weight of 't_e' is 0.4, outside of its bounds 0.1 to 0.3"):
        suppose(bounded, ["weight.t_e=0.4"])


def test_a_threshold_as_the_file_would_have_it(supposed, folder, edit, store, place_of):
    file = place_of_requirement(folder, 'threshold: "0.8 kg"')
    edit(file, 'threshold: "0.8 kg"', 'threshold: "1000 g"')
    edit(file, "at least 0.8 kg", "at least 1000 g")
    edited = load_project(folder)
    scenario, problem = supposed("SYS-012.threshold=1000 g")

    assert scenario.changes == (Change(id="SYS-012.threshold", before=0.8, after=1.0, unit="kg"),)
    assert problem.thresholds == trade_problem(edited, measure_variants(edited, store)).thresholds
    assert choose(edited, measure_variants(edited, store)).conflicts is None


def place_of_requirement(folder, text):
    """The file, relative to the project, that holds a text of a system requirement."""
    (found,) = [
        path.relative_to(folder).as_posix()
        for path in sorted((folder / "requirements").rglob("*.yaml"))
        if text in path.read_text(encoding="utf-8")
    ]
    return found


def test_a_cost_as_the_catalogue_would_have_it(supposed, folder, edit, store):
    """Costs are no part of a trial, so the same evidence serves both."""
    edit(CATALOGUE, "value: 3900 USD", "value: 6000 USD")
    edited = load_project(folder)
    expected = trade_problem(edited, measure_variants(edited, store))
    scenario, problem = supposed("catalogue.kg-2-standard.cost=6000 USD")

    assert problem.alternatives == expected.alternatives
    assert (scenario.dropped, scenario.simulated) == ((), ())


def test_a_constant_as_the_measures_would_have_it(supposed, folder, edit, store):
    """It changes estimates over trials too, interval and all."""
    edit("requirements/measures.yaml", "value: 48 mm", "value: 120 mm")
    edited = load_project(folder)
    expected = measure_variants(edited, store)
    scenario, problem = supposed("measures.d_f=120 mm")

    assert problem.alternatives == trade_problem(edited, expected).alternatives
    assert scenario.changes[0].unit == "m"


def test_an_anchor_as_the_study_would_have_it(supposed, folder, edit, store):
    edit(STUDY, "worst: 25 s", "worst: 40 s")
    edited = load_project(folder)
    scenario, problem = supposed("value.t_e.worst=40 s")

    assert problem.value_functions == trade_problem(edited, measure_variants(edited, store)).value_functions
    assert scenario.project.study.values == edited.study.values
    assert scenario.changes == (Change(id="value.t_e.worst", before=25.0, after=40.0, unit="s"),)


def test_an_anchor_on_a_requirement_moves_with_it(shipped):
    """Where the file anchors a value on a threshold, supposing another threshold moves the value."""
    trade_off = shipped.study.trade_off
    anchored = tuple(
        replace(valued, worst=RequirementAnchor(requirement="SYS-004", times=1.0))
        if valued.measure == "C_total"
        else valued
        for valued in trade_off.valued
    )
    project = replace(shipped, study=replace(shipped.study, trade_off=replace(trade_off, valued=anchored)))
    scenario = suppose(project, ["SYS-004.threshold=42000 USD"])

    assert next(one.worst for one in scenario.project.study.values if one.measure == "C_total") == pytest.approx(42e3)


def test_several_suppositions_at_once(supposed):
    scenario, problem = supposed("weight.S=0.5", "SYS-012.threshold=0.9 kg", "catalogue.ur10.cost=30000 USD")

    assert [change.id for change in scenario.changes] == ["weight.S", "SYS-012.threshold", "catalogue.ur10.cost"]
    assert problem.weighting.weights["S"] == 0.5
    assert {threshold.value for threshold in problem.thresholds if threshold.requirement == "SYS-012"} == {0.9}


def test_what_trials_were_simulated_with_is_said(shipped):
    scenario = suppose(shipped, ["catalogue.ka-58.mass=60 g", "catalogue.ka-58.cost=500 USD"])

    assert scenario.simulated == ("catalogue.ka-58.mass",)


def test_a_rule_that_would_drop_variants(shipped, measured):
    """Three fingers of 10 N exceed a gripper that bears 25 N."""
    scenario = suppose(shipped, ["catalogue.kg-3-light.max_force=25 N"])
    light = {entry.variant.id for entry in measured if entry.variant.components["gripper"].id == "kg-3-light"}

    assert set(scenario.dropped) == light
    assert {entry.variant.id for entry in measured_in(scenario, measured)} == {*range(1, 73)} - light


def test_a_rule_that_would_drop_all(shipped):
    with pytest.raises(DefinitionError, match="would then allow no variant"):
        suppose(shipped, ["catalogue.ka-58.force=5 N"])


def test_variants_that_would_become_possible_have_no_trials(shipped):
    barred = suppose(shipped, ["catalogue.kg-3-light.max_force=25 N"]).project

    with pytest.raises(EvidenceError, match=r"would become possible, and no trial was run with them \(change the cat"):
        suppose(barred, ["catalogue.kg-3-light.max_force=40 N"])


@pytest.mark.parametrize(
    ("texts", "message", "hint"),
    [
        (["weight.t_x=0.4"], "unknown input 'weight.t_x'", "did you mean weight.t_p"),
        (["weight.t_e=1.4"], "weight.t_e must be from 0 to 1, got 1.4", "give a share of the whole"),
        (["weight.t_e=-0.1"], "weight.t_e must be from 0 to 1, got -0.1", "give a share of the whole"),
        (["weight.t_e=0.4 kg"], "weight.t_e: '0.4 kg' has a unit", "write 0.4"),
        (["weight.t_e=much"], "weight.t_e: 'much' is not a quantity", "write a number"),
        (["weight.t_e=0.7", "weight.t_p=0.4"], "the weights that are given sum to 1.1", "sum to at most 1"),
        (["weight.t_e=0.4", "weight.t_e=0.5"], "weight.t_e is supposed twice", "suppose it once"),
        (["shape.P_min=2"], "unknown input 'shape.P_min'", "did you mean shape.P_max"),
        (["shape.t_p=2 s"], "shape.t_p: '2 s' has a unit", "write 2"),
        (["shape.t_p=-101"], "curvature of the value of 't_p' must be from -100 to 100, got -101", "a step"),
        (["shape.all=1", "shape.t_p=2"], "the value of t_p is bent twice", "shape.all or curvatures of single"),
        (["SYS-12.threshold=1 kg"], "unknown input 'SYS-12.threshold'", "did you mean SYS-012.threshold"),
        (["SYS-001.threshold=1 kg"], "unknown input 'SYS-001.threshold'", "did you mean SYS-0"),
        (["SYS-012.threshold=1 s"], "unit 's' does not measure what 'kg' measures", "give it in kg"),
        (["SYS-012.threshold=1"], "'1' has no unit", 'write "1 kg"'),
        (["value.t_e.target=3 s"], "unknown input 'value.t_e.target'", "did you mean"),
        (["value.t_e.worst=5 s"], "has no range", ""),
        (["catalogue.kg-2.cost=3 USD"], "unknown input 'catalogue.kg-2.cost'", "did you mean catalogue.k"),
        (["catalogue.ur10.cost=-3 USD"], "catalogue.ur10.cost must be at least 0, got -3", "give a number such as 0"),
        (["measures.d_g=3 mm"], "unknown input 'measures.d_g'", "did you mean measures.d_f"),
        (["nonsense.of.all=3"], "unknown input 'nonsense.of.all'", "such as weight, value, catalogue"),
        (
            ["planning.planner=RRT"],
            "planning.planner: designs set it, and it cannot be supposed for all",
            "rgss variants",
        ),
        (
            ["gripper.actuator.mass=1 kg"],
            "designs take it from mass of their finger_actuator",
            "catalogue.COMPONENT.mass",
        ),
        (
            ["robot.tool_acceleration=1 m/s^2"],
            "robot.tool_acceleration: no design sets it; its value is that of tool_acceleration in the robot file",
            "'sets: robot.tool_acceleration'",
        ),
        (["nonsense"], "must be NAME=VALUE, got 'nonsense'", "write weight.t_p=0.4"),
        (["=3"], "must be NAME=VALUE, got '=3'", "write weight.t_p=0.4"),
        (["weight.t_e="], "must be NAME=VALUE, got 'weight.t_e='", "write weight.t_p=0.4"),
        (["weight\n.t_e"], "must be NAME=VALUE, got", "write weight.t_p=0.4"),
    ],
)
def test_what_cannot_be_supposed(shipped, measured, texts, message, hint):
    def decide():
        scenario = suppose(shipped, texts)
        return choose(scenario.project, measured_in(scenario, measured))

    with pytest.raises((DefinitionError, TradeoffError)) as caught:
        decide()
    assert message in caught.value.message
    assert hint in caught.value.hint
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", ["workload=cup", "workload.cup.mass=1 kg"])
def test_a_study_without_a_workload_says_so(shipped, text):
    assert not shipped.workload.cases
    with pytest.raises(DefinitionError, match=r"workload\S*: the study has no workload \(state its cases under"):
        suppose(shipped, [text])


def test_a_workload_that_a_nominal_study_leaves_aside_is_not_called_missing(shipped):
    stated = replace(shipped, study=replace(shipped.study, workload=Workload(cases=(Case(id="full", mass_kg=0.4),))))
    with pytest.raises(DefinitionError, match="a nominal study uses no workload"):
        suppose(stated.nominal(), ["workload=full"])
    assert suppose(stated.nominal(), ["uncertainty.nominal=false", "workload=full"]).project.workload.cases


def test_the_last_weights_have_no_proportions(shipped):
    only = suppose(shipped, ["weight.C_total=1"]).project

    with pytest.raises(DefinitionError, match=r"the other weights are 0 in all, so 0.5 cannot be shared in proportion"):
        suppose(only, ["weight.C_total=0.5"])
    assert suppose(only, ["weight.C_total=0.5", "weight.S=0.5"]).project.study.trade_off.weighting.weights["S"] == 0.5
    with pytest.raises(DefinitionError, match=r"given sum to 0.5 \(give weights that sum to 1, or omit one\)"):
        suppose(shipped, [f"weight.{name}=0.1" for name in ("P_max", "C_total", "t_e", "t_p", "S")])


def test_what_is_simulated_is_known_without_engines(shipped, monkeypatch):
    def refuse(purpose):
        raise DefinitionError(f"{purpose} needs engines")

    monkeypatch.setattr("rgss.trials.code.piece_versions.missing_engines", lambda: ("ompl",))
    monkeypatch.setattr("rgss.trials.code.piece_versions.require_engines", refuse)
    monkeypatch.setattr("rgss.trials.code.piece_versions._assumed", {})

    assert suppose(shipped, ["catalogue.ka-58.mass=1 kg"]).simulated == ("catalogue.ka-58.mass",)
    assert suppose(shipped, ["prices=1.5"]).simulated == ()
