"""``rgss check``: the project's files and their traceability."""

from __future__ import annotations

import argparse

HELP = "check the project's files and their traceability, without a simulation"
EXAMPLE = "rgss check --project ."


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument("study", nargs="?", metavar="STUDY", help="the study file (default: studies/pick_place.yaml)")
    parser.add_argument("--all", action="store_true", help="show notes too, not only errors and warnings")


def run(options: argparse.Namespace) -> int:
    """Check and report; 1 if there are errors or warnings, 2 if a file cannot be used."""
    from rgss.cli.main import BAD_INPUT, CLEAN, FINDINGS
    from rgss.cli.output import print_json
    from rgss.errors import DocumentError
    from rgss.findings import Severity
    from rgss.studies.project import find_project, load_project

    folder = find_project(options.project)
    try:
        project = load_project(folder, options.study)
        findings, unusable = project.check(), False
    except DocumentError as error:
        findings, unusable = error.findings, True
    grave = [finding for finding in findings if finding.severity is not Severity.INFO]
    if options.json:
        print_json(
            {
                "findings": [
                    {
                        "rule": finding.rule,
                        "severity": finding.severity.value,
                        "message": finding.message,
                        "file": finding.file,
                        "line": finding.line,
                        "column": finding.column,
                        "hint": finding.hint,
                    }
                    for finding in findings
                ]
            }
        )
    else:
        for finding in findings if options.all else grave:
            print(finding)
        if not unusable:
            notes = len(findings) - len(grave)
            print(
                f"{len(project.requirements.stakeholder)} stakeholder and {len(project.requirements.system)} system "
                f"requirements, {len(project.measures.measures)} measures, {len(project.designs.expand())} variants: "
                f"{len(grave)} findings" + (f", {notes} notes (--all shows them)" if notes and not options.all else "")
            )
    if unusable:
        return BAD_INPUT
    return FINDINGS if grave else CLEAN
