"""``rgss export``: the project and its evidence in the formats of other tools."""

from __future__ import annotations

import argparse
from pathlib import Path

from rgss.cli.options import add_fidelity, add_replicates, add_study, chosen_project
from rgss.exchange.formats import EXPORT_FORMATS, export_format

HELP = "write the project or its evidence in the format of another tool"
FITTED = False
EXAMPLE = "rgss export reqif -o requirements.reqif"
MORE_EXAMPLES = (
    ("rgss export reqif -o requirements.reqifz", "the same in an archive"),
    ("rgss export sysml -o model.sysml", "SysML v2"),
    ("rgss export ompl -o planners.db", "the searches of the study, for OMPL's planner comparison"),
    ("rgss export ompl -o planners.db studies/pick_place.yaml", "those of a given study"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    formats = [one.name for one in EXPORT_FORMATS]
    parser.add_argument(
        "format",
        choices=formats,
        metavar="FORMAT",
        help=f"one of {', '.join(formats)}; 'rgss evidence export' writes the trials as a table",
    )
    add_study(parser)
    add_replicates(parser)
    add_fidelity(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="the file to write")


def run(options: argparse.Namespace) -> int:
    """Write the file, as a whole or not at all."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import announce, print_json, shown_path
    from rgss.documents import require_no_source

    require_no_source(options.output)
    project = chosen_project(options)
    counts = export_format(options.format).write(project, options.output, shown_path(project.evidence))
    if options.json:
        print_json({"file": str(options.output), **counts})
    else:
        what = ", ".join(f"{count} {name}" for name, count in counts.items())
        announce(f"{what} written to {options.output}", options.output)
    return CLEAN
