"""Numerics of a process: names of numerical kernels, and digests of the results of fixed problems."""

from __future__ import annotations

import ctypes
import hashlib
import json
import math
import os
import platform
import struct
import subprocess
import sys
from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rgss.errors import SimulationError
from rgss.evidence.records import Numerics
from rgss.trials.code.kernel_environment import is_in_force, numeric_environment

if TYPE_CHECKING:
    from numpy.typing import NDArray

_POINTS = 4096
_DIGITS = 12
_CORE_NAMES = (
    "scipy_openblas_get_corename64_",
    "scipy_openblas_get_corename",
    "openblas_get_corename64_",
    "openblas_get_corename",
)
_WHEELS = frozenset({"numpy.libs", "scipy.libs"})
_SIZES = (1, 2, 3, 4, 6, 7, 8, 16, 33, 100)
_TELL = """
import sys
sys.path[:] = [entry for entry in sys.path if entry]
import json
from rgss.trials.code.numeric_probe import numerics
print(json.dumps(dict(numerics())))
"""


@lru_cache(maxsize=1)
def numerics() -> Numerics:
    """Numerics of this process."""
    return {
        "platform": f"{platform.system()} {platform.machine()}".replace(" ", "-"),
        "libm": f"{_c_library()} {_digest(_libm_results())}",
        "numpy": f"{_simd()} {_digest(_numpy_results())}",
        # Last, since it loads the libraries from which the names are read.
        "blas": _blas(),
    }


@lru_cache(maxsize=1)
def fixed_numerics() -> Numerics:
    """Numerics of a trial process on this machine, with the numeric environment.

    Raises:
        SimulationError: Such a process cannot be started.
    """
    if is_in_force():
        return numerics()
    done = subprocess.run(  # noqa: S603 - our own words
        [sys.executable, "-c", _TELL], env=numeric_environment(os.environ), capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise SimulationError(
            f"the probe process of the numerics failed: {lines[-1] if lines else 'it printed nothing'}"
        )
    found: dict[str, str] = json.loads(done.stdout.splitlines()[-1])
    return found


def _digest(numbers: Iterable[float]) -> str:
    values = list(numbers)
    return hashlib.sha256(struct.pack(f"<{len(values)}d", *values)).hexdigest()[:_DIGITS]


def _c_library() -> str:
    try:
        return os.confstr("CS_GNU_LIBC_VERSION") or "unknown"
    except (AttributeError, ValueError, OSError):  # another C library than GNU's
        return "unknown"


def _fractions(count: int, step: float = 0.6180339887498949) -> list[float]:
    """Evenly spread numbers between 0 and 1, independent of the processor."""
    return [math.fmod(0.5 + index * step, 1.0) for index in range(count)]


def _libm_results() -> Iterable[float]:
    turn: tuple[Callable[[float], float], ...] = (math.sin, math.cos, math.tan, math.atan, math.tanh)
    inverse: tuple[Callable[[float], float], ...] = (math.asin, math.acos, math.atanh)
    growth: tuple[Callable[[float], float], ...] = (math.exp, math.sinh, math.cosh)
    positive: tuple[Callable[[float], float], ...] = (math.log, math.log10, math.log2, math.log1p, math.sqrt)
    for x, y in zip(_fractions(_POINTS), _fractions(_POINTS, 0.4142135623730951), strict=True):
        for one in turn:
            yield one(20.0 * x - 10.0)
        for one in inverse:
            yield one(1.99 * x - 0.995)
        for one in growth:
            yield one(8.0 * x - 4.0)
        for one in positive:
            yield one(100.0 * x + 1e-3)
        yield math.atan2(2.0 * x - 1.0, 2.0 * y - 1.0)
        yield math.hypot(x, y)
        # Python's implementation, whose algorithm has changed between versions.
        yield math.hypot(x, y, x - y)
        yield math.dist((x, y, 1.0), (y, 0.5, x))
        yield math.pow(x + 0.1, 6.0 * y - 3.0)


def _simd() -> str:
    import numpy as np

    extensions = np.show_config(mode="dicts").get("SIMD Extensions", {})
    return "+".join([*extensions.get("baseline", []), *extensions.get("found", [])]) or "unknown"


def _numpy_results() -> Iterable[float]:
    import numpy as np

    x = np.array(_fractions(997)) + 1e-3
    y = np.array(_fractions(997, 0.4142135623730951)) + 1e-3
    parts = [one(10.0 * x - 5.0) for one in (np.sin, np.cos, np.tan, np.exp, np.arctan, np.tanh, np.sinh)]
    parts += [one(0.9 * x) for one in (np.arcsin, np.arccos)]
    parts += [one(x) for one in (np.sqrt, np.log, np.log1p, np.cbrt, np.reciprocal)]
    parts += [one(x, y) for one in (np.arctan2, np.hypot, np.power, np.fmod)]
    for count in _SIZES:
        rows, columns = x[: 9 * count].reshape(-1, 9), y[: 9 * count].reshape(-1, 9)
        parts += [
            rows.sum(axis=0),
            rows.sum(axis=1),
            np.cumsum(rows[:, 0]),
            np.einsum("ij,ij->i", rows, columns),
            np.einsum("ij,ij->j", rows, columns),
            np.cross(rows[:, :3], columns[:, :3]),
            np.array([rows.sum(), rows.mean(), rows.std(), np.interp(0.3, np.sort(x), y)]),
        ]
    for part in parts:
        yield from part.ravel().tolist()


def _blas() -> str:
    import numpy as np
    import scipy.linalg  # loads the library bundled with it

    results: list[float] = []
    for count in _SIZES:
        a = _matrix(count, 0.7548776662466927)
        b = _matrix(count, 0.5698402909980532)
        regular = a + count * np.eye(count)
        parts: list[Any] = [a @ b, a @ b.T, a.T @ b, a @ b[0], a[0] @ b[0], np.linalg.norm(a[0])]
        parts += [np.linalg.svd(a, compute_uv=False), np.linalg.solve(regular, b), np.linalg.det(regular)]
        parts += [np.linalg.inv(regular), np.linalg.pinv(a), np.linalg.eigvalsh(a + a.T)]
        parts += [scipy.linalg.expm(0.1 * a), scipy.linalg.solve(regular, b), scipy.linalg.svdvals(a)]
        for part in parts:
            results += np.asarray(part, dtype=float).ravel().tolist()
    return f"{_kernels()} {_digest(results)}"


def _matrix(count: int, step: float) -> NDArray[Any]:
    import numpy as np

    return np.array(_fractions(count * count, step)).reshape(count, count) - 0.5


def _kernels() -> str:
    """Kernel names of each OpenBLAS of NumPy and SciPy, if the system lists loaded libraries.

    If these have none of their own, of each loaded OpenBLAS. Other libraries do not contribute to the digested results,
    and depend on what else a process has loaded.
    """
    try:
        lines = Path("/proc/self/maps").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return "unknown"
    files = sorted({line.split(maxsplit=5)[5] for line in lines if "openblas" in line.rpartition("/")[2]})
    own = [file for file in files if not _WHEELS.isdisjoint(Path(file).parts)]
    return "+".join(_kernel(file) for file in own or files) or "unknown"


def _kernel(file: str) -> str:
    try:
        library = ctypes.CDLL(file)
    except OSError:
        return "unknown"
    for name in _CORE_NAMES:
        function = getattr(library, name, None)
        if function is not None:
            function.restype = ctypes.c_char_p
            function.argtypes = []
            return bytes(function() or b"unknown").decode("ascii", "replace")
    return "unknown"
