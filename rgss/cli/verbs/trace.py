"""``rgss trace``: matrices, coverage, and the chain or the impact of an id."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.options import STUDY_HELP, add_fidelity, add_junit, add_replicates, chosen_project
from rgss.cli.trace_output import TABLES, deliver, ordered
from rgss.reports.trace import TRACE_FORMATS

if TYPE_CHECKING:
    from rgss.studies import Project
    from rgss.trace.evidence import TraceEvidence

HELP = "show the traceability matrices and their gaps, or the chain of one id"
PAGED = True
EXAMPLE = "rgss trace -o trace.html"
MORE_EXAMPLES = (
    ("rgss trace SYS-005", "one chain, up to the need and down to the trials"),
    ("rgss trace SYS-005 --impact", "the impact of a change"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument(
        "id", nargs="?", metavar="ID", help="show the chain of this id: up to the need, down to what decides"
    )
    parser.add_argument(
        "--impact", action="store_true", help="with an id: show the elements that a change to it affects"
    )
    parser.add_argument("--gaps", action="store_true", help="show gaps only; exit with 1 if there is one")
    parser.add_argument(
        "--variant", type=int, metavar="N", help="show the evidence of this variant (default: the chosen one)"
    )
    parser.add_argument("--table", choices=TABLES, metavar="NAME", help=f"only this table: {', '.join(TABLES)}")
    formats = [one.name for one in TRACE_FORMATS]
    parser.add_argument(
        "--format", choices=formats, metavar="FORMAT", help=f"{', '.join(formats)} (default: by the ending of the file)"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="write a file, or files into a folder")
    parser.add_argument("--diagrams", type=Path, metavar="DIR", help="write the diagrams as SVG files into a folder")
    add_junit(parser)
    parser.add_argument("--study", metavar="STUDY", help=STUDY_HELP)
    add_replicates(parser)
    add_fidelity(parser)


def run(options: argparse.Namespace) -> int:
    """Show or write; 1 if ``--gaps`` finds a gap."""
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.reports.trace import trace_report
    from rgss.trace.model import build_trace_model
    from rgss.trace.views import chain_of, impact_of

    order = ordered(options)
    project = chosen_project(options)
    evidence = _evidence(project, options)
    model = build_trace_model(project.requirements, project.measure_traces)
    found = None
    if options.id is not None:
        find = impact_of if options.impact else chain_of
        found = find(model, evidence, options.id, definitions=project.measures)
    title = f"Traceability of the study {project.study.id}"
    report = trace_report(model, evidence, title=title, definitions=project.measures)
    deliver(order, report, found)
    return FINDINGS if options.gaps and not report.is_complete else CLEAN


def _evidence(project: Project, options: argparse.Namespace) -> TraceEvidence:
    from rgss.cli.measured import measured_state
    from rgss.decision import trace_evidence

    measured, state = measured_state(project, options.junit)
    return trace_evidence(project, measured, state, variant=options.variant)
