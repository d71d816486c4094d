"""``rgss report``: the study as one self-contained HTML page."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rgss.cli.options import add_evidence_choice, add_junit, chosen_project, sweep_command

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rgss.assessment import VariantMeasures
    from rgss.decision.sensitivity import Tornado
    from rgss.reports import TrialPictures
    from rgss.reports.trace import TraceReport
    from rgss.studies import Project
    from rgss.trace.evidence import EvidenceState
    from rgss.tradeoff import Decision

HELP = "write the decision with its evidence as one HTML page"
EXAMPLE = "rgss report --out report.html"
MORE_EXAMPLES = (
    ("rgss report --no-film", "without films, for which a few trials are run again"),
    ("rgss report --no-film --no-planners", "from the evidence alone, in seconds"),
    ("rgss report --board --pdf", "the choice on at most five printed pages, as board.html and board.pdf"),
    ("rgss report --film-size 640x480 --film-rate 12", "with larger and smoother films"),
)
LARGEST_PAGE = 15_000_000
"""Bytes; a larger page is slow to open and to send, which is then reported."""
MOST_PLANNED_SEEDS = 10
"""Most seeds of the comparison of planners; each is a search for every move, planner and shape of gripper."""
DEFAULT_FILE = Path("report.html")
BOARD_FILE = Path("board.html")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_evidence_choice(parser)
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE", help=f"the page (default: {DEFAULT_FILE}; {BOARD_FILE} with --board)"
    )
    parser.add_argument("--board", action="store_true", help="the choice alone, on at most five printed pages")
    parser.add_argument("--pdf", action="store_true", help="with --board: a PDF beside the page, printed by Chromium")
    parser.add_argument("--no-film", action="store_true", help="run no trial again: omit films")
    parser.add_argument(
        "--no-planners",
        action="store_true",
        help="search nothing again: omit the comparison with reference planners on the same moves",
    )
    parser.add_argument(
        "--film-size",
        metavar="SIZE",
        help="width and height of films in pixels (default: 480x360, or 400x300 if there are many)",
    )
    parser.add_argument(
        "--film-rate", type=float, metavar="N", help="frames a second of films (default: 8, or 5 if there are many)"
    )
    add_junit(parser)


def run(options: argparse.Namespace) -> int:
    """Write the page; 1 if no variant meets every requirement, or if a choice is not proven best."""
    from rgss.assessment import evidence_state, read_record, require_complete
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.measured import require_store
    from rgss.cli.output import path_in_project, shown_path
    from rgss.cli.pictures import ordered_look, trial_pictures
    from rgss.cli.served_studies import served_studies
    from rgss.decision import choose_portfolio, measure_survivors
    from rgss.decision.assumptions import assumption_outcomes
    from rgss.decision.study_decision import decide_study
    from rgss.evidence import EvidenceStore
    from rgss.reports.study import notable_trials, report_document

    if options.out is None:
        options.out = BOARD_FILE if options.board else DEFAULT_FILE
    _check_file(options.out)
    _check_films(options)
    browser = _browser(options)
    project = chosen_project(options)
    label = shown_path(project.evidence)
    recorded = read_record(project.folder)
    require_store(options, project)
    with EvidenceStore.open(project.evidence, create=False, label=label) as store:
        measured, screened = measure_survivors(project, store, recorded=recorded)
        require_complete(measured, sweep=sweep_command(options))
        state = evidence_state(project, measured, recorded=recorded, junit=options.junit)
        served = served_studies(project, store)
        made = decide_study(
            project,
            measured,
            evidence=path_in_project(project.evidence, project.folder),
            screened=screened,
            portfolio=choose_portfolio(project, served) if served else None,
            assumptions=assumption_outcomes(project, measured, store),
            failed=state.failed,
        )
        document = report_document(project, measured, made, store, planners=_planners(options, project))
    notable = notable_trials(measured, made.decision.chosen)
    look = None if options.no_film else ordered_look(options.film_size, options.film_rate, films=len(notable))
    pictures, notice = trial_pictures(project, notable, look=look)
    tornado = None if made.sensitivity is None else made.sensitivity.tornado
    trace = _trace(project, measured, made.decision, state)
    page = _rendered(options, project, document, trace, pictures, notice, tornado)
    _write(options.out, page)
    if browser is not None:
        _print_pdf(options.out, browser)
    _print_result(options, document, len(page))
    return CLEAN if made.is_final else FINDINGS


def _browser(options: argparse.Namespace) -> str | None:
    """The browser for printing, looked up before the report is made, so that a missing one is reported early."""
    from rgss.cli.output import require_writable
    from rgss.cli.printing import printing_browser
    from rgss.errors import DefinitionError

    if not options.pdf:
        return None
    if not options.board:
        raise DefinitionError("--pdf needs --board", hint="add --board, or print the page in a browser")
    require_writable(options.out.with_suffix(".pdf"))
    return printing_browser()


def _print_pdf(path: Path, browser: str) -> None:
    from rgss.cli.printing import print_page

    _write(path.with_suffix(".pdf"), print_page(path, browser))


def _rendered(
    options: argparse.Namespace,
    project: Project,
    document: dict[str, Any],
    trace: TraceReport,
    pictures: Sequence[TrialPictures],
    notice: str,
    tornado: Tornado | None,
) -> bytes:
    """The board edition or the whole report."""
    from rgss.reports import board_to_html, study_report_to_html
    from rgss.reports.decision import tornado_svgs
    from rgss.reports.diagrams import diagrams_of, drawings_for_page, missing_diagrams

    if options.board:
        return board_to_html(document, pictures=pictures, tornado=tornado).encode("utf-8")
    page = study_report_to_html(
        document,
        trace,
        drawings=drawings_for_page(diagrams_of(project.requirements, project.measures)),
        drawings_notice=missing_diagrams(project.requirements),
        pictures=pictures,
        pictures_notice=notice,
        tornado="" if tornado is None else tornado_svgs(tornado),
    )
    # A folder's name that is no UTF-8 has characters that none encodes.
    return page.encode("utf-8", errors="backslashreplace")


def _check_films(options: argparse.Namespace) -> None:
    """Check the film options before the report is made."""
    from rgss.cli.pictures import ordered_look
    from rgss.errors import DefinitionError

    given = [name for name in ("film_size", "film_rate") if getattr(options, name) is not None]
    if options.no_film and given:
        raise DefinitionError(f"--{given[0].replace('_', '-')} is given with --no-film", hint="omit one of them")
    ordered_look(options.film_size, options.film_rate, films=0)


def _trace(
    project: Project, measured: Sequence[VariantMeasures], decision: Decision, state: EvidenceState
) -> TraceReport:
    from rgss.decision import trace_evidence
    from rgss.reports.trace import trace_report
    from rgss.trace.model import build_trace_model

    return trace_report(
        build_trace_model(project.requirements, project.measure_traces),
        trace_evidence(project, measured, state, decision=decision),
        title=f"Traceability of the study {project.study.id}",
        definitions=project.measures,
    )


def _planners(options: argparse.Namespace, project: Project) -> dict[str, Any] | None:
    """Planners of the designs and the study's references on the same moves; None if they are not compared."""
    from rgss.engines import missing_engines
    from rgss.reports.study import planner_comparison
    from rgss.sweep import KeptSearches, compared_planners, has_searches, limits_of

    # The board edition has no room for the comparison.
    if options.no_planners or options.board:
        return None
    study = project.study
    if missing_engines() or not study.planning.references or not has_searches(project):
        return None
    seeds = range(study.seed, study.seed + min(study.replicates, MOST_PLANNED_SEEDS))
    compared = compared_planners(project, seeds=seeds, kept=KeptSearches.beside(project.evidence))
    return planner_comparison(compared, limits_of(project), seeds)


def _check_file(path: Path) -> None:
    from rgss.cli.output import require_writable
    from rgss.errors import DefinitionError

    if path.suffix.lower() not in (".html", ".htm"):
        # A report must not replace a file that is not a report.
        raise DefinitionError(f"{str(path)!r} does not end in .html", hint="use that suffix")
    require_writable(path)


def _write(path: Path, page: bytes) -> None:
    from rgss.documents import replaced_file

    with replaced_file(path) as part:
        part.write_bytes(page)


def _print_result(options: argparse.Namespace, document: dict[str, Any], size: int) -> None:
    from rgss.cli.output import print_json

    decision = document["decision"]
    if options.json:
        print_json({"file": str(options.out), "bytes": size, "report": document})
        return
    print(decision["headline"])
    for line in decision["not_computed"]:
        print(line)
    large = "; --film-size and --film-rate make it smaller" if size > LARGEST_PAGE and not options.no_film else ""
    print(f"Wrote {options.out} ({size / 1e6:.1f} MB{large})")
    if options.pdf:
        print(f"Wrote {options.out.with_suffix('.pdf')}")
