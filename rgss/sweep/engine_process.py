"""Child process that runs single trials with the numeric environment.

A sweep has workers for that. A script, a notebook or a command was started with the kernels of its processor; it sends
a trial to this process and gets bitwise the result of a sweep. The process keeps its engines loaded, needs no guarded
main module, and ends with its parent.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import threading
import weakref
from collections.abc import Callable
from functools import lru_cache
from multiprocessing.connection import Connection, Pipe
from typing import IO, Any, TypeVar, cast

from rgss.engines import require_engines
from rgss.errors import RgssError, SimulationError
from rgss.sweep.scratch_folder import ScratchFolder, remove_scratch, use_scratch
from rgss.trials.code import is_in_force, numeric_environment

Result = TypeVar("Result")

_LONGEST_WORDS = 300
_BEGIN = """
import sys
sys.path[:] = [entry for entry in sys.path if entry]
from rgss.sweep.engine_process import answer_calls
answer_calls({descriptor}, {scratch!r})
"""


def compute(function: Callable[..., Result], *arguments: Any) -> Result:
    """Call a function in a process that computes as the workers of a sweep do: this one, if it is such a process.

    Args:
        function: A function of a module, imported there by its name.
        arguments: Its arguments; as its result, they must be picklable where another process is needed.

    Raises:
        DefinitionError: An engine is not installed.
        RgssError: As the function raises it.
        SimulationError: The process ended while it was at it, or cannot be started.
    """
    require_engines("a trial")
    if is_in_force():
        return function(*arguments)
    return cast("Result", _engine_process_of(os.getpid()).call(function, arguments))


class EngineProcess:
    """One process that carries out one call at a time."""

    def __init__(self) -> None:
        """Start nothing yet."""
        self._lock = threading.Lock()
        self._child: _Child | None = None

    def call(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Call a function there; see `compute`."""
        with self._lock:
            if self._child is None:
                self._child = _Child()
            child = self._child
            try:
                child.pipe.send((function, arguments))
                error, result = child.pipe.recv()
            except (EOFError, ConnectionError):
                self._child = None
                how = child.end()
                raise SimulationError(f"the process that ran the trial {how}") from None
            except BaseException:
                # No caller waits for its task any more.
                self._child = None
                child.end()
                raise
        if error is not None:
            raise error
        return result

    def close(self) -> None:
        """End the process; another call would start another one."""
        with self._lock:
            child, self._child = self._child, None
        if child is not None:
            child.end()


class _Child:
    """Child process with its pipe and its output."""

    def __init__(self) -> None:
        self.pipe, there = Pipe()
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 - closed with the process
        scratch = ScratchFolder()
        with there, scratch.removed_on_error():
            self._process = subprocess.Popen(  # noqa: S603 - our own command
                [sys.executable, "-c", _BEGIN.format(descriptor=there.fileno(), scratch=scratch.path)],
                env=numeric_environment(os.environ),
                pass_fds=[there.fileno()],
                stdin=subprocess.DEVNULL,
                stdout=self._output,
                stderr=self._output,
                # Ctrl-C reaches a whole group, and only this process answers it.
                start_new_session=True,
            )
        arguments = (self._process, self.pipe, self._output, scratch, os.getpid())
        self._finalizer = weakref.finalize(self, _discard, *arguments)

    def end(self) -> str:
        """End it; returns how it had ended."""
        try:
            status: int | None = self._process.wait(0.5)
        except subprocess.TimeoutExpired:
            status = None
        _kill(self._process, self.pipe)
        tail = self._stderr_tail()
        self._finalizer()
        if status is not None and status < 0:
            with contextlib.suppress(ValueError):
                return f"was killed by {signal.Signals(-status).name}{tail}"
        return f"ended with status {status}{tail}"

    def _stderr_tail(self) -> str:
        size = self._output.seek(0, os.SEEK_END)
        self._output.seek(max(0, size - _LONGEST_WORDS))
        lines = self._output.read().decode("utf-8", "replace").splitlines()
        line = next((" ".join(line.split()) for line in reversed(lines) if line.strip()), "")
        return f": {line}" if line else ""


def _kill(process: subprocess.Popen[bytes], pipe: Connection) -> None:
    pipe.close()
    process.kill()
    process.wait()


def _discard(
    process: subprocess.Popen[bytes], pipe: Connection, output: IO[bytes], scratch: ScratchFolder, owner: int
) -> None:
    if os.getpid() == owner:
        _kill(process, pipe)
        scratch.remove()
    else:
        # In a fork of the owner, which still uses it.
        pipe.close()
        process.returncode = 0
    output.close()


@lru_cache(maxsize=1)
def _engine_process_of(process: int) -> EngineProcess:  # noqa: ARG001 - the key of the cache
    """The engine process of a process: a fork has one of its own, since answers in one pipe would be mixed up.

    Args:
        process: Id of the present process.
    """
    return EngineProcess()


def answer_calls(descriptor: int, scratch: str) -> None:
    """Carry out calls until the other end of the pipe is closed; runs in the process.

    Args:
        descriptor: The pipe's.
        scratch: Folder of temporary files, which is removed in the end; empty for the usual one.
    """
    from rgss.sweep.worker_process import settle

    settle()
    use_scratch(scratch)
    try:
        _answer(Connection(descriptor))
    finally:
        remove_scratch(scratch)


def _answer(pipe: Connection) -> None:
    """Carry out calls until the other end of the pipe is closed."""
    while True:
        try:
            function, arguments = pipe.recv()
        except (EOFError, OSError):
            return
        try:
            answer: tuple[Exception | None, Any] = (None, function(*arguments))
        except RgssError as error:
            answer = (error, None)
        # Errors go to the caller and not to this process's standard error.
        except Exception as error:
            line = f"{type(error).__name__}: {' '.join(str(error).split())}"
            answer = (SimulationError(f"the trial could not be run: {line}"), None)
        try:
            pipe.send(answer)
        except OSError:
            return
