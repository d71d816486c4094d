"""The repository as it stands: its files, without what version control ignores."""

from __future__ import annotations

import fnmatch
import os
from collections.abc import Iterator
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def repository() -> Path:
    return Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def files(repository: Path) -> tuple[Path, ...]:
    """Every file of the repository."""
    lines = (repository / ".gitignore").read_text(encoding="utf-8").split()
    return tuple(sorted(_files_below(repository, [".git", *(line.strip("/") for line in lines)])))


@pytest.fixture(scope="session")
def modules(files: tuple[Path, ...], repository: Path) -> tuple[Path, ...]:
    """Every Python file of the package."""
    return tuple(path for path in files if path.suffix == ".py" and path.is_relative_to(repository / "rgss"))


def _files_below(folder: Path, ignored: list[str]) -> Iterator[Path]:
    for place, folders, names in os.walk(folder):
        kept = [name for name in folders if not any(fnmatch.fnmatch(name, pattern) for pattern in ignored)]
        folders[:] = kept
        for name in names:
            if not any(fnmatch.fnmatch(name, pattern) for pattern in ignored):
                yield Path(place, name)
