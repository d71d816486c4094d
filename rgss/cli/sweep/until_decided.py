"""``rgss sweep --until decided``: replicates where they can still change the decision or a verdict."""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Sequence
from dataclasses import asdict, replace
from functools import partial
from typing import TYPE_CHECKING

from rgss.cli.options import sweep_words
from rgss.cli.safe_output import errors_are_seen
from rgss.counted import counted

if TYPE_CHECKING:
    from rgss.decision import ScreeningResult, UntilDecided
    from rgss.studies import Project
    from rgss.sweep import LostTrials, WorkerLimits
    from rgss.tradeoff.sequential import Forecast
    from rgss.trials.pieces import TrialSpec


def sweep_until_decided(options: argparse.Namespace, project: Project, limits: WorkerLimits) -> int:
    """Run batches of trials until the study is decided, or the cap is reached.

    Args:
        options: The verb's options.
        project: The project with its study.
        limits: What a worker may use for one task.

    Returns:
        0; 3 if trials could not be run.

    Raises:
        DefinitionError: Other options contradict it, the cap is too low, or the cluster cannot be used.
        EvidenceError: Trials that it needs could not be run.
        TradeoffError: The study decides in a way that has no sequential rule.
    """
    from rgss.assessment import record_after_sweep, record_before_sweep
    from rgss.cli.main import CLEAN, RUN_FAILED
    from rgss.cli.output import print_json, shown_path
    from rgss.cli.sweep.backend import execution_backend
    from rgss.cli.sweep.runner import SweepRunner, report_lost
    from rgss.decision import promoted_by_screening, replicate_until_decided
    from rgss.errors import EvidenceError
    from rgss.evidence import EvidenceStore
    from rgss.reports.decision import screening_to_json

    _refuse_contradictions(options)
    rule = project.study.until_decided
    if options.cap is not None:
        rule = replace(rule, cap=options.cap, verdict_cap=min(rule.verdict_cap, options.cap))
    if options.budget is not None:
        # The option is a hard limit: the study's reserve belongs to the study's budget.
        rule = replace(rule, budget=_budget(options.budget), reserve=None)
    lost: list[LostTrials] = []
    label = shown_path(project.evidence)
    with execution_backend(options, limits) as backend, EvidenceStore.open(project.evidence, label=label) as store:
        runner = SweepRunner.of(options, project, store, backend)

        def run(specs: Sequence[TrialSpec]) -> None:
            lost.extend(runner.run(specs).result.lost)

        if project.study.is_sequential:
            record_before_sweep(project, store)
        try:
            variants, screened = promoted_by_screening(project, store, run)
            most = len(variants) * rule.cap if rule.budget is None else rule.budget
            found = replicate_until_decided(
                project, store, run, rule=rule, variants=variants, on_look=partial(_report_look, most)
            )
        except EvidenceError as error:
            if not lost:
                raise
            # The evidence is missing because these trials could not be run.
            report_lost(lost)
            print(f"rgss: {error}", file=sys.stderr)
            return RUN_FAILED
        if project.study.is_sequential:
            record_after_sweep(project, store)
    if options.json:
        document = _as_json(found)
        print_json(document if screened is None else {**document, "screening": screening_to_json(screened)})
    else:
        _print_result(options, project, found, screened)
    report_lost(lost)
    return RUN_FAILED if lost else CLEAN


def _print_result(
    options: argparse.Namespace, project: Project, found: UntilDecided, screened: ScreeningResult | None
) -> None:
    from rgss.cli.output import print_lines
    from rgss.reports.decision import open_paragraph, screening_lines, until_decided_summary

    words = sweep_words(options, "project", "fidelity")
    if not project.study.sweeps_until_decided:
        words += ["--until", "decided"]
    lines = [] if screened is None else list(screening_lines(screened))
    lines += [until_decided_summary(found), open_paragraph(found, command=shlex.join(words))]
    if not project.study.is_sequential:
        lines.append(
            f"The study states no until_decided, so that 'rgss trade' reads its {project.study.replicates} replicates "
            "of each variant and not those that were added."
        )
    print_lines(line for line in lines if line)


def _budget(trials: int) -> int:
    from rgss.errors import DefinitionError

    if trials < 1:
        raise DefinitionError(f"--budget must be at least 1 trial, got {trials}", hint="omit it for the study's")
    return trials


def _refuse_contradictions(options: argparse.Namespace) -> None:
    from rgss.errors import DefinitionError

    for given, option in (
        (options.only, "--only"),
        (options.replicates, "--replicates"),
        (options.dry_run, "--dry-run"),
    ):
        if given:
            raise DefinitionError(f"--until decided and {option} exclude each other", hint=f"omit {option}")


def _report_look(most: int, look: int, trials: int) -> None:
    if errors_are_seen():
        print(f"look {look}: {counted(trials, 'trial')} of at most {most}", file=sys.stderr)


def _forecast(found: Forecast) -> dict[str, object]:
    return {
        "trials": found.trials,
        "accepted": found.accepted,
        "requirements": dict(found.requirements),
        "rivals": [{"variant": variant, "replicates": count} for variant, count in found.rivals.items()],
    }


def _as_json(found: UntilDecided) -> dict[str, object]:
    return {
        "reason": found.reason.value,
        "variant": found.variant,
        "contenders": list(found.contenders),
        "open": list(found.open_requirements),
        "unsettled": list(found.unsettled),
        "forecast": None if found.forecast is None else _forecast(found.forecast),
        "probability": found.probability,
        **asdict(found.rule),
        "looks": found.looks,
        "trials": found.total,
        "reserve_spent": found.reserve_spent,
        "variants": [
            {
                "variant": variant,
                "trials": count,
                "verdicts": {name: verdict.value for name, verdict in found.verdicts.get(variant, {}).items()},
            }
            for variant, count in found.trials.items()
        ],
    }
