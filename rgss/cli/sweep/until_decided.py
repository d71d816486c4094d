"""``rgss sweep --until decided``: replicates where they can still change the decision or a verdict."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import asdict, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.decision import UntilDecided
    from rgss.studies import Project
    from rgss.sweep import LostTrials, WorkerLimits
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
    from rgss.cli.main import CLEAN, RUN_FAILED
    from rgss.cli.output import print_json, shown_path
    from rgss.cli.sweep.backend import execution_backend
    from rgss.cli.sweep.runner import SweepRunner, report_lost
    from rgss.decision import replicate_until_decided, summary
    from rgss.errors import EvidenceError
    from rgss.evidence import EvidenceStore

    _refuse_contradictions(options, project)
    rule = project.study.until_decided
    if options.cap is not None:
        rule = replace(rule, cap=options.cap)
    lost: list[LostTrials] = []
    label = shown_path(project.evidence)
    with execution_backend(options, limits) as backend, EvidenceStore.open(project.evidence, label=label) as store:
        runner = SweepRunner.of(options, project, store, backend)

        def run(specs: Sequence[TrialSpec]) -> None:
            lost.extend(runner.run(specs).result.lost)

        try:
            found = replicate_until_decided(project, store, run, rule=rule, on_look=_report_look)
        except EvidenceError as error:
            if not lost:
                raise
            # What could not be run is why its evidence is missing.
            report_lost(lost)
            print(f"rgss: {error}", file=sys.stderr)
            return RUN_FAILED
    if options.json:
        print_json(_as_json(found))
    else:
        print(summary(found))
    report_lost(lost)
    return RUN_FAILED if lost else CLEAN


def _refuse_contradictions(options: argparse.Namespace, project: Project) -> None:
    from rgss.errors import DefinitionError

    for given, option in (
        (options.only, "--only"),
        (options.replicates, "--replicates"),
        (options.dry_run, "--dry-run"),
    ):
        if given:
            raise DefinitionError(f"--until decided and {option} exclude each other", hint=f"leave {option} away")
    if project.study.screening is not None:
        raise DefinitionError(
            "--until decided and screening exclude each other", hint="name one fidelity with --fidelity"
        )


def _report_look(look: int, trials: int) -> None:
    if sys.stderr.isatty():
        print(f"look {look}: {trials} trials", file=sys.stderr)


def _as_json(found: UntilDecided) -> dict[str, object]:
    return {
        "reason": found.reason.value,
        "variant": found.variant,
        "contenders": list(found.contenders),
        "open": list(found.open_requirements),
        "probability": found.probability,
        **asdict(found.rule),
        "looks": found.looks,
        "trials": found.total,
        "variants": [
            {
                "variant": variant,
                "trials": count,
                "verdicts": {name: verdict.value for name, verdict in found.verdicts.get(variant, {}).items()},
            }
            for variant, count in found.trials.items()
        ],
    }
