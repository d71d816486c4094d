"""Versions of code and engines on which each piece of a trial depends."""

from __future__ import annotations

import importlib.metadata
from collections import Counter
from collections.abc import Iterable, Mapping
from functools import lru_cache
from types import MappingProxyType

from rgss.engines import missing_engines, require_engines
from rgss.trials.code.closure_cache import PieceSources, cached_sources
from rgss.trials.code.code_fingerprint import SourceClosure, SourceTree, own_sources

ENGINES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "pybullet": ("pybullet",),
        "ompl": ("ompl",),
        "pinocchio": ("pin", "coal"),
        "coal": ("coal",),
        "eaik": ("eaik",),
        "toppra": ("toppra",),
        "numpy": ("numpy",),
        "scipy": ("scipy",),
        "highspy": ("highspy",),
    }
)
"""Distributions of the third-party modules that the code of a piece imports."""

ENTRIES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "plan": ("rgss.trials.pieces.pieces:make_plan",),
        "timing": ("rgss.trials.pieces.pieces:make_timing",),
        "execution": ("rgss.trials.pieces.pieces:make_execution",),
        "bench": ("rgss.trials.pieces.pieces:make_bench",),
        # The second assembles a trial without shared pieces from the results of the others.
        "record": ("rgss.trials.pieces.pieces:record_of", "rgss.trials.pieces.run:"),
    }
)
"""Entry points: the worker function of each piece, and those that assemble the record."""

_EVERYWHERE = ("rgss.trials.code.kernel_environment",)
"""Code that affects results without being imported: the numeric environment of a worker."""

NOT_INSTALLED = "not installed"
"""Version of an engine with a version in neither the installation nor the evidence."""

_CODE = "rgss-"

_assumed: dict[str, str] = {}


def versions() -> dict[str, str]:
    """Installed version of each engine, and for each piece a digest of its source code.

    The digest prevents the use of evidence made by other code. An installation without engines has the versions passed
    to `assume_engines`.

    Raises:
        DefinitionError: An engine is not installed, and no versions are assumed.
    """
    if not missing_engines():
        return {**_installed(), **_code()}
    if not _assumed:
        require_engines("a trial")
    return {**_assumed, **_code()}


def assume_engines(recorded: Iterable[Mapping[str, str]]) -> None:
    """Assume the engine versions of the stored evidence if engines are not installed.

    An installation without engines has no versions of its own for the lookup of trials. The most frequent versions
    among the trials of the present code are assumed, or among all trials if the code has changed. With all engines
    installed, this does nothing.

    Args:
        recorded: The versions in the provenance of each stored trial; read only if an engine is missing.
    """
    if not missing_engines():
        return
    code, names = _code(), _engine_names()
    census = Counter(
        (all(found.get(name) == text for name, text in code.items()), tuple(found.get(name, "") for name in names))
        for found in recorded
    )
    most = max(((present, count, texts) for (present, texts), count in census.items()), default=(False, 0, ()))[2]
    _assumed.clear()
    _assumed.update(dict(zip(names, most or [NOT_INSTALLED] * len(names), strict=True)))


def versions_of(piece: str, among: Mapping[str, str]) -> dict[str, str]:
    """Versions on which a piece depends directly, without those of the pieces before it.

    Args:
        piece: ``plan``, ``timing``, ``execution``, ``bench`` or ``record``.
        among: Versions in the form of `versions`; missing ones are skipped.
    """
    return {name: among[name] for name in _names_of(piece) if name in among}


def are_of_this_kind(found: Mapping[str, str]) -> bool:
    """True if versions have a source digest for each piece; earlier releases stored one for all pieces.

    Args:
        found: Versions of a trial's provenance.
    """
    return all(f"{_CODE}{piece}" in found for piece in ENTRIES)


def source_of(piece: str) -> SourceClosure:
    """Modules and engines on which a piece depends.

    Args:
        piece: ``plan``, ``timing``, ``execution``, ``bench`` or ``record``.
    """
    return _sources().closures[piece]


def code_of_trials() -> dict[str, str]:
    """Short digest of each module on which any piece of a trial depends, by name."""
    return {module: digest[:12] for module, digest in _sources().modules.items()}


def sources_in(tree: SourceTree) -> PieceSources:
    """Source code of the pieces in a source tree, found by parsing it.

    Args:
        tree: The tree of this package, or of a changed copy.
    """
    closures = {piece: tree.closure_of((*entries, *_EVERYWHERE)) for piece, entries in ENTRIES.items()}
    modules = sorted({module for closure in closures.values() for module in closure.modules})
    return PieceSources(closures=closures, modules={module: tree.module_digest(module) for module in modules})


@lru_cache(maxsize=1)
def _sources() -> PieceSources:
    return cached_sources(own_sources().folder, lambda: sources_in(own_sources()))


def _engine_names() -> tuple[str, ...]:
    return tuple(sorted({name for names in ENGINES.values() for name in names}))


@lru_cache(maxsize=1)
def _installed() -> Mapping[str, str]:
    return {name: importlib.metadata.version(name) for name in _engine_names()}


@lru_cache(maxsize=1)
def _code() -> Mapping[str, str]:
    return {f"{_CODE}{piece}": source_of(piece).digest for piece in ENTRIES}


@lru_cache(maxsize=len(ENTRIES))
def _names_of(piece: str) -> tuple[str, ...]:
    engines = {name for module in source_of(piece).foreign for name in ENGINES.get(module, ())}
    return (*sorted(engines), f"{_CODE}{piece}")
