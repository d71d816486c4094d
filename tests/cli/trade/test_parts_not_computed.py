"""Parts of the trade-off's page that were not computed."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose, trade_problem
from rgss.decision.robustness import robustness
from rgss.decision.robustness.effect_findings import StudyEffects
from rgss.decision.robustness.parts import NotComputed, Part
from rgss.decision.robustness.robustness import analyse_robustness
from rgss.decision.study_decision.deciding import Choice, study_decision
from rgss.errors import TradeoffError
from rgss.evidence import EvidenceStore
from rgss.reports.decision.markdown import END, decision_section
from rgss.reports.decision.text import robustness_lines
from rgss.studies.project import load_project
from rgss.tradeoff.robustness.pareto import ParetoFront

EMPTY = {
    Part.PARETO: ("Pareto front: not computed.", {"front": ParetoFront(points=())}),
    Part.REGIONS: ("Not computed: regions of weights", {"regions": None}),
    Part.NEAREST: ("Weights: the nearest that change the choice were not computed.", {"shifts": None}),
    Part.RANGES: ("Range of each weight: not computed.", {"ranges": None}),
    Part.ACCEPTABILITY: ("Acceptability and confidence: not computed.", {"acceptability": None}),
    Part.ASSUMPTIONS: ("Assumptions: not computed.", {"assumptions": ()}),
    Part.COSTS: ("All assumed costs of components together: not computed.", {"costs": None}),
    Part.PRICES: ("Price of each requirement: not computed.", {"prices": ()}),
    Part.REVERSALS: ("Rank reversal: not computed.", {"reversals": ()}),
    Part.STRETCHED: ("Of values stretched over the sample it was not computed.", {"stretched": ()}),
    Part.EFFECTS: (
        "Not computed: effects of the factors",
        {"effects": StudyEffects(factors=(), constants=(), measures=())},
    ),
}


@pytest.fixture(scope="module")
def analysed(with_evidence):
    project = load_project(with_evidence)
    with EvidenceStore.open(project.evidence, create=False, label="evidence") as store:
        measured = measure_variants(project, store)
    problem = trade_problem(project, measured)
    decision = choose(project, measured, problem=problem)

    choice = Choice(project=project, measured=measured, problem=problem, decision=decision)

    def made(found):
        return study_decision(choice, found, evidence="evidence")

    found = analyse_robustness(project, measured, decision, problem=problem)
    return made, found, frozenset(robustness_lines(made(found)))


@pytest.mark.parametrize("part", EMPTY, ids=lambda part: part.name)
def test_a_part_that_is_not_computed(analysed, part):
    """Its place says so, reason and remedy are given once, and the rest of the page and section is the same."""
    made, found, whole = analysed
    said, fields = EMPTY[part]
    inner = {name: value for name, value in fields.items() if not hasattr(found, name)}
    less = replace(
        found,
        weighting=replace(found.weighting, **inner),
        not_computed={part: NotComputed(reason="the solver gave no answer", remedy="ask for less")},
        **{name: value for name, value in fields.items() if name not in inner},
    )
    page = made(less)
    lines = list(robustness_lines(page))
    section = decision_section(page).splitlines()

    assert any(said in line for line in lines)
    (line,) = [one for one in lines if one.startswith("Not computed: ")]
    assert line == f"Not computed: {part.words}: the solver gave no answer. Remedy: ask for less."
    assert line in section
    assert section[-1] == END
    assert len(whole & set(lines)) > 0.5 * len(whole)


def test_what_is_not_computed_is_a_finding(monkeypatch, rgss, with_little_evidence, tmp_path):
    def fail(*_, **__):
        raise TradeoffError("the solver gave no answer", hint="ask for less")

    for name in ("smaa2", "winning_regions", "study_effects"):
        monkeypatch.setattr(robustness, name, fail)
    told = rgss("trade", "--effects", "--project", with_little_evidence)
    report = rgss("report", "--no-film", "--out", tmp_path / "report.html", "--project", with_little_evidence)
    line = (
        "Not computed: regions of weights, acceptability and confidence, effects of the factors: the solver gave no "
        "answer. Remedy: ask for less."
    )

    assert (told.status, told.errors) == (1, "")
    assert (report.status, report.errors) == (1, "")
    assert line in told.output
    assert line in report.output
    assert line in (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Certificate: optimal" in told.output
