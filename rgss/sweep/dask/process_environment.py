"""Environment of a process as far as its results depend on it, and comparison of two."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from functools import lru_cache

from rgss.evidence.records import results_of

NUMERICS = "numerics of "
"""Prefix of the entries of an environment that describe the numerics."""


def environment() -> dict[str, str]:
    """Environment of this process on which results or the transfer of tasks depend.

    In addition to engines and code these are Python (its `sum` of floats changed in 3.12), the kind of processor, the
    numerics, and Dask. Cached, since loaded libraries do not change. If this process runs no trials itself, the
    numerics are those of its trial processes.

    Raises:
        PackageNotFoundError: An engine is not installed.
        SimulationError: No process can be started to inspect its mathematics.
    """
    return dict(_environment())


def are_alike(found: Mapping[str, str], expected: Mapping[str, str]) -> bool:
    """True if two environments give the same results; names of numerics may differ.

    Args:
        found: The first environment, from `environment`.
        expected: The second environment.
    """
    return _compared(found) == _compared(expected)


def _compared(environment: Mapping[str, str]) -> dict[str, str]:
    return {**environment, **results_of({k: v for k, v in environment.items() if k.startswith(NUMERICS)})}


@lru_cache(maxsize=1)
def _environment() -> Mapping[str, str]:
    from importlib.metadata import version

    from rgss.trials.code import fixed_numerics, versions

    return {
        **versions(),
        "python": ".".join(platform.python_version_tuple()[:2]),
        "processor": platform.machine(),
        "distributed": version("distributed"),
        **{f"{NUMERICS}{part}": text for part, text in fixed_numerics().items()},
    }
