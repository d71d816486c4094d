"""Import of toppra without that of its plots, which takes longer than the rest of it."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from types import ModuleType
from typing import Any

_PLOTS = ("matplotlib", "matplotlib.pyplot")


class _Deferred(ModuleType):
    """A module that is imported when something of it is used."""

    def __getattr__(self, name: str) -> Any:
        module = importlib.import_module(self.__name__)
        if module is self:
            raise AttributeError(f"{self.__name__} is not imported yet")
        return getattr(module, name)


@cache
def load_toppra() -> Any:
    """The package toppra; its own plots import matplotlib when they are drawn."""
    with _deferred_plots():
        import toppra
    return toppra


@contextmanager
def _deferred_plots() -> Iterator[None]:
    """Stand-ins for the modules of plots, unless they are imported already; removed at the end."""
    if any(name in sys.modules for name in _PLOTS):
        yield
        return
    package, plots = (_Deferred(name) for name in _PLOTS)
    package.__dict__["pyplot"] = plots
    sys.modules.update(zip(_PLOTS, (package, plots), strict=True))
    try:
        yield
    finally:
        for name in _PLOTS:
            del sys.modules[name]
