"""``rgss sweep``: all trials of a study, resumable."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING

from rgss.cli.options import add_evidence_choice, chosen_project, positive_quantity
from rgss.cli.verbs.variants import ONLY_HELP
from rgss.counted import counted

if TYPE_CHECKING:
    from rgss.cli.sweep import FinishedSweep
    from rgss.decision import ScreeningResult
    from rgss.designs import DesignVariant
    from rgss.studies import Project
    from rgss.sweep import WorkerLimits
    from rgss.trials.pieces import TrialSpec

HELP = "run every trial of a study that has no evidence yet"
STORES_TRIALS = True
EXAMPLE = "rgss sweep --replicates 10 --jobs 2"
MORE_EXAMPLES = (
    ("rgss sweep --dry-run", "list what would be run and why"),
    ("rgss sweep --fidelity kinematic", "motion alone, for a first look"),
    ("rgss sweep --only gripper.fingers=2 --only 1/3", "a balanced third of the designs with two fingers"),
    ("rgss sweep --until decided --cap 50", "add trials where they can still change the decision"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_evidence_choice(parser)
    parser.add_argument("--jobs", type=int, metavar="N", help="worker processes (default: one for each core)")
    parser.add_argument("--dask", metavar="ADDRESS", help="run on the Dask cluster of this scheduler instead")
    parser.add_argument("--only", action="append", metavar="WHICH", help=ONLY_HELP)
    parser.add_argument(
        "--until",
        choices=("decided",),
        help="add trials only to variants that can still change the decision or a verdict (without it where the study "
        "states until_decided.budget)",
    )
    parser.add_argument(
        "--cap", type=int, metavar="N", help="with --until: most trials of a variant (default: the study's)"
    )
    parser.add_argument(
        "--budget", type=int, metavar="N", help="with --until: most trials of all variants (default: the study's)"
    )
    parser.add_argument("--dry-run", action="store_true", help="list what would be run and why, and run nothing")
    parser.add_argument(
        "--no-share",
        action="store_true",
        help="run every trial without shared pieces: the same records, at many times the cost",
    )
    parser.add_argument(
        "--time-limit", metavar="TIME", help="longest time for one piece, such as '5 min' (default: '5 min')"
    )
    parser.add_argument(
        "--memory-limit", metavar="SIZE", help="most memory of a worker, such as '4 GB' (default: '2 GB')"
    )


def run(options: argparse.Namespace) -> int:
    """Run the missing trials; progress and failures go to standard error; 3 if a trial could not be run."""
    from rgss.cli.main import CLEAN, RUN_FAILED
    from rgss.cli.output import shown_path
    from rgss.cli.sweep import (
        SweepRunner,
        execution_backend,
        jobs_of,
        report_lost,
        sweep_until_decided,
    )
    from rgss.decision import sweep_in_stages
    from rgss.designs import picked
    from rgss.engines import require_engines
    from rgss.errors import DefinitionError
    from rgss.evidence import EvidenceStore

    require_engines("'rgss sweep'")
    project = chosen_project(options)
    jobs_of(options)
    limits = _limits(options)
    until = options.until is not None or (project.study.sweeps_until_decided and not options.only)
    for given, option in ((options.cap, "--cap"), (options.budget, "--budget")):
        if given is not None and not until:
            raise DefinitionError(f"{option} needs --until decided", hint="--replicates is the fixed number of trials")
    if until and (options.until is not None or not options.dry_run):
        return sweep_until_decided(options, project, limits)
    variants = picked(project.designs, options.only or ())
    if options.dry_run:
        return _dry_run(options, project, variants)
    label = shown_path(project.evidence)
    stages: list[FinishedSweep] = []
    with execution_backend(options, limits) as backend, EvidenceStore.open(project.evidence, label=label) as store:
        runner = SweepRunner.of(options, project, store, backend)

        def stage(specs: Sequence[TrialSpec]) -> None:
            stages.append(runner.run(specs))

        screened = sweep_in_stages(project, variants, store, stage)
    _print_result(stages[-1], screened, label, as_json=options.json)
    lost = [each for one in stages for each in one.result.lost]
    report_lost(lost)
    return RUN_FAILED if lost else CLEAN


def _print_result(swept: FinishedSweep, screened: ScreeningResult | None, label: str, *, as_json: bool) -> None:
    from rgss.cli.output import print_json, print_lines
    from rgss.cli.sweep import result_as_json, result_lines
    from rgss.reports.decision import screening_lines, screening_to_json

    tally = swept.tally
    if as_json:
        document = result_as_json(swept.trials, tally.counts, tally.failures, swept.result, label)
        print_json(document if screened is None else {**document, "screening": screening_to_json(screened)})
        return
    if screened is not None:
        print_lines(screening_lines(screened))
    print_lines(result_lines(swept.trials, tally.counts, tally.failures, swept.result, label))


def _dry_run(options: argparse.Namespace, project: Project, variants: Sequence[DesignVariant]) -> int:
    from rgss.assessment import read_specs
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json, shown_path
    from rgss.cli.sweep import dry_run_as_json, dry_run_lines
    from rgss.decision import screen, screening_specs
    from rgss.evidence import EvidenceStore
    from rgss.studies import trial_specs
    from rgss.sweep import dry_run

    label = shown_path(project.evidence)
    with ExitStack() as stack:
        store = None
        if project.evidence.exists():
            store = stack.enter_context(EvidenceStore.open(project.evidence, create=False, label=label))
        screened = screen(project, store)
        promoted = variants if screened is None else screened.promoted(variants)
        specs = (*screening_specs(project, variants=variants), *trial_specs(project, variants=promoted))
        found = dry_run(specs, store, share=not options.no_share, study=project.study.label)
        further: tuple[str, ...] = ()
        if project.study.sweeps_until_decided and not (options.only or options.json):
            read = sum(map(len, read_specs(project, store, promoted).values()))
            further = tuple(_further_trials(project, options.budget, read))
    if options.json:
        print_json(dry_run_as_json(found, label))
    else:
        print(*dry_run_lines(found, label), *further, sep="\n")
    return CLEAN


def _further_trials(project: Project, budget: int | None, read: int) -> Iterator[str]:
    """Lines on the trials that a sweep until decided may add.

    Args:
        project: The project with its study.
        budget: The budget that the command states; None for the study's.
        read: Number of trials that the study has, or is about to have.
    """
    rule = project.study.until_decided
    name = "until_decided.budget" if budget is None else "--budget"
    most = (rule.budget or 0) if budget is None else budget
    if most > read:
        yield f"Then up to {counted(most - read, 'more trial')} where the decision is open ({name})."
    else:
        yield f"No more trials where the decision is open: the budget of {most} is spent ({name})."
    # A budget that is typed is all that is spent.
    reserve = (rule.reserve or 0) - max(0, read - most)
    if budget is None and reserve > 0:
        yield (
            f"Then up to {counted(reserve, 'more trial')} while the probability of good selection is below "
            f"{rule.good_selection:g} (until_decided.reserve)."
        )


def _limits(options: argparse.Namespace) -> WorkerLimits:
    from rgss.sweep import WorkerLimits

    limits = WorkerLimits()
    time_s, memory_bytes = limits.time_s, limits.memory_bytes
    if options.time_limit is not None:
        time_s = positive_quantity("--time-limit", options.time_limit, "s", example="'5 min'")
    if options.memory_limit is not None:
        memory_bytes = round(positive_quantity("--memory-limit", options.memory_limit, "byte", example="'4 GB'"))
    return WorkerLimits(time_s=time_s, memory_bytes=memory_bytes)
