"""Execution back ends of a sweep: processes of this machine, or a Dask cluster."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.sweep import Maker, Origin, PersistentWorkerPool, WorkerLimits, Workers
    from rgss.sweep.dask import DaskCluster


@dataclass(frozen=True, slots=True, kw_only=True)
class ExecutionBackend:
    """Execution back end of a verb's sweeps.

    Attributes:
        jobs: Number of processes of this machine.
        pool: The processes of this machine, or the cluster, which provide the workers of each sweep.
        machine: Description of the cluster's machines; None for this machine.
    """

    jobs: int
    pool: PersistentWorkerPool | DaskCluster
    machine: str | None = None

    def workers(self, maker: Maker) -> Workers:
        """Workers for one sweep; engines that they load are kept for the next.

        Args:
            maker: The function that carries out a task.

        Raises:
            SimulationError: The cluster is lost.
        """
        return self.pool.workers(maker)

    def origin(self, folder: Path, study: str) -> Origin:
        """Origin of the trials that this back end runs.

        Args:
            folder: The project's folder.
            study: File of the study by its name in the project.

        Raises:
            EvidenceError: An input file cannot be read.
        """
        from rgss.sweep import origin_of

        origin = origin_of(folder, study)
        return origin if self.machine is None else replace(origin, machine=self.machine)


def jobs_of(options: argparse.Namespace) -> int:
    """The number of processes that the options name.

    Raises:
        DefinitionError: It is below 1, or a cluster is named too.
    """
    from rgss.errors import DefinitionError

    if options.dask is not None and options.jobs is not None:
        raise DefinitionError(
            "--dask and --jobs exclude each other", hint="a Dask cluster has as many workers as it was started with"
        )
    jobs = options.jobs if options.jobs is not None else (os.cpu_count() or 1)
    if jobs < 1:
        raise DefinitionError("--jobs must be at least 1", hint="omit it for one process a core")
    return int(jobs)


@contextmanager
def execution_backend(options: argparse.Namespace, limits: WorkerLimits) -> Iterator[ExecutionBackend]:
    """Execution back end that the options name, closed at the end of the block.

    Args:
        options: The verb's options.
        limits: What a worker may use for one task.

    Raises:
        DefinitionError: The number of processes is below 1, or the cluster cannot be used.
    """
    from rgss.sweep import PersistentWorkerPool

    jobs = jobs_of(options)
    if options.dask is None:
        with PersistentWorkerPool(
            size=jobs, time_limit_s=limits.time_s, memory_limit_bytes=limits.memory_bytes
        ) as pool:
            yield ExecutionBackend(jobs=jobs, pool=pool)
        return
    from rgss.sweep.dask import dask_cluster

    with dask_cluster(options.dask, time_limit_s=limits.time_s, memory_limit_bytes=limits.memory_bytes) as cluster:
        yield ExecutionBackend(jobs=jobs, pool=cluster, machine=cluster.machine)
