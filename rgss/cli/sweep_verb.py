"""``rgss sweep``: all trials of a study, resumable."""

from __future__ import annotations

import argparse
import os
import sys
from collections import Counter
from pathlib import Path
from typing import Any

from rgss.cli.options import add_fidelity, add_replicates, add_study, chosen_project

HELP = "run every trial of a study that has no evidence yet"
EXAMPLE = "rgss sweep --replicates 10 --jobs 2"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    add_replicates(parser)
    add_fidelity(parser)
    parser.add_argument("--jobs", type=int, metavar="N", help="worker processes (default: one for each core)")
    parser.add_argument("--only", metavar="IDS", help="only these variants, such as 1,5,60-72")


def run(options: argparse.Namespace) -> int:
    """Run what is missing; progress goes to standard error."""
    from rgss.cli.output import print_json
    from rgss.errors import DefinitionError
    from rgss.evidence import EvidenceStore
    from rgss.studies.expansion import trial_specs
    from rgss.studies.sweep import FinishedTrial, sweep

    project = chosen_project(options)
    jobs = options.jobs if options.jobs is not None else (os.cpu_count() or 1)
    if jobs < 1:
        raise DefinitionError("--jobs must be at least 1", hint="leave it away for one process a core")
    variants = project.designs.expand()
    if options.only is not None:
        chosen = parse_ids(options.only, [variant.id for variant in variants])
        variants = tuple(variant for variant in variants if variant.id in chosen)
    specs = trial_specs(project, variants=variants)
    tally: Counter[str] = Counter()
    failures: Counter[str] = Counter()
    store_label = shown_path(project.evidence)
    with EvidenceStore.open(project.evidence, label=store_label) as store, _progress(len(specs)) as advance:

        def on_finished(trial: FinishedTrial) -> None:
            record = trial.record
            tally["run" if trial.fresh else "kept"] += 1
            tally["succeeded" if record.success else "failed"] += 1
            if record.failure is not None and record.failed_phase is not None:
                failures[f"{record.failure.value} at {record.failed_phase.value}"] += 1
            advance(tally)

        sweep(specs, store, jobs=jobs, on_finished=on_finished)
    if options.json:
        print_json(
            {
                "trials": len(specs),
                "run": tally["run"],
                "from_evidence": tally["kept"],
                "succeeded": tally["succeeded"],
                "failed": tally["failed"],
                "failures": dict(sorted(failures.items())),
                "evidence": store_label,
            }
        )
        return 0
    print(
        f"{len(specs)} trials: {tally['run']} run, {tally['kept']} from evidence; "
        f"{tally['succeeded']} succeeded, {tally['failed']} failed."
    )
    for reason, count in sorted(failures.items(), key=lambda item: (-item[1], item[0])):
        print(f"  {count} × {reason}")
    print(f"Evidence: {store_label}")
    return 0


def parse_ids(text: str, known: list[int]) -> set[int]:
    """Read ids such as ``1,5,60-72``.

    Raises:
        DefinitionError: The text is no such list, or an id is not there.
    """
    from rgss.errors import DefinitionError

    chosen: set[int] = set()
    for part in text.split(","):
        first, dash, last = part.strip().partition("-")
        if not (first.isdecimal() and (last.isdecimal() if dash else True)):
            raise DefinitionError(f"--only: {part.strip()!r} is no id or range", hint="write ids such as 1,5,60-72")
        wanted = range(int(first), int(last if dash else first) + 1)
        unknown = next((number for number in wanted if number not in known), None)
        if unknown is not None or not wanted:
            raise DefinitionError(
                f"--only: there is no variant {unknown if unknown is not None else part.strip()}",
                hint=f"ids go from {min(known)} to {max(known)}",
            )
        chosen.update(wanted)
    return chosen


def shown_path(path: Path) -> str:
    """A path relative to the current folder where it lies below it."""
    try:
        return str(path.resolve().relative_to(Path.cwd()))
    except ValueError:
        return str(path)


class _progress:  # noqa: N801 - reads as a function where it is used
    """A progress bar on standard error; silent where that is not a terminal."""

    def __init__(self, total: int) -> None:
        self._total = total

    def __enter__(self) -> Any:
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

        self._progress = Progress(
            TextColumn("Trials"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            TextColumn("{task.fields[state]}"),
            console=Console(file=sys.stderr),
            disable=not sys.stderr.isatty(),
        )
        self._progress.start()
        task = self._progress.add_task("trials", total=self._total, state="")

        def advance(tally: Counter[str]) -> None:
            state = f"{tally['succeeded']} succeeded, {tally['failed']} failed"
            self._progress.update(task, advance=1, state=state)

        return advance

    def __exit__(self, *_: object) -> None:
        self._progress.stop()
