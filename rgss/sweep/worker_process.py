"""Main loop of a worker process: it answers one task at a time until the parent closes the pipe.

This module imports nothing heavy, so that the process can set its limits before engines are loaded.
"""

from __future__ import annotations

import contextlib
import gc
import os
import pickle
import sys
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from multiprocessing import connection, parent_process, resource_tracker
from typing import Any

from rgss.sweep.scratch_folder import remove_scratch, use_scratch
from rgss.sweep.worker_wire import LONGEST_ANSWER, BlockingChannel
from rgss.trials.code import ONE_THREAD, problem_here

_STANDARD_OUTPUT, _STANDARD_ERROR = 1, 2
_OBJECTS_BETWEEN_COLLECTIONS = 50_000
_MIB = 1024 * 1024
_LARGEST_OUTPUT = 16 * _MIB
# The numbers of two settings of glibc's malloc (malloc.h).
_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3


@dataclass(frozen=True, slots=True, kw_only=True)
class Ready:
    """The worker has started and takes tasks.

    Attributes:
        error: Reason that it cannot, in one line; empty if it can.
    """

    error: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """Response to a task.

    Attributes:
        task: The number of the task.
        result: The result; None if there is none.
        error: The exception that ended it, in one line; empty if there was none.
        ours: True for a deliberate exception of this package.
        out_of_memory: True if memory was exhausted.
        took_s: The task's time by the wall clock.
    """

    task: int
    result: Any
    error: str
    ours: bool
    out_of_memory: bool
    took_s: float


def settle() -> None:
    """Make this process one that makes pieces and nothing else; to be called before an engine or NumPy is loaded."""
    # The processes share the cores between them; threads within one would only get in their way.
    for name, threads in ONE_THREAD.items():
        os.environ.setdefault(name, threads)
    _keep_freed_memory()
    # Most of the process's objects are those of the engines and stay; they need not be looked through so often.
    gc.set_threshold(_OBJECTS_BETWEEN_COLLECTIONS)


def serve(
    function: bytes,
    requests: connection.Connection,
    memory_limit_bytes: int,
    output: connection.Connection,
    scratch: str = "",
) -> None:
    """Run tasks until the parent closes the pipe.

    Args:
        function: Function that computes a result from a task's arguments, pickled by name.
        requests: Pipe of numbered arguments and responses.
        memory_limit_bytes: Greatest size of the process's data; 0 for no limit.
        output: File for the engines' output, read for the cause of a crash.
        scratch: Folder of temporary files, which is removed if the parent is killed; empty for the usual one.
    """
    settle()
    _leave_the_tracker()
    _redirect_output(output)
    _limit_memory(memory_limit_bytes)
    _limit_output()
    use_scratch(scratch)
    _end_with_parent(scratch)
    channel = BlockingChannel(requests)
    problem = problem_here()
    if problem:
        channel.send(pickle.dumps(Ready(error=f"it would compute with other kernels: {problem}")))
        return
    # From here on engines may be loaded. What is read here was written by the process that started this one.
    try:
        make = pickle.loads(function)  # noqa: S301
    # Importing the function's module can raise anything; it is reported, so that the parent does not wait.
    except Exception as error:
        channel.send(pickle.dumps(Ready(error=_line(error))))
        return
    channel.send(pickle.dumps(Ready()))
    while True:
        try:
            task, arguments = pickle.loads(channel.receive())  # noqa: S301
        except (EOFError, OSError):
            return
        # What is in the file when the process dies was printed by the task that it died of.
        os.ftruncate(_STANDARD_OUTPUT, 0)
        try:
            channel.send(_packed(answer_to(make, arguments, task=task)))
        except OSError:
            return


def _packed(answer: Answer) -> bytes:
    """An answer as it is sent; in place of a result that cannot be sent, why it cannot."""
    try:
        packed = pickle.dumps(answer)
        if len(packed) <= LONGEST_ANSWER:
            return packed
        problem = f"the result has {len(packed)} bytes; at most {LONGEST_ANSWER} are read"
    # A result may be of anything, and its pickling run anything.
    except Exception as error:
        problem = _line(error)
    return pickle.dumps(replace(answer, result=None, error=problem))


def answer_to(make: Callable[..., Any], arguments: Sequence[Any], *, task: int = 0) -> Answer:
    """Carry out one task.

    Args:
        make: Function that makes a result.
        arguments: Its arguments.
        task: The number that the task was given.
    """
    from time import perf_counter

    from rgss.errors import RgssError

    result, error, ours, out_of_memory = None, "", False, False
    begun = perf_counter()
    try:
        result = make(*arguments)
    except MemoryError:
        error, out_of_memory = "MemoryError", True
    except RgssError as caught:
        error, ours = str(caught), True
    # A task that breaks costs itself and not the worker.
    except Exception as caught:
        error = _line(caught)
    took_s = perf_counter() - begun
    return Answer(task=task, result=result, error=error, ours=ours, out_of_memory=out_of_memory, took_s=took_s)


def _line(error: Exception) -> str:
    """An exception that is not ours, in one line."""
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def _redirect_output(output: connection.Connection) -> None:
    for standard in (_STANDARD_OUTPUT, _STANDARD_ERROR):
        os.dup2(output.fileno(), standard)
    output.close()


def _leave_the_tracker() -> None:
    """Close the pipe to Python's resource tracker, which belongs to the sweep; nothing is shared."""
    tracker = getattr(resource_tracker, "_resource_tracker", None)
    descriptor = getattr(tracker, "_fd", None)
    if isinstance(descriptor, int):
        with contextlib.suppress(OSError):
            os.close(descriptor)
        # It would be begun anew if it were needed.
        setattr(tracker, "_fd", None)  # noqa: B010 - the name is not public


def _limit_output() -> None:
    """Limit the size of written files, so that a library with endless output fills neither memory nor disk."""
    if sys.platform == "win32":
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    limits = [limit for limit in (soft, hard) if limit != resource.RLIM_INFINITY]
    with contextlib.suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_FSIZE, (min([_LARGEST_OUTPUT, *limits]), hard))


def _limit_memory(limit_bytes: int) -> None:
    """Limit the size of allocations; on Linux only written memory counts, not mapped memory."""
    if not limit_bytes or sys.platform == "win32":
        return
    import resource

    kind = resource.RLIMIT_DATA if sys.platform == "linux" else resource.RLIMIT_AS
    _, hard = resource.getrlimit(kind)
    limit = limit_bytes if hard == resource.RLIM_INFINITY else min(limit_bytes, hard)
    with contextlib.suppress(ValueError, OSError):
        resource.setrlimit(kind, (limit, hard))


def _keep_freed_memory() -> None:
    """Keep freed memory in the process, if its C library can be configured.

    The physics engine uses some megabytes for each world; returning them to the kernel and mapping them again takes
    longer than the rest of building a world.
    """
    if sys.platform != "linux":
        return
    import ctypes

    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt is not None:
        mallopt(_M_MMAP_THRESHOLD, 32 * _MIB)
        mallopt(_M_TRIM_THRESHOLD, 512 * _MIB)


def _end_with_parent(scratch: str) -> None:
    """End this process when its parent does, even when that is killed, and even in the middle of a task.

    Args:
        scratch: Folder of temporary files, which the parent cannot remove any more.
    """
    parent = parent_process()
    if parent is None:
        return
    sentinel = parent.sentinel

    def watch() -> None:
        connection.wait([sentinel])
        remove_scratch(scratch)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
