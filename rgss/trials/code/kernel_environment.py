"""Numeric environment of a trial process: the same numerical kernels on every x86-64 processor.

OpenBLAS, NumPy and the C library's mathematics select their kernels by the processor when a process starts. Kernels
differ in the last bits, which contact amplifies. Environment variables, read at start-up, select kernels that every
processor has, without AVX and fused multiply-add. The selection cannot be changed later, so trials run in processes
started with these variables.
"""

from __future__ import annotations

import os
import platform
import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType

KERNEL = "Nehalem"
"""OpenBLAS's kernels: the newest that require at most SSE 4.2, which NumPy requires too."""

WITHOUT = ("FMA", "FMA4", "FMA_Usable", "FMA4_Usable")
"""Processor features excluded for the C library's mathematics, by their names before and since glibc 2.33."""

ONE_THREAD: Mapping[str, str] = MappingProxyType(
    dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
)
"""The rounding of a sum that is divided among threads depends on their number."""

_CORE, _TUNABLES = "OPENBLAS_CORETYPE", "GLIBC_TUNABLES"
_DISABLED, _ENABLED = "NPY_DISABLE_CPU_FEATURES", "NPY_ENABLE_CPU_FEATURES"
_CAPABILITIES = "glibc.cpu.hwcaps"
_STARTING = threading.Lock()


def numeric_environment(inherited: Mapping[str, str]) -> dict[str, str]:
    """Environment variables of a trial process.

    Args:
        inherited: Its other variables; their settings of kernels and threads are overridden.
    """
    chosen = {**inherited, **ONE_THREAD}
    if _is_x86_64():
        chosen[_CORE] = KERNEL
        chosen[_TUNABLES] = _tunables(inherited.get(_TUNABLES, ""))
    # NumPy rejects both variables together.
    chosen.pop(_ENABLED, None)
    chosen[_DISABLED] = " ".join(sorted({*_dispatched(), *_words(inherited.get(_DISABLED, ""))}))
    return chosen


def is_in_force() -> bool:
    """True if this process was started with the numeric environment."""
    return problem_here() == ""


def problem_here() -> str:
    """Deviation of this process's start environment from the numeric environment; empty if there is none."""
    return problem_in(_started_with())


def problem_in(environment: Mapping[str, str]) -> str:
    """Deviation of a process's start environment from the numeric environment; empty if there is none."""
    wanted: dict[str, str] = dict(ONE_THREAD)
    if _is_x86_64():
        wanted[_CORE] = KERNEL
    for name, value in wanted.items():
        if environment.get(name) != value:
            return f"{name} is {environment.get(name, 'not set')} instead of {value}"
    if _is_x86_64() and not {f"-{name}" for name in WITHOUT} <= {*_capabilities(environment.get(_TUNABLES, ""))}:
        return f"{_TUNABLES} does not restrict the C library's kernels"
    return f"{_DISABLED} is not set" if _DISABLED not in environment else ""


@contextmanager
def numeric_environment_of_children() -> Iterator[None]:
    """Context in which child processes are started with the numeric environment; this process keeps its own."""
    with _STARTING:
        before = dict(os.environ)
        chosen = numeric_environment(before)
        changed = {name for name in {*before, *chosen} if before.get(name) != chosen.get(name)}
        _set({name: chosen.get(name) for name in changed})
        try:
            yield
        finally:
            _set({name: before.get(name) for name in changed})


def _set(values: Mapping[str, str | None]) -> None:
    for name, value in values.items():
        if value is None:
            os.environ.pop(name, None)
        else:
            os.environ[name] = value


def _started_with() -> Mapping[str, str]:
    """Environment at the start of this process; the present one on systems that do not provide it."""
    try:
        entries = Path("/proc/self/environ").read_bytes().split(b"\0")
    except OSError:
        return os.environ
    pairs = (os.fsdecode(entry).partition("=") for entry in entries if entry)
    return {name: value for name, _, value in pairs}


def _tunables(inherited: str) -> str:
    """C library tunables of the user, with ours added."""
    others = [one for one in inherited.split(":") if one and one.partition("=")[0] != _CAPABILITIES]
    ours = [f"-{name}" for name in WITHOUT]
    kept = [one for one in _capabilities(inherited) if one.lstrip("-") not in WITHOUT]
    return ":".join([*others, f"{_CAPABILITIES}={','.join([*kept, *ours])}"])


def _capabilities(tunables: str) -> list[str]:
    found = [one.partition("=")[2] for one in tunables.split(":") if one.partition("=")[0] == _CAPABILITIES]
    return [name for one in found for name in one.split(",") if name]


def _dispatched() -> list[str]:
    """Processor features by which NumPy would dispatch kernels on this processor."""
    import numpy as np

    found = np.show_config(mode="dicts").get("SIMD Extensions", {}).get("found", [])
    return [str(name) for name in found]


def _words(text: str) -> list[str]:
    return text.replace(",", " ").split()


def _is_x86_64() -> bool:
    return platform.machine().lower() in ("x86_64", "amd64") and sys.maxsize > 2**32
