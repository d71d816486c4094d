"""Studies that a portfolio serves, with what was measured in them."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.assessment import VariantMeasures
    from rgss.evidence import EvidenceStore
    from rgss.studies import Project


def served_studies(
    project: Project, store: EvidenceStore, supposing: argparse.Namespace | None = None
) -> Mapping[str, tuple[Project, Sequence[VariantMeasures]]]:
    """Project and variants of each study that the portfolio of a study serves, by the study's file.

    Args:
        project: The project with the study; without a portfolio it serves none.
        store: The evidence.
        supposing: Options of a verb with suppositions, which hold in each study that has their numbers; None without.

    Raises:
        EvidenceError: Trials of a study or of the suppositions are missing.
        SimulationError: Trials of the suppositions could not be run.
    """
    if project.study.trade_off.portfolio is None:
        return {}
    from rgss.cli.assumption_trials import scenario_measures
    from rgss.decision import measured_studies
    from rgss.decision.what_if import suppose_known

    served = measured_studies(project, store)
    if supposing is None:
        return served
    for name, (each, measured) in served.items():
        scenario = suppose_known(each, supposing.what_if)
        if scenario is not None:
            served[name] = scenario.project, scenario_measures(supposing, each, scenario, measured, store)
    return served
