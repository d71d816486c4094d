"""Measure a Dask cluster of two processes against two processes of `rgss sweep` itself.

    python benchmarks/dask_cluster.py                       one replicate, three runs of each
    python benchmarks/dask_cluster.py --replicates 10 --runs 3
    python benchmarks/dask_cluster.py --fidelity kinematic  without contact, which is quicker
    python benchmarks/dask_cluster.py --json dask.json

The cluster is started before the first sweep, as `--dask` requires. Runs of both kinds take
turns, each `rgss sweep` a process of its own on a copy of the project with an empty store, and their
medians are compared; so the load that other programs make is the same for both. Then one of the
cluster's workers is killed with -9 in the middle of a sweep. Every store is compared with the first.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import statistics
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

from sweep_runs import REPOSITORY, Bench, Run

WORKERS = 2


def records(run: Run) -> dict[str, str]:
    """Outcome of every trial of a sweep, by its key."""
    from rgss.evidence import EvidenceStore

    with EvidenceStore.open(run.folder / ".rgss" / "evidence.sqlite", create=False) as store:
        return {trial.key: trial.content_digest for trial in store.iterate()}


def busy(run: Run) -> float:
    """Share of the workers' time spent on tasks."""
    return run.document["busy_s"] / (run.document["elapsed_s"] * WORKERS)


def processor_s(cluster: Any) -> float:
    """Processor time of a cluster so far: scheduler, workers, and processes that these have started and ended."""
    ticks = 0
    for worker in cluster.workers.values():
        fields = Path(f"/proc/{worker.process.pid}/stat").read_text().rpartition(")")[2].split()
        ticks += sum(map(int, fields[11:15]))
    return time.process_time() + ticks / os.sysconf("SC_CLK_TCK")


def killed_in_the_middle(cluster: Any, after_s: float) -> tuple[threading.Thread, list[int]]:
    """Kill one of a cluster's workers after a time; returns the thread that does it, and the killed processes."""
    killed: list[int] = []

    def kill() -> None:
        time.sleep(after_s)
        killed.append(next(iter(cluster.workers.values())).process.pid)
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    return killer, killed


def main() -> int:
    """Measure, print a table, and report whether the limits are kept."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--replicates", type=int, default=1, help="replicates (default: 1)")
    parser.add_argument("--runs", type=int, default=3, help="runs of each kind (default: 3)")
    parser.add_argument("--fidelity", default="contact", help="fidelity of the trials (default: contact)")
    parser.add_argument("--json", type=Path, help="also write the figures there")
    options = parser.parse_args()

    from distributed import LocalCluster

    with (
        tempfile.TemporaryDirectory() as work,
        LocalCluster(
            n_workers=WORKERS, threads_per_worker=1, dashboard_address="127.0.0.1:0", silence_logs=60
        ) as cluster,
    ):
        bench = Bench(REPOSITORY, Path(work), replicates=options.replicates, jobs=WORKERS)
        words = ("--replicates", options.replicates, "--fidelity", options.fidelity)
        there = ("--dask", cluster.scheduler_address)
        here = ("--jobs", WORKERS)
        # Take turns at being first, so that a load that grows or falls favours neither.
        pairs: list[tuple[Run, Run]] = []
        cpu_s: list[float] = []
        for number in range(options.runs):
            kinds = (here, there) if number % 2 == 0 else (there, here)
            runs = {}
            for kind in kinds:
                before_s = processor_s(cluster)
                runs[kind] = bench.sweep(bench.project(), *words, *kind)
                if kind == there:
                    cpu_s.append(runs[kind].cpu_s + processor_s(cluster) - before_s)
            pairs.append((runs[here], runs[there]))
        local_s = statistics.median(local.wall_s for local, _ in pairs)
        dask_s = statistics.median(dask.wall_s for _, dask in pairs)
        killer, killed = killed_in_the_middle(cluster, 0.5 * dask_s)
        robbed = bench.sweep(bench.project(), *words, *there)
        killer.join()
        expected = records(pairs[0][0])
        differ = sum(records(run) != expected for pair in pairs for run in pair)
        robbed_differs = records(robbed) != expected
        lost = len(robbed.document["run_failures"])

    figures = {
        "trials": len(expected),
        "fidelity": options.fidelity,
        "local_s": [round(local.wall_s, 2) for local, _ in pairs],
        "dask_s": [round(dask.wall_s, 2) for _, dask in pairs],
        "ratio": dask_s / local_s,
        "local_processor_s": [round(local.cpu_s, 2) for local, _ in pairs],
        "dask_processor_s": [round(each, 2) for each in cpu_s],
        "processor_ratio": statistics.median(cpu_s) / statistics.median(local.cpu_s for local, _ in pairs),
        "local_busy": statistics.median(busy(local) for local, _ in pairs),
        "dask_busy": statistics.median(busy(dask) for _, dask in pairs),
        "stores_that_differ": differ,
        "workers_killed": len(killed),
        "killed_s": robbed.wall_s,
        "killed_store_differs": robbed_differs,
        "killed_run_failures": lost,
    }
    kept = {
        "ratio": figures["ratio"] <= 1.15,
        "same": differ == 0,
        "killed": len(killed) == 1 and not robbed_differs and lost == 0,
    }
    rows = [
        (f"{len(expected)} {options.fidelity} trials, {WORKERS} local processes, median", f"{local_s:.1f} s", "", None),
        ("the same on a Dask cluster of as many, median", f"{dask_s:.1f} s", "", None),
        ("ratio", f"{figures['ratio']:.2f}", "≤ 1.15", kept["ratio"]),
        ("ratio of the processor's seconds, which load disturbs less", f"{figures['processor_ratio']:.2f}", "", None),
        ("share of time that local workers were busy", f"{figures['local_busy']:.0%}", "", None),
        ("share of time that the cluster's were", f"{figures['dask_busy']:.0%}", "", None),
        ("stores that differ from the first", f"{differ} of {2 * len(pairs)}", "0", kept["same"]),
        ("one worker killed with -9 in the middle", f"{robbed.wall_s:.1f} s", "", None),
        ("trials of it that are lost or differ", "none" if kept["killed"] else "some", "none", kept["killed"]),
    ]
    sys.stdout.write("| what | figure | bar | kept |\n|---|---|---|---|\n")
    for what, figure, bar, is_kept in rows:
        sys.stdout.write(
            f"| {what} | {figure} | {bar} | {'' if is_kept is None else 'yes' if is_kept else '**no**'} |\n"
        )
    if options.json is not None:
        options.json.write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    return 0 if all(kept.values()) else 1


if __name__ == "__main__":
    raise SystemExit(main())
