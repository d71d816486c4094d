"""Runs tests in as many processes as there are cores, each with its share of the files.

pytest-xdist reads every file in every process, which takes longer than the quick tests themselves; here
each file is read by the process that runs its tests. Called by `make fast`, with the options of pytest.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path

import pytest

from rgss.trials.code.kernel_environment import numeric_environment


def files_of_share(files: Iterable[Path], share: int, count: int) -> frozenset[Path]:
    """The files of one share, which are about as many and as large as those of any other.

    Args:
        files: The files of all shares.
        share: Number of the share, from 0.
        count: How many shares there are.
    """
    by_size = sorted(files, key=lambda path: (-path.stat().st_size, path))
    # Back and forth, so that no share has the larger one of each pair.
    turns = [*range(count), *reversed(range(count))]
    return frozenset(path for place, path in enumerate(by_size) if turns[place % len(turns)] == share)


def main(options: Sequence[str], count: int | None = None) -> int:
    """Run the tests and print what each process says, the first as it comes and the others when they have ended.

    Args:
        options: Those of pytest, for each process.
        count: How many processes; None stands for one on each core.

    Returns:
        The exit status: 0 if every test passed, otherwise that of the first process that says something else.
    """
    cores = count or len(os.sched_getaffinity(0))
    environment = numeric_environment(os.environ)
    with ExitStack() as stack:
        texts = [None, *(stack.enter_context(tempfile.TemporaryFile()) for _ in range(cores - 1))]
        processes = [
            stack.enter_context(
                subprocess.Popen(
                    [sys.executable, "-m", "pytest", f"--share={share}/{cores}", *options],
                    env=environment,
                    stdout=text,
                    stderr=None if text is None else subprocess.STDOUT,
                )
            )
            for share, text in enumerate(texts)
        ]
        try:
            statuses = [process.wait() for process in processes]
        except KeyboardInterrupt:
            # The processes have been interrupted as well, and say so.
            statuses = [process.wait() for process in processes]
        for text in filter(None, texts):
            text.seek(0)
            sys.stdout.write(text.read().decode("utf-8", "replace"))
    ran = [status for status in statuses if status != pytest.ExitCode.NO_TESTS_COLLECTED]
    return next((status for status in ran if status), 0) if ran else int(pytest.ExitCode.NO_TESTS_COLLECTED)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
