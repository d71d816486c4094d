"""Environment of a process as far as its results depend on it, and comparison of two."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from functools import lru_cache

from rgss.evidence.records import results_of

NUMERICS = "numerics of "
"""Prefix of the entries of an environment that describe the numerics."""


def environment() -> dict[str, str]:
    """Environment of this process, as far as results or the transfer of tasks depend on it.

    Beside the engines and the code these are Python (its `sum` of floats is another one from 3.12 on),
    the kind of processor, what the mathematics computes, and Dask. It is looked up once: a process keeps what it
    has loaded. Where this process makes no trials itself, the mathematics is that of the processes which do.

    Raises:
        PackageNotFoundError: An engine is not installed.
        SimulationError: No process can be started to inspect its mathematics.
    """
    return dict(_environment())


def are_alike(found: Mapping[str, str], expected: Mapping[str, str]) -> bool:
    """True if two environments make the same results; what computes the same may go by another name.

    Args:
        found: The one environment, as `environment` gives it.
        expected: The other.
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
