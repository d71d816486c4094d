"""Sentences on the agreement of stakeholders."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from rgss.reports.decision.sensitivity_sentences import agreement_sentences, regret_text
from rgss.tradeoff.robustness import stakeholder_agreement

PEOPLE = [("finance", np.array([1.0, 0.0])), ("safety", np.array([0.0, 1.0]))]


def sentences(values):
    agreement = stakeholder_agreement(np.array(values), np.ones(len(values), dtype=bool), PEOPLE, within=0.1)
    found = SimpleNamespace(agreement=agreement, variants=(7, 8, 9), accept_within=0.1)
    return list(agreement_sentences(found)), [regret_text(view, agreement) for view in agreement.views]


def test_designs_that_a_stakeholder_cannot_judge_are_named():
    lines, regrets = sentences([[1.0, np.nan], [0.9, 0.3], [0.2, 0.9]])

    assert lines == [
        "No design is within 0.1 of every stakeholder's best value.",
        "safety cannot judge variant 7, of which a measure with a weight is unknown.",
        "Compromise by least largest regret: variant 8; nobody's regret exceeds 0.6000 (safety).",
        "By ranks (mean Borda score 0.50): variants 8, 9.",
    ]
    assert regrets == ["0.1000", "0.6000"]


def test_without_a_design_that_all_can_judge_there_is_no_compromise():
    lines, regrets = sentences([[1.0, np.nan], [np.nan, 0.3]])

    assert lines[1:] == [
        "finance cannot judge variant 8, of which a measure with a weight is unknown.",
        "safety cannot judge variant 7, of which a measure with a weight is unknown.",
        "There is no compromise: no feasible variant is known in every measure that stakeholders weigh.",
    ]
    assert regrets == ["–", "–"]
