"""``rgss regress``: the metrics and the decision against a baseline."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.options import add_study, chosen_project
from rgss.cli.safe_output import errors_are_seen
from rgss.counted import counted

if TYPE_CHECKING:
    from rgss.evidence import EvidenceStore
    from rgss.regression import Baseline
    from rgss.studies import Project
    from rgss.sweep import LostTrials
    from rgss.trials.pieces import TrialSpec

CHANGED = 4
"""Exit status where behaviour changed without a stated reason and nothing is shown to be worse."""

HELP = "compare behaviour, guarded metrics and the decision with a baseline; missing trials are run first"
STORES_TRIALS = True
EXAMPLE = "rgss regress --junit regress.xml --markdown summary.md"
MORE_EXAMPLES = (
    ("rgss regress", "compare with the baseline beside the study"),
    ("rgss regress --strict --all", "inconclusive metrics fail, unchanged ones are shown too"),
    ('rgss regress --accept-change "new path smoother"', "accept changed behaviour once"),
    ('rgss regress --update --reason "a new gripper model"', "rewrite the baseline"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    parser.add_argument("--baseline", metavar="FILE", help="the baseline (default: beside the study, .baseline.json)")
    parser.add_argument("--update", action="store_true", help="rewrite the baseline; needs --reason")
    parser.add_argument("--reason", metavar="TEXT", help="with --update: why the numbers change; stored in the file")
    parser.add_argument(
        "--accept-change",
        metavar="TEXT",
        help="why changed behaviour is accepted in this run (else status 4); what is worse still fails",
    )
    parser.add_argument("--jobs", type=int, metavar="N", help="worker processes (default: one for each core)")
    parser.add_argument("--all", action="store_true", help="show the metrics that are the same, too")
    parser.add_argument(
        "--strict", action="store_true", help="end with 1, not 0, if something is still inconclusive at the cap"
    )
    parser.add_argument("--junit", type=Path, metavar="FILE", help="write the findings as JUnit XML")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write a summary for a pull request")
    parser.set_defaults(dask=None)


def run(options: argparse.Namespace) -> int:
    """Compare, or write the baseline.

    Returns:
        1 if anything is worse, unstable or missing, 3 if a trial could not be run, 4 if behaviour changed without
        a stated reason.
    """
    from rgss.cli.output import shown_path
    from rgss.cli.sweep import SweepRunner, execution_backend, jobs_of, report_lost
    from rgss.documents import require_no_source
    from rgss.engines import require_engines
    from rgss.errors import DefinitionError
    from rgss.evidence import EvidenceStore
    from rgss.guard import baseline_name, guard_of
    from rgss.regression import read_baseline
    from rgss.sweep import WorkerLimits

    require_engines("'rgss regress'")
    jobs_of(options)
    if options.reason is not None and not options.update:
        raise DefinitionError("--reason needs --update", hint="without it nothing is changed")
    if options.update:
        if not (options.reason or "").strip():
            raise DefinitionError("--update needs a reason", hint="state with --reason why the numbers change")
        for given, option in (
            (options.junit, "--junit"),
            (options.markdown, "--markdown"),
            (options.strict, "--strict"),
            (options.accept_change is not None, "--accept-change"),
        ):
            if given:
                raise DefinitionError(f"--update and {option} exclude each other", hint="compare in a run of its own")
    for output in (options.junit, options.markdown):
        if output is not None:
            require_no_source(output)
    if options.accept_change is not None and not options.accept_change.strip():
        raise DefinitionError("--accept-change needs a reason", hint="state why behaviour changes")
    project = chosen_project(options)
    guard_of(project)
    label = options.baseline or baseline_name(project.study.label)
    path = Path(options.baseline) if options.baseline else project.folder / label
    before = read_baseline(path, label=label) if not options.update or _is_there(path) else None
    lost: list[LostTrials] = []
    shown = shown_path(project.evidence)
    with (
        EvidenceStore.open(project.evidence, label=shown) as store,
        execution_backend(options, WorkerLimits()) as backend,
    ):
        runner = SweepRunner(project=project, store=store, backend=backend, share=True)

        def run_trials(specs: Sequence[TrialSpec]) -> None:
            lost.extend(runner.run(specs).result.lost)

        try:
            if before is None or options.update:
                return _update(options, project, store, run_trials, path, label, before)
            return _compare(options, project, store, run_trials, label, before)
        finally:
            report_lost(lost)


def _update(
    options: argparse.Namespace,
    project: Project,
    store: EvidenceStore,
    run_trials: Callable[[Sequence[TrialSpec]], None],
    path: Path,
    label: str,
    before: Baseline | None,
) -> int:
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json
    from rgss.documents import write_output
    from rgss.findings import printable
    from rgss.guard import make_baseline
    from rgss.regression import baseline_to_text

    baseline = make_baseline(project, store, run_trials, before=before, reason=options.reason)
    write_output(path, baseline_to_text(baseline).encode("ascii"), replace_source=True)
    trials = sum(len(run.seeds) * len(run.fingerprints) for run in baseline.runs.values())
    if options.json:
        print_json({"baseline": label, "trials": trials, "changes": len(baseline.history)})
    else:
        print(printable(label), f"written: {counted(trials, 'trial')}, change {len(baseline.history)} of its history.")
    return CLEAN


def _compare(
    options: argparse.Namespace,
    project: Project,
    store: EvidenceStore,
    run_trials: Callable[[Sequence[TrialSpec]], None],
    label: str,
    baseline: Baseline,
) -> int:
    from rgss.cli.main import CLEAN, FINDINGS, RUN_FAILED
    from rgss.cli.output import print_json
    from rgss.documents import write_output
    from rgss.guard import compare_with_baseline
    from rgss.reports.regression import report_lines, report_to_json, report_to_junit, report_to_markdown

    accepted = options.accept_change or ""
    report = compare_with_baseline(
        project, store, run_trials, baseline, label=label, on_look=_report_look, accepted=accepted
    )
    if options.junit is not None:
        write_output(options.junit, report_to_junit(report))
    if options.markdown is not None:
        write_output(options.markdown, report_to_markdown(report).encode("utf-8"))
    if options.json:
        print_json(report_to_json(report))
    else:
        print(*report_lines(report, everything=options.all), sep="\n")
    if report.incomplete:
        return RUN_FAILED
    undecided = options.strict and report.is_inconclusive
    if report.fails:
        return FINDINGS
    if report.is_unexplained:
        return CHANGED
    return FINDINGS if undecided else CLEAN


def _report_look(look: int, undecided: int) -> None:
    if look > 1 and errors_are_seen():
        print(f"look {look}: {undecided} metrics are inconclusive", file=sys.stderr)


def _is_there(path: Path) -> bool:
    try:
        return path.exists()
    except (OSError, ValueError):  # a name that no file can have
        return False
