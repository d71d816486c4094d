"""``rgss export``: the project and its evidence in the formats of other tools."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.options import add_fidelity, add_replicates, add_study, chosen_project

if TYPE_CHECKING:
    from rgss.studies import Project

HELP = "write the project or its evidence in the format of another tool"
EXAMPLE = "rgss export reqif -o requirements.reqif"
MORE_EXAMPLES = (
    ("rgss export reqif -o requirements.reqifz", "the same in an archive"),
    ("rgss export sysml -o model.sysml", "SysML v2"),
    ("rgss export ompl -o planners.db", "the searches of the study, for OMPL's planner comparison"),
    ("rgss export ompl -o planners.db studies/pick_place.yaml", "those of a study that is named"),
)
FORMATS = ("reqif", "sysml", "csv", "xlsx", "ompl")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument(
        "format",
        choices=FORMATS,
        metavar="FORMAT",
        help=f"one of {', '.join(FORMATS)}; 'rgss evidence export' writes the trials as a table",
    )
    add_study(parser)
    add_replicates(parser)
    add_fidelity(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="the file to write")


def run(options: argparse.Namespace) -> int:
    """Write the file, as a whole or not at all."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import announce, print_json
    from rgss.documents import require_no_source

    require_no_source(options.output)
    project = chosen_project(options)
    counts = _write_ompl(project, options.output) if options.format == "ompl" else _write_model(project, options)
    if options.json:
        print_json({"file": str(options.output), **counts})
    else:
        what = ", ".join(f"{count} {name}" for name, count in counts.items())
        announce(f"{what} written to {options.output}", options.output)
    return CLEAN


def _write_model(project: Project, options: argparse.Namespace) -> dict[str, int]:
    from rgss.documents import write_output

    write_output(options.output, _model(project, options.format, options.output))
    requirements = project.requirements
    counts = {"requirements": len(requirements.stakeholder) + len(requirements.system)}
    if options.format in ("reqif", "sysml"):
        counts["elements of the architecture"] = len(requirements.architecture.elements)
    return counts


def _model(project: Project, format_name: str, path: Path) -> bytes:
    from rgss.exchange import content_of

    if format_name == "sysml":
        from rgss.exchange.sysml import sysml_text

        return sysml_text(project.requirements, project.measures, title=project.study.id).encode("utf-8")
    measures = {measure.id: measure.definition for measure in project.measures.measures}
    content = content_of(project.requirements, measures)
    if format_name == "reqif":
        from rgss.exchange.reqif import ARCHIVE_ENDING, archive_of, reqif_text

        text = reqif_text(content, title=f"Requirements of the study {project.study.id}")
        if path.suffix.lower() == ARCHIVE_ENDING:
            return archive_of(text, f"{path.stem}.reqif")
        return text.encode("utf-8")
    from rgss.exchange.tables import csv_text, excel_bytes

    # With the mark Excel takes it for UTF-8.
    return excel_bytes(content) if format_name == "xlsx" else csv_text(content).encode("utf-8-sig")


def _write_ompl(project: Project, path: Path) -> dict[str, int]:
    from rgss.cli.output import shown_path
    from rgss.evidence import EvidenceStore
    from rgss.exchange import write_ompl_database
    from rgss.sweep import planning_runs
    from rgss.trials.code import versions

    planning = project.study.planning
    with EvidenceStore.open(project.evidence, create=False, label=shown_path(project.evidence)) as store:
        runs = planning_runs(project, store)
    write_ompl_database(
        path,
        runs,
        name=project.study.id,
        seed=project.study.seed,
        version=versions()["ompl"],
        setup={
            "scene": project.scene.id,
            "planning clock": f"{planning.charge_per_check_s:g} s a validity check" if planning.counted else "wall",
            "resolution": f"{planning.resolution_rad:g} rad",
            "clearance": f"{planning.clearance_m:g} m",
        },
    )
    return {"planning runs": len(runs)}
