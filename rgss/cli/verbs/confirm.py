"""``rgss confirm``: the decision at a finer step, with more iterations, and in another engine."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.options import add_replicates, add_study, chosen_project, option_quantity

if TYPE_CHECKING:
    from rgss.confirmation import Confirmation, ConfirmationSetting, Selection
    from rgss.evidence import EvidenceStore
    from rgss.studies import Project
    from rgss.sweep import LostTrials
    from rgss.trials.pieces import TrialSpec

HELP = "run the chosen design and its rivals at a finer step and in another engine, and compare the decisions"
STORES_TRIALS = True
EXAMPLE = "rgss confirm --jobs 2"
MORE_EXAMPLES = (
    ("rgss confirm --variants 28,31 --seeds 1", "these two designs, with one seed"),
    ('rgss confirm --engine pybullet --rate "2000 Hz"', "without MuJoCo, at a still finer step"),
    ("rgss confirm --markdown confirmation.md", "write the comparison as a page too"),
)
ENGINES = ("mujoco", "pybullet")
_FAILURES = 12
_MOST_FAILURES = 10_000
_MOST_DIGITS = 9


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    add_replicates(parser)
    parser.add_argument(
        "--variants",
        metavar="IDS",
        help="confirm these designs, such as 28,31 (default: the chosen one and its rivals)",
    )
    parser.add_argument("--seeds", type=int, metavar="N", help="seeds of each design (default: the replicates)")
    parser.add_argument(
        "--failures",
        type=int,
        default=_FAILURES,
        metavar="N",
        help=f"most failures of other designs that are run again (default: {_FAILURES})",
    )
    parser.add_argument("--rate", metavar="RATE", help="rate of the finer step (default: '1000 Hz')")
    parser.add_argument(
        "--iterations", type=int, metavar="N", help="the greater number of solver iterations (default: 4 × the study's)"
    )
    parser.add_argument(
        "--engine",
        action="append",
        choices=ENGINES,
        help="engine that confirms; may be given several times (default: both; MuJoCo: pip install 'rgss[mujoco]')",
    )
    parser.add_argument("--jobs", type=int, metavar="N", help="worker processes (default: one for each core)")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write the comparison as a page")
    parser.set_defaults(dask=None)


def run(options: argparse.Namespace) -> int:
    """Confirm; 1 if the decision or a verdict depends on the setting, 3 if trials could not be run."""
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import print_json, print_lines, shown_path
    from rgss.cli.sweep import jobs_of
    from rgss.confirmation import Engine, confirmation_settings
    from rgss.documents import write_output
    from rgss.engines import require_engines
    from rgss.reports.confirmation import confirmation_lines, confirmation_to_json, confirmation_to_markdown

    require_engines("'rgss confirm'")
    project = chosen_project(options)
    jobs_of(options)
    seeds = _seeds(options, project)
    rate_hz = None if options.rate is None else option_quantity("--rate", options.rate, "Hz", example='"1000 Hz"')
    settings = confirmation_settings(
        project,
        engines=[Engine(name) for name in options.engine or ENGINES],
        rate_hz=rate_hz,
        iterations=options.iterations,
    )
    found = _confirm(options, project, settings, seeds, shown_path(project.evidence))
    if isinstance(found, int):
        return found
    if options.markdown is not None:
        write_output(options.markdown, confirmation_to_markdown(found).encode("utf-8"))
    if options.json:
        print_json(confirmation_to_json(found))
    else:
        print_lines(confirmation_lines(found))
    return CLEAN if found.holds else FINDINGS


def _confirm(
    options: argparse.Namespace, project: Project, settings: Sequence[ConfirmationSetting], seeds: int, label: str
) -> Confirmation | int:
    """The confirmation; the exit status if trials could not be run."""
    from rgss.cli.main import RUN_FAILED
    from rgss.cli.measured import require_store
    from rgss.cli.sweep import SweepRunner, execution_backend, report_lost
    from rgss.confirmation import confirm
    from rgss.errors import EvidenceError
    from rgss.evidence import EvidenceStore
    from rgss.sweep import WorkerLimits

    lost: list[LostTrials] = []
    is_named = options.variants is not None
    if not is_named:
        require_store(options, project)
    with (
        EvidenceStore.open(project.evidence, create=is_named, label=label) as store,
        execution_backend(options, WorkerLimits()) as backend,
    ):
        selection = _selection(options, project, store)
        runner = SweepRunner(project=project, store=store, backend=backend, share=True)

        def run_trials(specs: Sequence[TrialSpec]) -> int:
            finished = runner.run(specs)
            lost.extend(finished.result.lost)
            return finished.tally.counts["run"]

        try:
            found = confirm(project, store, selection, settings, run_trials, seeds=seeds, evidence=label)
        except EvidenceError as error:
            if not lost:
                raise
            # The evidence is missing because these trials could not be run.
            report_lost(lost)
            print(f"rgss: {error}", file=sys.stderr)
            return RUN_FAILED
    return found


def _selection(options: argparse.Namespace, project: Project, store: EvidenceStore) -> Selection:
    from rgss.confirmation import select, selected_by_id
    from rgss.decision import choose, measure_survivors
    from rgss.errors import DefinitionError

    if not 0 <= options.failures <= _MOST_FAILURES:
        raise DefinitionError(
            f"--failures must be from 0 to {_MOST_FAILURES}, got {options.failures}", hint="0 omits the sample"
        )
    if options.variants is not None:
        measured = measure_survivors(project, store)[0] if options.failures else ()
        return selected_by_id(project, _ids(options.variants), measured, failures=options.failures)
    measured, _ = measure_survivors(project, store)
    return select(project, choose(project, measured), measured, failures=options.failures)


def _ids(text: str) -> list[int]:
    """Ids of designs from a list such as ``28,31``."""
    from rgss.errors import DefinitionError
    from rgss.findings import shown

    parts = [part.strip() for part in text.split(",")]
    if not all(part.isdecimal() and part.isascii() and len(part) <= _MOST_DIGITS for part in parts):
        raise DefinitionError(f"--variants must be a list of ids, got {shown(text)}", hint="write ids, such as 28,31")
    return [int(part) for part in parts]


def _seeds(options: argparse.Namespace, project: Project) -> int:
    from rgss.errors import DefinitionError
    from rgss.studies import MOST_REPLICATES

    if options.seeds is None:
        return project.study.replicates
    if not 1 <= options.seeds <= MOST_REPLICATES:
        raise DefinitionError(
            f"--seeds must be from 1 to {MOST_REPLICATES}, got {options.seeds}", hint="omit it for the replicates"
        )
    return int(options.seeds)
