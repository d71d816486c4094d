"""Portfolio of designs for several studies, each of which is a task or a scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rgss.assessment import VariantMeasures
from rgss.decision.choosing import trade_problem
from rgss.decision.screening import measure_survivors
from rgss.designs import DesignVariant
from rgss.errors import DefinitionError
from rgss.evidence import EvidenceStore
from rgss.studies import Project, load_project
from rgss.studies.trade_off import PortfolioEntry
from rgss.tradeoff import PortfolioDecision, PortfolioProblem, PortfolioTask, SolverRun, decide_portfolio

COMPONENT = "component."
"""Prefix of the name of a role whose component counts as one member."""


def portfolio_projects(project: Project) -> Mapping[str, Project]:
    """The project with each of the studies that its portfolio serves, by the study's file.

    Raises:
        DefinitionError: The study has no portfolio.
        DocumentError: A study's file is wrong.
    """
    return {each.study: load_project(project.folder, each.study) for each in _portfolio(project).studies}


def measured_studies(project: Project, store: EvidenceStore) -> dict[str, tuple[Project, Sequence[VariantMeasures]]]:
    """Project and measured variants of each study that the portfolio of a study serves, by the study's file.

    Raises:
        DefinitionError: The study has no portfolio.
        EvidenceError: The store is damaged.
    """
    projects = portfolio_projects(project)
    return {name: (each, measure_survivors(each, store)[0]) for name, each in projects.items()}


def choose_portfolio(
    project: Project,
    measured: Mapping[str, tuple[Project, Sequence[VariantMeasures]]],
    *,
    time_limit: float | None = None,
    independent: tuple[SolverRun, ...] = (),
) -> PortfolioDecision:
    """Choose the designs that together serve every study best.

    Args:
        project: The project with the study of the portfolio.
        measured: Project and variants with their estimates, for each of its studies.
        time_limit: Seconds to prove the portfolio best, in place of a count of operations.
        independent: Runs of other solvers than HiGHS, as further checks.

    Raises:
        EvidenceError: Trials of a study have no evidence.
        TradeoffError: The choice is ill posed.
        DefinitionError: The studies have different designs, or a member is unknown.
    """
    choice = _portfolio(project)
    designs: dict[int, str] = {}
    for study, (_, variants) in measured.items():
        for one in variants:
            if designs.setdefault(one.variant.id, one.variant.digest) != one.variant.digest:
                raise DefinitionError(
                    f"variant {one.variant.id} of {study} must be the same design as in the other studies",
                    hint="give the studies of a portfolio the same design space and catalogue",
                )
    every = {one.variant.id: one.variant for _, entries in measured.values() for one in entries}
    return decide_portfolio(
        PortfolioProblem(
            tasks=tuple(
                PortfolioTask(
                    name=each.study,
                    weight=each.weight,
                    problem=trade_problem(*measured[each.study]),
                    left_out=_screened_out(*measured[each.study]) & every.keys(),
                )
                for each in choice.studies
            ),
            at_most=choice.at_most,
            groups=None
            if choice.member is None
            else {name: _member(variant, choice.member) for name, variant in every.items()},
            aim=choice.aim,
        ),
        time_limit=time_limit,
        independent=independent,
    )


def _screened_out(project: Project, measured: Sequence[VariantMeasures]) -> frozenset[int]:
    """The designs of a study that its screening left out, which do not serve it."""
    if project.study.screening is None:
        return frozenset()
    return frozenset(one.id for one in project.designs.expand()).difference(one.variant.id for one in measured)


def _portfolio(project: Project) -> PortfolioEntry:
    portfolio = project.study.trade_off.portfolio
    if portfolio is None:
        raise DefinitionError(
            f"study {project.study.id!r} has no portfolio", hint="add 'portfolio' to the study's trade_off"
        )
    return portfolio


def _member(variant: DesignVariant, member: str) -> str:
    if member.startswith(COMPONENT):
        known = {f"{COMPONENT}{role}": component.id for role, component in variant.components.items()}
    else:
        known = dict(variant.levels)
    if member not in known:
        names = [*variant.levels, *(f"{COMPONENT}{role}" for role in variant.components)]
        raise DefinitionError(f"unknown portfolio member {member!r}", hint=f"members: {', '.join(names)}")
    return known[member]
