"""Sweeps as processes of their own, with their time and the memory of all their workers."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).resolve().parents[1]
FOLDERS = ("requirements", "designs", "scenes", "studies")
SAMPLE_S = 0.1
MIB = 1024 * 1024


@dataclass(frozen=True, kw_only=True)
class Run:
    """One process.

    Attributes:
        wall_s: Its time.
        cpu_s: The processor's time of it and all its workers.
        peak_mib: Greatest memory of all processes together, shared pages counted for each.
        worker_mib: Greatest memory of any one worker, over the run.
        parent_mib: Memory of the process itself, over the run.
        document: What it printed.
        folder: The project that it ran in.
    """

    wall_s: float
    cpu_s: float
    peak_mib: float
    worker_mib: tuple[float, ...]
    parent_mib: tuple[float, ...]
    document: Mapping[str, Any]
    folder: Path


class Bench:
    """Runs sweeps and remembers those that several rows need."""

    def __init__(self, source: Path, work: Path, *, replicates: int, jobs: int) -> None:
        self._source = source
        self._work = work
        self._numbers = iter(range(10**6))
        self.replicates = replicates
        self.jobs = jobs
        self._shared: Run | None = None

    def project(self) -> Path:
        """A fresh copy of the project, without evidence."""
        folder = self._work / str(next(self._numbers))
        for name in FOLDERS:
            shutil.copytree(self._source / name, folder / name)
        return folder

    def shared(self) -> Run:
        """The sweep with contact from an empty store."""
        if self._shared is None:
            self._shared = self.sweep(self.project(), "--jobs", self.jobs, "--replicates", self.replicates)
        return self._shared

    def sweep(self, folder: Path, *words: object) -> Run:
        """Run a sweep to its end."""
        command = [sys.executable, "-m", "rgss.cli.main", "sweep", "--project", str(folder), "--json"]
        begun = time.perf_counter()
        process = subprocess.Popen([*command, *map(str, words)], stdout=subprocess.PIPE, cwd=REPOSITORY)  # noqa: S603
        with _watched(process.pid) as memory:
            output, _ = process.communicate()
        wall_s = time.perf_counter() - begun
        if process.returncode != 0:
            raise SystemExit(f"rgss sweep {' '.join(map(str, words))} ended with {process.returncode}")
        return Run(
            wall_s=wall_s,
            cpu_s=memory.cpu_s,
            peak_mib=max(memory.total, default=0.0),
            worker_mib=tuple(memory.worker),
            parent_mib=tuple(memory.parent),
            document=json.loads(output),
            folder=folder,
        )


class _Memory:
    """Samples of the memory and processor time of a process and its children."""

    def __init__(self) -> None:
        self.total: list[float] = []
        self.worker: list[float] = []
        self.parent: list[float] = []
        self._cpu: dict[int, float] = {}

    @property
    def cpu_s(self) -> float:
        return sum(self._cpu.values())

    def sample(self, pid: int) -> None:
        sizes = {}
        for child in (pid, *children(pid)):
            with contextlib.suppress(OSError, ValueError, IndexError):
                fields = Path(f"/proc/{child}/stat").read_text().rpartition(")")[2].split()
                self._cpu[child] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
                sizes[child] = int(fields[21]) * os.sysconf("SC_PAGE_SIZE") / MIB
        if pid in sizes:
            self.total.append(sum(sizes.values()))
            self.parent.append(sizes.pop(pid))
            self.worker.append(max(sizes.values(), default=0.0))


@contextlib.contextmanager
def _watched(pid: int) -> Iterator[_Memory]:
    memory, over = _Memory(), threading.Event()

    def watch() -> None:
        while not over.wait(SAMPLE_S):
            memory.sample(pid)

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        yield memory
    finally:
        over.set()
        watcher.join()


def children(pid: int) -> list[int]:
    """The processes that a process has started and that still are."""
    found = []
    for entry in Path(f"/proc/{pid}/task").glob("*/children"):
        with contextlib.suppress(OSError):
            found += [int(word) for word in entry.read_text().split()]
    return found
