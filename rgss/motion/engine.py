"""Lazy import of OMPL, with a workaround for its crash at exit."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple


class Engine(NamedTuple):
    """The modules of OMPL.

    Attributes:
        base: State spaces and problem definitions.
        geometric: Planners.
        util: Random numbers and the log.
    """

    base: Any
    geometric: Any
    util: Any


@lru_cache(maxsize=1)
def load_engine() -> Engine:
    """Import OMPL on first use and silence its log.

    The loader of the 1.7.0 wheel opens a second copy of libompl beside the one that the extension modules link, and the
    interpreter then crashes at exit with status 134 or 139. The extension modules find their library without it, so the
    loader is disabled before they are imported.
    """
    import ompl

    ompl.dll_loader = lambda _library, _path: None
    from ompl import base, geometric, util

    util.setLogLevel(util.LogLevel.LOG_NONE)
    return Engine(base, geometric, util)
