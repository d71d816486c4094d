"""``rgss trade``: the decision, its reasons, its closest rivals, and what would change it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.options import add_evidence_choice, chosen_project, positive_quantity

if TYPE_CHECKING:
    from rgss.decision import ScreeningResult
    from rgss.decision.study_decision import StudyDecision
    from rgss.decision.what_if import Scenario
    from rgss.evidence import EvidenceStore
    from rgss.studies import Project

HELP = "choose the best variant, with the reasons and what would change the choice"
PAGED = True
EXAMPLE = 'rgss trade --what-if weight.t_p=0.4 --what-if "SYS-012.threshold=0.9 kg"'
MORE_EXAMPLES = (
    ("rgss trade", "the decision, why, and what would change it"),
    ("rgss trade --fidelity kinematic", "by the evidence of kinematic trials"),
    (
        'rgss trade --what-if "planning.charge_per_check=0.5 ms" --run',
        "with another planning clock; runs the missing trials",
    ),
    ("rgss trade --section --into README.md", "write the decision into a page"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_evidence_choice(parser)
    parser.add_argument(
        "--what-if",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="suppose another weight.MEASURE, REQUIREMENT.threshold (or that of a chance:, tail: or limit: as the page "
        "prints it), value.MEASURE.worst (or best …), shape.MEASURE (a curvature of its value), "
        "catalogue.COMPONENT.cost (or another property), prices (a factor on all that are assumed), "
        "measures.CONSTANT, reading.MEASURE (an alternative of a "
        "measure), or how trials are made (planning.charge_per_check, planning.time_limit, uncertainty.nominal, "
        "fidelity …), and show before and after; "
        "may be given several times",
    )
    parser.add_argument(
        "--run",
        action="store_true",
        help="run the trials that suppositions need and that are missing; without --what-if, those that the table of "
        "assumptions needs",
    )
    parser.add_argument(
        "--jobs", type=int, metavar="N", help="with --run: worker processes (default: one for each core)"
    )
    parser.add_argument(
        "--time-limit",
        metavar="TIME",
        help='how long to prove a portfolio or a choice of levels, such as "60 s" (default: counts of operations, some '
        "20 s for a portfolio, which give the same answer on every machine)",
    )
    parser.add_argument(
        "--solver-check",
        choices=("scip",),
        help="solve every program by another solver too; the certificate names the solvers that agree (scip: "
        "pip install 'rgss[scip]')",
    )
    parser.add_argument("--brief", action="store_true", help="only the decision and its reasons")
    parser.add_argument(
        "--effects", action="store_true", help="also the effect of each factor's levels on the measures"
    )
    parser.add_argument("--section", action="store_true", help="print the decision as a section in Markdown")
    parser.add_argument(
        "--into", type=Path, metavar="FILE", help="with --section: put it between the file's markers instead"
    )


def run(options: argparse.Namespace) -> int:
    """Decide; 1 if no variant meets every requirement, a choice is not proven best, or a part is not computed."""
    from rgss.assessment import failed_verifications, read_record
    from rgss.cli.assumption_trials import known_assumptions, scenario_measures
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.measured import require_store
    from rgss.cli.output import path_in_project, shown_path
    from rgss.cli.served_studies import served_studies
    from rgss.decision import choose_portfolio, measure_survivors
    from rgss.decision.study_decision import decide_study
    from rgss.decision.what_if import suppose
    from rgss.evidence import EvidenceStore
    from rgss.reports.decision import text_with_place
    from rgss.tradeoff import SolverCheck, independent_run

    _check_options(options)
    time_limit = None
    if options.time_limit is not None:
        time_limit = positive_quantity("--time-limit", options.time_limit, "s", example='"60 s"')
    independent = () if options.solver_check is None else (independent_run(SolverCheck(options.solver_check)),)
    # Read before anything is computed, since the file may lack the markers of the section.
    text = None if options.into is None else text_with_place(options.into)
    project = chosen_project(options)
    scenario = suppose(project, options.what_if) if options.what_if else None
    label = shown_path(project.evidence)
    analysed = options.section or not options.brief
    require_store(options, project)
    with EvidenceStore.open(project.evidence, create=False, label=label) as store:
        measured, screened = measure_survivors(project, store, recorded=read_record(project.folder))
        supposed = None if scenario is None else scenario_measures(options, project, scenario, measured, store)
        more = () if screened is None or scenario is None else _reopened(project, scenario, screened, store)
        asked = scenario is None and (analysed or options.run)
        assumptions = known_assumptions(options, project, measured, store) if asked else ()
        served = served_studies(project, store, options)
        portfolio = (
            choose_portfolio(project, served, time_limit=time_limit, independent=independent) if served else None
        )
    made = decide_study(
        project,
        measured,
        evidence=path_in_project(project.evidence, project.folder),
        analysed=analysed,
        independent=independent,
        portfolio=portfolio,
        screened=screened,
        scenario=scenario,
        supposed=supposed,
        reopened=more,
        assumptions=assumptions,
        time_limit=time_limit,
        failed=failed_verifications(project),
    )
    _print(options, made, text)
    return CLEAN if made.is_final else FINDINGS


def _check_options(options: argparse.Namespace) -> None:
    from rgss.errors import DefinitionError

    if options.into is not None and not options.section:
        raise DefinitionError("--into needs --section", hint="the section is what goes into the file")
    if options.section and (options.what_if or options.json):
        raise DefinitionError(
            "--section excludes --what-if and --json", hint="omit them: the section shows the study itself"
        )
    if options.jobs is not None and not options.run:
        raise DefinitionError("--jobs needs --run", hint="a decision from stored trials needs no workers")


def _print(options: argparse.Namespace, made: StudyDecision, text: str | None) -> None:
    """Print the decision, or write it into the text of the given file."""
    from rgss.cli.output import print_json, print_lines
    from rgss.documents import write_output
    from rgss.reports.decision import decision_lines, decision_section, trade_document, with_section

    if options.json:
        print_json(trade_document(made))
    elif not options.section:
        print_lines(decision_lines(made, effects=options.effects))
    elif text is None:
        print(decision_section(made))
    else:
        content = with_section(text, decision_section(made)).encode("utf-8")
        write_output(options.into, content, replace_source=True)
        print(f"Wrote the decision into {options.into}.")


def _reopened(project: Project, scenario: Scenario, screened: ScreeningResult, store: EvidenceStore) -> tuple[int, ...]:
    """The screened-out designs that would be promoted under the suppositions."""
    from rgss.assessment import measure_variants
    from rgss.decision import reopened
    from rgss.decision.what_if import measured_in

    if scenario.settings:
        return ()  # The suppositions change the screening trials themselves, so that nothing is known of them.
    first = measure_variants(project.with_fidelity(screened.screening.fidelity.value), store)
    return reopened(screened, scenario.project, measured_in(scenario, first))
