"""Suppositions on the curvature of value functions, by the names that the tornado has."""

from __future__ import annotations

from dataclasses import replace

from rgss.errors import DefinitionError
from rgss.studies import Project
from rgss.tradeoff.problem import AnchoredBent

SHAPE, ALL = "shape", "all"


def curvature_names(project: Project) -> dict[str, tuple[str, ...]]:
    """Names of the curvatures that can be supposed, each with the measures whose value functions it bends."""
    measures = [valued.measure for valued in project.study.trade_off.valued]
    every = {f"{SHAPE}.{ALL}": tuple(measures)} if len(measures) > 1 else {}
    return {**{f"{SHAPE}.{measure}": (measure,) for measure in measures}, **every}


def with_curvature(project: Project, name: str, curvature: float) -> Project:
    """The project with one value function, or all of them, bent.

    Args:
        project: The project.
        name: One of `curvature_names`.
        curvature: Curvature: positive for concave, negative for convex, 0 for as it is.

    Raises:
        DefinitionError: A function of them is bent already by another supposition.
        TradeoffError: The curvature is out of range.
    """
    trade_off = project.study.trade_off
    bent = curvature_names(project)[name]
    for valued in trade_off.valued:
        if valued.measure in bent and isinstance(valued, AnchoredBent):
            raise DefinitionError(
                f"--what-if: the value of {valued.measure} is bent twice",
                hint=f"suppose {SHAPE}.{ALL} or curvatures of single measures",
            )
    moved = tuple(
        AnchoredBent(measure=valued.measure, straight=valued, curvature=curvature) if valued.measure in bent else valued
        for valued in trade_off.valued
    )
    return replace(project, study=replace(project.study, trade_off=replace(trade_off, valued=moved)))
