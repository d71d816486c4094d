"""Every example of docs/trade_off.md loads, and decides."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose
from rgss.decision.portfolios import choose_portfolio
from rgss.studies.study import read_study
from rgss.tradeoff import DecisionStatus

PAGE = (Path(__file__).parents[2] / "docs" / "trade_off.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"^```yaml\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
STUDY = "studies/pick_place.yaml"


def test_the_page_has_an_example_of_every_construct():
    keys = {
        *("worst", "best", "between", "halfway", "target", "times", "weight", "points", "rank", "criterion"),
        *("weight_between", "weight_order", "chance", "tail", "practical_margin", "choose", "portfolio", "member"),
    }
    assert {key for key in keys if not any(f"{key}:" in example for example in EXAMPLES)} == set()
    programs = re.findall(r"program: (\w+)", PAGE)
    assert set(programs) == {"additive", "lexicographic", "epsilon_constraint", "tchebycheff", "minimax_regret"}


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    """Every variant with evidence made without a simulation."""

    def record_for(spec):
        return record_of(
            spec,
            planning_s=0.1 * (1 + (spec.variant + spec.seed) % 7),
            path_m=0.4 + 0.01 * (spec.variant % 11) + 0.02 * spec.seed,
        )

    return measure_variants(shipped, filled(shipped, record_for))


@pytest.mark.parametrize("example", EXAMPLES, ids=range(len(EXAMPLES)))
def test_an_example(shipped, measured, tmp_path, example):
    text = (shipped.folder / STUDY).read_text(encoding="utf-8")
    section = re.search(r"^trade_off:\n(?:[ #].*\n|\n)*", text, re.MULTILINE)[0]
    (tmp_path / "study.yaml").write_text(text.replace(section, example + "\n"), encoding="utf-8")
    study = read_study(
        tmp_path / "study.yaml",
        shipped.measures,
        project=shipped.folder,
        label=STUDY,
        requirements=shipped.requirements,
    )
    project = replace(shipped, study=study)
    decision = choose(project, measured)

    assert decision.status is DecisionStatus.OPTIMAL
    assert decision.certificate.enumeration_agrees
    if study.trade_off.portfolio is not None:
        portfolio = choose_portfolio(
            project, {one.study: (project, measured) for one in study.trade_off.portfolio.studies}
        )
        assert portfolio.members
