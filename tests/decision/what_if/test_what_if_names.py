"""Every name of a number that the page and its document print is taken by ``--what-if``."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import trade_problem
from rgss.decision.robustness import robustness
from rgss.decision.study_decision import decide_study
from rgss.decision.what_if.numbers import model_numbers
from rgss.decision.what_if.what_if import suppose
from rgss.errors import DefinitionError
from rgss.reports.decision import decision_lines, decision_to_json
from rgss.reports.decision.json.robustness import robustness_to_json
from rgss.studies.trade_off import AnchoredEpsilonConstraint, BoundChoice, RequirementBound, RiskChoice
from rgss.studies.trade_off.demands import RiskKind
from rgss.tradeoff import Aim, Comparison

RISKS = (
    RiskChoice(kind=RiskKind.CHANCE, id="chance:SYS-005", bound=RequirementBound(requirement="SYS-005"), share=0.6),
    RiskChoice(
        kind=RiskKind.CHANCE,
        id="chance:t_p",
        bound=BoundChoice(measure="t_p", comparison=Comparison.AT_MOST, value=12.0),
        share=0.5,
    ),
    RiskChoice(kind=RiskKind.TAIL, id="tail:SYS-033", bound=RequirementBound(requirement="SYS-033"), share=0.4),
)
LIMITED = AnchoredEpsilonConstraint(
    aim=Aim(measure="P_max", sense=Comparison.AT_LEAST),
    limits=(BoundChoice(measure="t_e", comparison=Comparison.AT_MOST, value=30.0),),
)
STUDIES = {
    "as shipped": {},
    "chances and tails": {"risks": RISKS},
    "limits of a program": {"program": LIMITED},
}


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    store = filled(shipped, lambda spec: record_of(spec, planning_s=0.5 + 0.01 * spec.variant + 0.1 * spec.seed))
    return measure_variants(shipped, store)


def printed_names(project, text, document):
    """Names of numbers: of weights, demands, conflicts and assumptions, in text and document."""
    names = set(re.findall(r"(?:catalogue|measures|value|weight|chance|tail|limit)[.:][\w.:-]*\w", text))
    names |= set(re.findall(r"\bSYS-\d+\b", text))
    names |= set(document["demands"]) | set(document["robustness"]["weights"])
    names |= {one["requirement"] for one in document["robustness"]["prices"]}
    names |= {one["id"] for one in document["robustness"]["assumptions"]}
    names |= {requirement for one in document["infeasible"] for requirement in one["requirements"]}
    # The conclusion names requirements that trials do not decide too.
    without_limit = {one.id for one in project.requirements.system if one.criterion is None}
    return {name for name in names - without_limit if not name.startswith("evidence:")}


def test_a_requirement_without_a_limit_is_told(shipped):
    with pytest.raises(DefinitionError) as caught:
        suppose(shipped, ["SYS-011=1"])

    assert str(caught.value) == (
        "--what-if: SYS-011 has no limit to suppose (what has one names its measure under 'criterion')"
    )


@pytest.mark.parametrize("study", STUDIES)
def test_every_printed_name_is_taken(monkeypatch, shipped, measured, study):
    monkeypatch.setattr(robustness, "ITERATIONS", 100)
    trade_off = replace(shipped.study.trade_off, **STUDIES[study])
    project = replace(shipped, study=replace(shipped.study, trade_off=trade_off))
    made = decide_study(project, measured, evidence="evidence.sqlite")
    document = {**decision_to_json(made.decision), "robustness": robustness_to_json(made.robustness.analysis)}
    names = printed_names(project, "\n".join(decision_lines(made)), document)
    numbers = {number.id: number for number in model_numbers(project)}
    demands = {one.requirement: one for one in trade_problem(project, measured).conditions}

    assert {"SYS-005", "t_e"} <= names
    assert {one.id for one in trade_off.risks} <= names
    for name in names:
        if name in numbers:
            text, unit = f"{numbers[name].value * 1.01!r}", numbers[name].unit
        elif name in demands:
            text, unit = f"{demands[name].value * 1.01!r}", demands[name].unit
        elif name.startswith("value."):
            _, measure, end = name.split(".")
            (valued,) = (one for one in project.study.values if one.measure == measure)
            text, unit = f"{getattr(valued, end) * 1.01!r}", project.measures.measure(measure).unit
        else:
            text, unit = "0.3", "1"
        scenario = suppose(project, [f"{name}={text} {unit if unit != '1' else ''}".rstrip()])
        (change,) = scenario.changes
        assert change.id.startswith(name) or change.id == f"weight.{name}"
        assert change.after != change.before or change.before == 0.0, name
        # The change is in the trade-off that is decided, not only in the list of changes.
        assert scenario.project != project or change.before == change.after, name


def decided(project, measured, *texts):
    return trade_problem(suppose(project, texts).project, measured)


def test_demands_of_the_study(shipped, measured):
    trade_off = replace(shipped.study.trade_off, risks=RISKS, program=LIMITED)
    project = replace(shipped, study=replace(shipped.study, trade_off=trade_off))
    problem = decided(
        project,
        measured,
        "tail:SYS-033=9 s",
        "chance:SYS-005.probability=65 %",
        "tail:SYS-033.worst_share=0.5",
        "limit:t_e.threshold=20 s",
    )
    by_id = {one.requirement: one for one in problem.conditions}

    assert (by_id["tail:SYS-033"].value, by_id["tail:SYS-033"].share) == (9.0, 0.5)
    assert by_id["SYS-033"].value == 15.0
    assert by_id["chance:SYS-005"].probability == 0.65
    assert by_id["limit:t_e"].value == 20.0
    # What takes over a requirement's threshold moves with it.
    moved = {one.requirement: one.value for one in decided(project, measured, "SYS-033=10 s").conditions}
    assert (moved["SYS-033"], moved["tail:SYS-033"]) == (10.0, 10.0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("tail:SYS-033.worst_share=0", "must be above 0 and below 1, got 0"),
        ("chance:SYS-005.probability=120 %", "must be above 0 and below 1, got 1.2"),
        ("chance:SYS-005.probability=1", "must be above 0 and below 1, got 1"),
        ("tail:SYS-034=9 s", "unknown input 'tail:SYS-034'"),
        ("tail:SYS-033=9 kg", "tail:SYS-033.threshold"),
        ("evidence:t_p=3", "requires that a measure is known, and has no threshold to suppose"),
        ("tail:SYS-033=9 s", None),
    ],
)
def test_what_is_refused(shipped, text, message):
    project = replace(shipped, study=replace(shipped.study, trade_off=replace(shipped.study.trade_off, risks=RISKS)))
    if message is None:
        with pytest.raises(DefinitionError, match="supposed twice"):
            suppose(project, [text, "tail:SYS-033.threshold=8 s"])
        return
    with pytest.raises(DefinitionError, match=re.escape(message)):
        suppose(project, [text])
