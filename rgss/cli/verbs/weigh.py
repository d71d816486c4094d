"""``rgss weigh``: weights from pairwise answers, with intervals and the consistency of the answers."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import TYPE_CHECKING

from rgss.cli.options import add_study, chosen_project

if TYPE_CHECKING:
    from rgss.studies import Project

HELP = "compute weights from pairwise answers on swings, with the consistency of the answers"
EXAMPLE = "rgss weigh studies/pick_place.yaml"
MORE_EXAMPLES = (
    ("rgss weigh", "the weights of the study with their intervals, and the inconsistency of the answers"),
    ("rgss weigh --questions", "the questions, as a section of the study's file to fill in"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    parser.add_argument(
        "--questions", action="store_true", help="print questions on the study's swings, to be filled in, instead"
    )


def run(options: argparse.Namespace) -> int:
    """Show the weights; 1 if answers are too inconsistent."""
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import print_json, print_lines
    from rgss.errors import DefinitionError
    from rgss.reports.decision import elicitation_to_json, question_lines, weighing_lines

    project = chosen_project(options)
    trade_off = project.study.trade_off
    if options.questions:
        if options.json:
            raise DefinitionError("--questions prints a section of a YAML file", hint="omit --json")
        print_lines(question_lines(_swings(project)))
        return CLEAN
    if options.json:
        print_json(
            {
                "study": project.study.id,
                "weights": dict(trade_off.weighting.weights),
                "elicitation": elicitation_to_json(trade_off.elicited, trade_off.elicited_by),
            }
        )
    else:
        stated = None if trade_off.elicited else trade_off.weighting.weights
        print_lines(weighing_lines(project.study.id, trade_off.elicited, trade_off.elicited_by, stated=stated))
    answered = [*trade_off.elicited, *trade_off.elicited_by.values()]
    acceptable = all(one.consistency is None or one.consistency.is_acceptable is not False for one in answered)
    return CLEAN if acceptable else FINDINGS


def _swings(project: Project) -> Iterator[tuple[str, str, str]]:
    """Worst and best quantity of each valued measure."""
    from rgss.reports.decision import quantity_text

    for one in project.study.values:
        unit = project.measures.measure(one.measure).unit
        yield one.measure, quantity_text(one.worst, unit), quantity_text(one.best, unit)
