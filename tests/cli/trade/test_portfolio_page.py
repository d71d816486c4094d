"""A portfolio on the page: proven, best found or undecided, its exit status, and its time limit."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace

import pytest

from rgss.api.trade_frames import portfolio_frame
from rgss.decision.study_decision import is_settled
from rgss.reports.decision.json import portfolio_to_json
from rgss.reports.decision.report_part import portfolio_sentence
from rgss.reports.decision.text import certificate_lines, portfolio_lines
from rgss.tradeoff import Agreement, Assignment, Check, CheckKind, Cut, DecisionStatus
from rgss.tradeoff.portfolio import PortfolioDecision

PROVEN = PortfolioDecision(
    status=DecisionStatus.OPTIMAL,
    members=("7",),
    assignments=(Assignment(task="s.yaml", member="7", variant=7, value=0.8),),
    objective=0.8,
    by_size=(0.8,),
    by_size_gap=(0.0,),
    unserved=(),
    gap=0.0,
    objective_recomputed=0.8,
    considered=3,
    enumeration_agrees=Agreement.AGREED,
    checks=(),
    cut=None,
)
FOUND = dataclasses.replace(
    PROVEN,
    status=DecisionStatus.BEST_FOUND,
    gap=0.05,
    by_size_gap=(0.05,),
    enumeration_agrees=Agreement.NOT_ENUMERATED,
    checks=(Check(kind=CheckKind.SECOND_RUN, agrees=False, detail="no portfolio instead of 0.8"),),
    cut=Cut.TIME,
)
UNDECIDED = dataclasses.replace(
    FOUND, status=DecisionStatus.UNDECIDED, members=(), assignments=(), objective=None, by_size=(None,), gap=None
)


@pytest.mark.parametrize(
    ("portfolio", "lines"),
    [
        (PROVEN, ["Certificate: proven best; enumeration of all portfolios: agreed."]),
        (
            FOUND,
            [
                (
                    "Certificate: best found, not proven best: another one can be better by at most 0.05 (time limit); "
                    "enumeration of all portfolios: not enumerated."
                ),
                "Check: second run DISAGREES: no portfolio instead of 0.8.",
            ],
        ),
        (UNDECIDED, ["No portfolio that serves every study was found (time limit); there may be one."]),
    ],
    ids=["proven", "best found", "undecided"],
)
def test_on_the_page(portfolio, lines):
    assert list(portfolio_lines(portfolio))[-len(lines) :] == lines


def test_in_the_report():
    assert portfolio_sentence(PROVEN).endswith("variant 7). Proven best.")
    assert portfolio_sentence(FOUND).endswith(
        "Best found, not proven best: another one can be better by at most 0.05 (time limit)."
    )
    assert portfolio_sentence(UNDECIDED) == (
        "No portfolio that serves every study was found (time limit); there may be one."
    )


def test_in_the_document_and_the_frame():
    document = portfolio_to_json(FOUND)
    assert (document["status"], document["gap"], document["cut"]) == ("best found", 0.05, "time limit")
    assert (document["enumeration_agrees"], document["by_size_gap"]) == ("not enumerated", [0.05])
    assert document["checks"] == [{"kind": "second run", "agrees": False, "detail": "no portfolio instead of 0.8"}]
    assert portfolio_frame(FOUND)[["status", "gap"]].to_numpy().tolist() == [["best found", 0.05]]


@pytest.mark.parametrize(
    ("status", "portfolio", "settled"),
    [
        (DecisionStatus.OPTIMAL, None, True),
        (DecisionStatus.OPTIMAL, PROVEN, True),
        (DecisionStatus.OPTIMAL, FOUND, False),
        (DecisionStatus.OPTIMAL, UNDECIDED, False),
        (DecisionStatus.BEST_FOUND, None, False),
        (DecisionStatus.INFEASIBLE, None, False),
    ],
)
def test_the_exit_status_is_0_only_where_all_is_proven(status, portfolio, settled):
    assert is_settled(SimpleNamespace(status=status), portfolio) is settled


@pytest.mark.parametrize(
    ("agreement", "words"),
    [
        (Agreement.AGREED, "enumeration of all 5 variants agrees."),
        (Agreement.DISAGREED, "enumeration of all 5 variants DISAGREES."),
        (Agreement.NOT_COMPARED, "enumeration of all 5 variants decides, the solver gave no answer in its time."),
        (Agreement.NOT_ENUMERATED, "not enumerated."),
    ],
)
def test_what_is_not_enumerated_is_not_said_to_agree(agreement, words):
    certificate = SimpleNamespace(
        status=DecisionStatus.BEST_FOUND,
        solver="HIGHS",
        gap=0.1,
        alternatives=5,
        enumeration_agrees=agreement,
        checks=FOUND.checks,
    )
    first, check = certificate_lines(certificate)
    assert first == f"Certificate: best found by HIGHS, gap 0.1; {words}"
    assert check == "Check: second run DISAGREES: no portfolio instead of 0.8."
    assert bool(agreement) is (agreement is Agreement.AGREED)
