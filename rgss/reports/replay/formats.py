"""File formats of a replay: a page, and files for other viewers, whose packages are optional."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from rgss.errors import DefinitionError

PAGE_SUFFIX = ".html"
"""Suffix of a page, the only format that shows two trials and needs no further package."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ViewerPackage:
    """Package that writes the files of a viewer.

    Attributes:
        module: Its module.
        distribution: Its name in an index of packages.
        extra: The extra that installs it.
    """

    module: str
    distribution: str
    extra: str


VIEWER_PACKAGES: Mapping[str, ViewerPackage] = MappingProxyType(
    {".mcap": ViewerPackage(module="mcap", distribution="mcap", extra="mcap")}
)
"""Package of each format for another viewer, by suffix."""

REPLAY_SUFFIXES = (PAGE_SUFFIX, *VIEWER_PACKAGES)
"""Suffixes of the files of a replay."""


def require_viewer_package(path: Path) -> None:
    """Require that the package that writes a file is installed.

    Args:
        path: The file, whose suffix selects the format.

    Raises:
        DefinitionError: The package is not installed.
    """
    package = VIEWER_PACKAGES.get(path.suffix.lower())
    if package is not None and importlib.util.find_spec(package.module) is None:
        raise DefinitionError(
            f"a {path.suffix.lower()} file needs the package {package.distribution}, which is not installed",
            hint=f"pip install 'rgss[{package.extra}]', or name a {PAGE_SUFFIX} file",
        )
