"""Measure the sweep engine: what sharing saves, what a second run costs, workers, memory, growth, engines.

    python benchmarks/sweep.py                          every row, one replicate: a few minutes
    python benchmarks/sweep.py --replicates 10 sweep again
    python benchmarks/sweep.py --json sweep.json

Every row runs `rgss sweep` as a process of its own on a copy of the project with an empty store. Times
are by the wall clock; the processor's seconds are given beside them, since another program on the machine
disturbs those less. Ratios are of runs that follow each other.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import platform
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from sweep_runs import REPOSITORY, Bench, children

SPACE = "designs/grasping_system.yaml"
LEVELS = ("4 s", "6 s", "8 s")
_KILLS, _KILL_SEED, _LONGEST_LIFE_S = 50, 20, 12.0


@dataclass(frozen=True, kw_only=True)
class Row:
    """One line of the table.

    Attributes:
        name: What was measured.
        value: The figure.
        unit: Its unit; empty for a pure number.
        bar: What it should keep, as text; empty for a figure without a bar.
        kept: Whether it keeps it; None without a bar.
        note: What else belongs to it.
    """

    name: str
    value: float
    unit: str
    bar: str = ""
    kept: bool | None = None
    note: str = ""


def row_sweep(bench: Bench) -> list[Row]:
    """From an empty store."""
    run = bench.shared()
    trials, made = run.document["trials"], run.document["pieces_made"]
    full = bench.replicates == 10 and bench.jobs == 2
    return [
        Row(
            name=f"72 × {bench.replicates} trials with contact, {bench.jobs} workers, empty store",
            value=run.wall_s,
            unit="s",
            bar="< 60" if full else "",
            kept=run.wall_s < 60.0 if full else None,
            note=f"{trials / run.wall_s:.1f} trials/s; {made}",
        ),
        Row(name="processor time of it", value=run.cpu_s, unit="s"),
        Row(
            name="share of the workers' time that they were busy",
            value=100.0 * run.document["busy_s"] / (run.document["elapsed_s"] * bench.jobs),
            unit="%",
            note="from the first task to the last, their start included",
        ),
    ]


def row_share(bench: Bench) -> list[Row]:
    """Against every trial by itself."""
    shared = bench.shared()
    apart = bench.sweep(bench.project(), "--jobs", bench.jobs, "--replicates", bench.replicates, "--no-share")
    ratio, cpu = apart.wall_s / shared.wall_s, apart.cpu_s / shared.cpu_s
    same = _records(shared.folder) == _records(apart.folder)
    return [
        Row(
            name="the same with --no-share, relative to it",
            value=ratio,
            unit="×",
            bar="≥ 5 with 10 replicates",
            # With fewer replicates the benches, which all of them share, weigh more.
            kept=ratio >= 5.0 if bench.replicates >= 10 or ratio >= 5.0 else None,
            note=f"{apart.wall_s:.1f} s; processor {cpu:.2f} ×",
        ),
        Row(name="records that differ", value=float(not same), unit="", bar="0", kept=same),
    ]


def row_again(bench: Bench) -> list[Row]:
    """From a full store."""
    run = bench.sweep(bench.shared().folder, "--jobs", bench.jobs, "--replicates", bench.replicates)
    if run.document["run"] or run.document["pieces_made"]:
        raise SystemExit("the second run made something")
    full = bench.replicates == 10
    return [
        Row(
            name="second run, full store",
            value=run.wall_s,
            unit="s",
            bar="< 2",
            kept=run.wall_s < 2.0 if full or run.wall_s >= 2.0 else None,
            note=f"{run.document['trials']} trials; processor {run.cpu_s:.2f} s",
        )
    ]


def row_workers(bench: Bench) -> list[Row]:
    """One worker against two."""
    words = ("--replicates", bench.replicates, "--jobs")
    one, two = bench.sweep(bench.project(), *words, 1), bench.sweep(bench.project(), *words, 2)
    ratio = one.wall_s / two.wall_s
    return [
        Row(
            name="two workers against one",
            value=ratio,
            unit="×",
            bar="≥ 1.85",
            kept=ratio >= 1.85,
            note=f"{one.wall_s:.1f} s and {two.wall_s:.1f} s; processor {one.cpu_s:.1f} s and {two.cpu_s:.1f} s",
        )
    ]


def row_memory(bench: Bench) -> list[Row]:
    """Memory of many kinematic trials."""
    replicates = max(20, 5 * bench.replicates)
    run = bench.sweep(bench.project(), "--jobs", 2, "--replicates", replicates, "--fidelity", "kinematic")
    worker, parent = _growth(run.worker_mib), _growth(run.parent_mib)
    return [
        Row(
            name=f"memory of all processes, 2 workers, {run.document['trials']} kinematic trials",
            value=run.peak_mib,
            unit="MiB",
            bar="< 1000",
            kept=run.peak_mib < 1000.0,
            note=f"{run.wall_s:.1f} s",
        ),
        Row(name="growth of a worker, third to last quarter", value=worker, unit="MiB", bar="< 5", kept=worker < 5.0),
        Row(
            name="growth of the parent, third to last quarter",
            value=parent,
            unit="MiB",
            note="at the end it reads all records to record the verdicts",
        ),
    ]


def row_contact_memory(bench: Bench) -> list[Row]:
    """Memory of the trials with contact."""
    run = bench.shared()
    return [
        Row(
            name="memory of all processes, trials with contact",
            value=run.peak_mib,
            unit="MiB",
            bar="< 1000",
            kept=run.peak_mib < 1000.0,
        )
    ]


def row_growth(bench: Bench) -> list[Row]:
    """Cost over replicates, and of levels that physics does not see."""
    words = ("--jobs", bench.jobs, "--fidelity", "kinematic", "--replicates")
    few, many = bench.sweep(bench.project(), *words, 4), bench.sweep(bench.project(), *words, 8)
    shared, folder = bench.shared(), bench.project()
    _add_level(folder)
    more = bench.sweep(folder, "--jobs", bench.jobs, "--replicates", bench.replicates)
    linear, level = many.cpu_s / few.cpu_s, more.cpu_s / shared.cpu_s - 1.0
    return [
        Row(
            name="twice the replicates, kinematic: processor time",
            value=linear,
            unit="×",
            bar="≤ 2.1",
            kept=linear <= 2.1,
        ),
        Row(
            name="a third more variants by another planning limit, with contact: processor time",
            value=100.0 * level,
            unit="%",
            bar="< 5",
            kept=level < 0.05,
            note=f"{more.document['trials']} against {shared.document['trials']} trials",
        ),
    ]


def row_interrupt(bench: Bench) -> list[Row]:
    """Ctrl-C in the middle."""
    folder = bench.project()
    command = [sys.executable, "-m", "rgss.cli.main", "sweep", "--project", str(folder), "--jobs", "2"]
    process = subprocess.Popen(  # noqa: S603
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True, cwd=REPOSITORY
    )
    while len(children(process.pid)) < 2:
        if process.poll() is not None:
            raise SystemExit(f"rgss sweep ended with {process.returncode} before it was interrupted")
        time.sleep(0.05)
    time.sleep(4.0)
    os.killpg(process.pid, signal.SIGINT)
    asked = time.perf_counter()
    status = process.wait()
    took_s = time.perf_counter() - asked
    kept = took_s < 1.0 and status == 130
    return [Row(name="end after Ctrl-C", value=took_s, unit="s", bar="< 1", kept=kept, note=f"status {status}")]


def row_kills(bench: Bench) -> list[Row]:
    """Sweep killed with -9 at random instants and resumed until it is complete, several times.

    Killed are in turn the sweep alone, one of its workers (which the sweep survives), and all of them at once.
    """
    undisturbed = _records(bench.shared().folder)
    chance = random.Random(_KILL_SEED)  # noqa: S311 - instants, not secrets
    kills = finished = wrong = 0
    folder = bench.project()
    while kills < _KILLS or finished == 0:
        words = ("--jobs", str(bench.jobs), "--replicates", str(bench.replicates))
        command = [sys.executable, "-m", "rgss.cli.main", "sweep", "--project", str(folder), *words]
        process = subprocess.Popen(  # noqa: S603
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True, cwd=REPOSITORY
        )
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(chance.uniform(0.2, _LONGEST_LIFE_S) if kills < _KILLS else None)
        if process.poll() is None:
            kills += 1
            workers = children(process.pid)
            if kills % 3 == 2 and workers:
                os.kill(chance.choice(workers), signal.SIGKILL)
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(chance.uniform(0.2, _LONGEST_LIFE_S))
            if process.poll() is None:
                with contextlib.suppress(ProcessLookupError):
                    (os.killpg if kills % 3 else os.kill)(process.pid, signal.SIGKILL)
            process.wait()
        if process.returncode == 0:
            finished += 1
            wrong += _records(folder) != undisturbed
            verify = [sys.executable, "-m", "rgss.cli.main", "evidence", "--project", str(folder), "verify"]
            done = subprocess.run(verify, check=False, stdout=subprocess.DEVNULL, cwd=REPOSITORY)  # noqa: S603
            wrong += done.returncode != 0
            folder = bench.project()
    return [
        Row(
            name=f"stores that differ from an undisturbed one, after {kills} kills with -9",
            value=float(wrong),
            unit="",
            bar="0",
            kept=wrong == 0,
            note=f"{finished} stores finished, {len(undisturbed)} records each",
        )
    ]


def row_engines(bench: Bench) -> list[Row]:
    """Time outside of the engines, in a process of its own."""
    command = [sys.executable, str(REPOSITORY / "benchmarks" / "engine_share.py"), "--seeds", str(bench.replicates)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=REPOSITORY)  # noqa: S603
    found = json.loads(done.stdout[done.stdout.index("{") : done.stdout.rindex("}") + 1])
    share = 100.0 * found["outside_share"]
    engines = ", ".join(f"{name} {seconds:.1f} s" for name, seconds in found["engines_s"].items())
    return [
        Row(
            name="time of a worker outside of engine calls",
            value=share,
            unit="%",
            bar="< 20",
            kept=share < 20.0,
            note=f"{engines}, of {found['wall_s']:.1f} s",
        )
    ]


ROWS: Mapping[str, Callable[[Bench], list[Row]]] = {
    "sweep": row_sweep,
    "again": row_again,
    "contact-memory": row_contact_memory,
    "share": row_share,
    "workers": row_workers,
    "memory": row_memory,
    "growth": row_growth,
    "interrupt": row_interrupt,
    "kills": row_kills,
    "engines": row_engines,
}


def _records(folder: Path) -> dict[str, str]:
    from rgss.evidence import EvidenceStore

    with EvidenceStore.open(folder / ".rgss" / "evidence.sqlite", create=False) as store:
        return {trial.key: trial.content_digest for trial in store.iterate()}


def _growth(samples: Sequence[float]) -> float:
    """How much the greatest of the last quarter exceeds that of the third."""
    quarter = max(1, len(samples) // 4)
    return max(samples[-quarter:]) - max(samples[-2 * quarter : -quarter] or samples[:1])


def _add_level(folder: Path) -> None:
    """Give the planning limit a level between those that it has."""
    file = folder / SPACE
    text = file.read_text(encoding="utf-8")
    line = next(line for line in text.splitlines() if f"d9: {LEVELS[1]}" in line)
    above = text.splitlines()[text.splitlines().index(line) - 1]
    block = f"{above}\n{line}\n"
    other = block.replace(LEVELS[1], "5 s").replace("medium", "between")
    file.write_text(text.replace(block, other + block, 1), encoding="utf-8")


def main() -> None:
    """Measure the rows named by the options; print a table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rows", nargs="*", metavar="ROW", help=f"which rows: {', '.join(ROWS)} (default: all)")
    parser.add_argument("--replicates", type=int, default=1, metavar="N", help="replicates of a sweep (default: 1)")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="worker processes (default: 2)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON, too")
    parser.add_argument("--project", type=Path, default=REPOSITORY, metavar="DIR", help="another project")
    options = parser.parse_args()
    unknown = [name for name in options.rows if name not in ROWS]
    if unknown:
        parser.error(f"there is no row {unknown[0]!r}; rows: {', '.join(ROWS)}")
    load = os.getloadavg()[0]
    if load > 1.0:
        sys.stderr.write(f"the machine has a load of {load:.1f}; times are of little use, ratios of some\n")
    rows: list[Row] = []
    with tempfile.TemporaryDirectory(prefix="rgss-bench-") as work:
        bench = Bench(options.project, Path(work), replicates=options.replicates, jobs=options.jobs)
        sys.stdout.write("| measured | figure | bar | kept | |\n|---|---:|---|---|---|\n")
        for name in options.rows or ROWS:
            for row in ROWS[name](bench):
                rows.append(row)
                kept = "–" if row.kept is None else "yes" if row.kept else "**no**"
                figure = f"{row.value:.2f} {row.unit}".strip()
                sys.stdout.write(f"| {row.name} | {figure} | {row.bar} | {kept} | {row.note} |\n")
                sys.stdout.flush()
    if options.json is not None:
        document = {
            "machine": platform.platform(),
            "cores": os.cpu_count(),
            "load_before": load,
            "replicates": options.replicates,
            "jobs": options.jobs,
            "rows": [vars(row) for row in rows],
        }
        options.json.write_text(json.dumps(document, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
