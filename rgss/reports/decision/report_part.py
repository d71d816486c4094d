"""Decision of a study in the document of the HTML report."""

from __future__ import annotations

import itertools

from rgss.decision import screening_summary
from rgss.decision.robustness import not_computed_lines
from rgss.decision.study_decision import LimitMoves, RobustnessFindings, StudyDecision
from rgss.reports.decision.assumption_rows import ASSUMPTION_HEADS, assumption_rows, assumption_sentences
from rgss.reports.decision.conclusion import (
    headline,
    rule_sentence,
    seeds_sentences,
    stale_sentence,
    standing_sentence,
    uncertainty_sentences,
)
from rgss.reports.decision.json import assumptions_to_json, costs_to_json
from rgss.reports.decision.limit_sentences import limit_sentences
from rgss.reports.decision.portfolio_sentences import no_portfolio, portfolio_proof
from rgss.reports.decision.report_conflicts import conflict_reasons
from rgss.reports.decision.sentences import (
    cautions,
    enumeration_clause,
    reading_lines,
    reasons,
)
from rgss.reports.failure_drivers import cases_to_json, driver_sentence
from rgss.reports.plain_numbers import Plain, plain_number
from rgss.tradeoff import Contribution, PortfolioDecision
from rgss.tradeoff.programs import Certificate
from rgss.tradeoff.robustness import TIE_PROBABILITY

MOST_CONTENDERS = 40
"""Most listed variants that come first for some weights, the most acceptable first."""

_MOST_LISTED = 6


def decision_part(made: StudyDecision) -> Plain:
    """The decision, its reasons, its closest rivals, and what would change it."""
    decision = made.decision
    return {
        "chosen": decision.chosen,
        "runner_up": decision.runner_up,
        "ties": list(decision.ties),
        "near_ties": list(decision.near_ties),
        "rivals": _rivals(made.robustness, likely=True),
        "rivals_by_margin": _rivals(made.robustness, likely=False),
        "program": decision.program,
        "objectives": list(decision.objectives),
        "counts": {"alternatives": decision.counts.alternatives, "feasible": decision.counts.feasible},
        "demands": dict(decision.demands),
        "headline": headline(made),
        "failed_tests": list(made.conclusion.failed.tests),
        "failed_records": list(made.conclusion.failed.records),
        "standing": [
            line
            for line in (
                standing_sentence(made),
                stale_sentence(made),
                rule_sentence(made),
                *uncertainty_sentences(made),
                *seeds_sentences(made.seeds),
            )
            if line
        ],
        "reasons": _reasons(made),
        "cautions": list(cautions(made)),
        "readings": [] if made.assumptions else list(reading_lines(made)),
        "modelling": {
            "heads": list(ASSUMPTION_HEADS),
            "rows": [
                {"title": row.title, "cells": list(row.cells), "changes": row.changes, "sentence": row.sentence}
                for row in assumption_rows(made)
            ],
            "sentences": list(assumption_sentences(made)),
        },
        "drivers": _drivers(made),
        "screening": "" if made.screened is None else screening_summary(made.screened),
        "portfolio": "" if made.portfolio is None else portfolio_sentence(made.portfolio),
        "contributions": {
            "chosen": _contributions(decision.chosen_contributions),
            "runner_up": _contributions(decision.runner_up_contributions),
        },
        "certificate": _certificate(decision.certificate),
        **_robustness(made),
    }


def portfolio_sentence(portfolio: PortfolioDecision) -> str:
    """The choice of a portfolio in a few sentences."""
    missing = no_portfolio(portfolio)
    if missing:
        return missing
    served = "; ".join(f"{one.task} by {one.member} (variant {one.variant})" for one in portfolio.assignments)
    proof = portfolio_proof(portfolio)
    members = ", ".join(portfolio.members)
    serve = "together serve" if len(portfolio.members) > 1 else "serves"
    return f"Portfolio: {members} {serve} every study: {served}. {proof[0].upper()}{proof[1:]}."


def _rivals(found: RobustnessFindings | None, *, likely: bool) -> list[int]:
    """Tied variants by falling probability: those as likely as a tie, or those within the practical margin alone."""
    weighting = None if found is None else found.analysis.weighting
    if found is None or weighting is None or weighting.uncertainty is None:
        return []
    rivals = weighting.uncertainty.rivals
    return list(found.variants(tuple(one.row for one in rivals if (one.probability >= TIE_PROBABILITY) is likely)))


def _robustness(made: StudyDecision) -> Plain:
    found = made.robustness
    if found is None:
        return {}
    return {
        "acceptability": _acceptability(found),
        "weight_ranges": _weight_ranges(found),
        "limits": [_limit(moves) for moves in found.limits],
        "limit_sentences": list(limit_sentences(found.limits, tolerance=made.tolerance)),
        "assumptions": assumptions_to_json(found.analysis),
        "costs": costs_to_json(found.analysis),
        "refused": dict(found.analysis.refused),
        "not_computed": list(not_computed_lines(found.analysis.not_computed)),
    }


def _drivers(made: StudyDecision) -> Plain:
    """Sentences on the drivers of failures, and the success of each case; empty if nothing was drawn."""
    drivers = made.drivers
    if drivers is None or not drivers.seeds:
        return {}
    return {
        "trials": drivers.trials,
        "seeds": drivers.seeds,
        "sentences": [driver_sentence(one) for one in drivers.failures],
        "cases": cases_to_json(made.cases),
    }


def _reasons(made: StudyDecision) -> list[str]:
    if made.decision.chosen is None:
        return list(conflict_reasons(made.decision))
    return [f"{one.text}; {'; '.join(one.details)}." if one.details else one.text for one in reasons(made)]


def _contributions(contributions: tuple[Contribution, ...]) -> list[Plain]:
    return [
        {"measure": one.measure, "value": one.value, "weight": one.weight, "contribution": one.contribution}
        for one in contributions
    ]


def _certificate(certificate: Certificate) -> Plain:
    return {
        "status": certificate.status.value,
        "solver": certificate.solver,
        "gap": certificate.gap,
        "alternatives": certificate.alternatives,
        "objective": certificate.objective,
        "objective_recomputed": certificate.objective_recomputed,
        "enumeration": enumeration_clause(certificate),
        "checks": [check.text for check in certificate.checks],
    }


def _acceptability(found: RobustnessFindings) -> Plain | None:
    weighting = found.analysis.weighting
    if weighting is None or weighting.acceptability is None:
        return None
    first = [one for one in found.contenders if one.first > 0.0]
    return {
        "iterations": weighting.acceptability.iterations,
        "drawn_by": weighting.acceptability.drawn_by.value,
        "with_noise": weighting.with_noise,
        "elicited": weighting.elicited,
        "more": max(0, len(first) - MOST_CONTENDERS),
        "variants": [
            {
                "variant": one.variant,
                "first": plain_number(one.first),
                "error": plain_number(one.first_error),
                "confidence": plain_number(one.confidence) if weighting.with_noise else None,
                "feasible": plain_number(one.feasible_share) if weighting.with_noise else None,
                "region": plain_number(one.region),
            }
            for one in itertools.islice(first, MOST_CONTENDERS)
        ],
    }


def _weight_ranges(found: RobustnessFindings) -> list[Plain]:
    analysis = found.analysis
    if analysis.weighting is None or analysis.weighting.ranges is None:
        return []
    rows = zip(analysis.measures, analysis.weights.tolist(), analysis.weighting.ranges, strict=True)
    return [
        {
            "measure": measure,
            "weight": float(weight),
            "low": plain_number(one.low),
            "high": plain_number(one.high),
            "below": list(found.variants(one.below)),
            "above": list(found.variants(one.above)),
        }
        for measure, weight, one in rows
    ]


def _limit(moves: LimitMoves) -> Plain:
    """The choice with a requirement's limit moved to the next change on either side."""
    looser, tighter = moves.looser, moves.tighter
    return {
        "requirement": moves.requirement,
        "demand": moves.demand,
        "unit": moves.unit,
        "looser_to": None if looser is None else plain_number(looser.limit),
        "then": None if looser is None else list(looser.winners[:_MOST_LISTED]),
        "tighter_beyond": None if tighter is None else plain_number(tighter.limit),
        "then_wins": None if tighter is None else list(tighter.winners[:_MOST_LISTED]),
    }
