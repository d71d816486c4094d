"""A fleet on the page: proven, best found or undecided, its exit status, and its time limit."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace

import pytest

from rgss.api.trade_frames import portfolio_frame
from rgss.cli.trade.decision import print_certificate, print_portfolio
from rgss.cli.trade.json_document import _fleet
from rgss.cli.verbs.trade import is_settled, seconds_of
from rgss.errors import DefinitionError
from rgss.reports.study.decision import _fleet as fleet_sentence
from rgss.tradeoff import Agreement, Assignment, Check, CheckKind, Cut, DecisionStatus
from rgss.tradeoff.portfolio.portfolio import PortfolioDecision

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
    ("fleet", "lines"),
    [
        (PROVEN, ["Certificate: proven best; enumeration of all fleets: agreed."]),
        (
            FOUND,
            [
                (
                    "Certificate: best found, not proven best: another one can be better by at most 0.05 (time limit); "
                    "enumeration of all fleets: not enumerated."
                ),
                "Check: second run DISAGREES: no portfolio instead of 0.8.",
            ],
        ),
        (UNDECIDED, ["No fleet that serves every study was found (time limit), nor that there is none was proved."]),
    ],
    ids=["proven", "best found", "undecided"],
)
def test_on_the_page(capsys, fleet, lines):
    print_portfolio(fleet)
    assert capsys.readouterr().out.splitlines()[-len(lines) :] == lines


def test_in_the_report():
    assert "Best found" not in fleet_sentence(PROVEN)
    assert fleet_sentence(FOUND).endswith(
        "Best found, not proven best: another one can be better by at most 0.05 (time limit)."
    )
    assert fleet_sentence(UNDECIDED) == (
        "No fleet that serves every study was found before the time limit; there may be one."
    )


def test_in_the_document_and_the_frame():
    document = _fleet(FOUND)
    assert (document["status"], document["gap"], document["cut"]) == ("best found", 0.05, "time limit")
    assert (document["enumeration_agrees"], document["by_size_gap"]) == ("not enumerated", [0.05])
    assert document["checks"] == [{"kind": "second run", "agrees": False, "detail": "no portfolio instead of 0.8"}]
    assert portfolio_frame(FOUND)[["status", "gap"]].to_numpy().tolist() == [["best found", 0.05]]


@pytest.mark.parametrize(
    ("status", "fleet", "settled"),
    [
        (DecisionStatus.OPTIMAL, None, True),
        (DecisionStatus.OPTIMAL, PROVEN, True),
        (DecisionStatus.OPTIMAL, FOUND, False),
        (DecisionStatus.OPTIMAL, UNDECIDED, False),
        (DecisionStatus.BEST_FOUND, None, False),
        (DecisionStatus.INFEASIBLE, None, False),
    ],
)
def test_the_exit_status_is_0_only_where_all_is_proven(status, fleet, settled):
    assert is_settled(SimpleNamespace(status=status), fleet) is settled


@pytest.mark.parametrize(
    ("agreement", "words"),
    [
        (Agreement.AGREED, "enumeration of all 5 variants agrees."),
        (Agreement.DISAGREED, "enumeration of all 5 variants DISAGREES."),
        (Agreement.NOT_ENUMERATED, "not enumerated."),
    ],
)
def test_what_is_not_enumerated_is_not_said_to_agree(capsys, agreement, words):
    certificate = SimpleNamespace(
        status=DecisionStatus.BEST_FOUND,
        solver="HIGHS",
        gap=0.1,
        alternatives=5,
        enumeration_agrees=agreement,
        checks=FOUND.checks,
    )
    print_certificate(SimpleNamespace(certificate=certificate), "evidence.sqlite")
    first, check, _ = capsys.readouterr().out.splitlines()
    assert first == f"Certificate: best found by HIGHS, gap 0.1; {words}"
    assert check == "Check: second run DISAGREES: no portfolio instead of 0.8."
    assert bool(agreement) is (agreement is Agreement.AGREED)


def test_a_time_limit_is_a_time():
    assert (seconds_of(None), seconds_of("60 s"), seconds_of("2 min")) == (None, 60.0, 120.0)
    for text in ("60", "fast", "3 kg", "0 s", "-1 s"):
        with pytest.raises(DefinitionError, match="--time-limit") as error:
            seconds_of(text)
        assert error.value.hint
