"""Who carries out a sweep: processes of this machine, or a Dask cluster."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.studies.dask_cluster import DaskCluster
    from rgss.studies.keeping import Origin
    from rgss.studies.sweep import Maker, WorkerLimits
    from rgss.studies.workers import Workers


@dataclass(frozen=True, slots=True, kw_only=True)
class Crew:
    """Who carries out the tasks of a verb's sweeps.

    Attributes:
        jobs: Number of processes, if this machine does.
        limits: What a worker may use for one task.
        cluster: The cluster that does; None if this machine does.
    """

    jobs: int
    limits: WorkerLimits
    cluster: DaskCluster | None = None

    def workers(self, maker: Maker) -> Workers:
        """Workers for one sweep.

        Args:
            maker: What carries out a task.

        Raises:
            SimulationError: The cluster has gone.
        """
        from rgss.studies.workers import WorkerPool

        if self.cluster is not None:
            return self.cluster.workers(maker)
        limits = self.limits
        return WorkerPool(maker, size=self.jobs, time_limit_s=limits.time_s, memory_limit_bytes=limits.memory_bytes)

    def origin(self, folder: Path) -> Origin:
        """Where trials come from that this crew runs.

        Args:
            folder: The project's folder.

        Raises:
            EvidenceError: An input file cannot be read.
        """
        from rgss.studies.keeping import origin_of

        origin = origin_of(folder)
        return origin if self.cluster is None else replace(origin, machine=self.cluster.machine)


def jobs_of(options: argparse.Namespace) -> int:
    """The number of processes that the options name.

    Args:
        options: The verb's options.

    Raises:
        DefinitionError: It is none, or a cluster is named too.
    """
    from rgss.errors import DefinitionError

    if options.dask is not None and options.jobs is not None:
        raise DefinitionError(
            "--dask and --jobs exclude each other", hint="a Dask cluster has as many workers as it was started with"
        )
    jobs = options.jobs if options.jobs is not None else (os.cpu_count() or 1)
    if jobs < 1:
        raise DefinitionError("--jobs must be at least 1", hint="leave it away for one process a core")
    return int(jobs)


@contextmanager
def crew_of(options: argparse.Namespace, limits: WorkerLimits) -> Iterator[Crew]:
    """Who carries out what the options ask for, for as long as the block lasts.

    Args:
        options: The verb's options.
        limits: What a worker may use for one task.

    Raises:
        DefinitionError: The number of processes is none, or the cluster cannot be used.
    """
    jobs = jobs_of(options)
    if options.dask is None:
        yield Crew(jobs=jobs, limits=limits)
        return
    from rgss.studies.dask_cluster import dask_cluster

    with dask_cluster(options.dask, time_limit_s=limits.time_s, memory_limit_bytes=limits.memory_bytes) as cluster:
        yield Crew(jobs=jobs, limits=limits, cluster=cluster)
