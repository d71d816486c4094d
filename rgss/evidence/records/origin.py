"""Provenance beyond the digests: revision of the code, machine, input files."""

from __future__ import annotations

import hashlib
import importlib.metadata
import json
import platform
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path

from rgss.documents import chunks_of
from rgss.errors import EvidenceError

_PACKAGE = Path(__file__).resolve().parents[2]
_PATIENCE_S = 5.0

LARGEST_FILE_BYTES = 4 * 1024**3
"""Greatest size of an input file in bytes; folders of inputs are not meant for recordings."""


def code_revision() -> str:
    """Revision of this code in version control; empty if unknown.

    ``+changes`` is appended for a working copy with changes. An installed package has a revision if it was installed
    from version control.
    """
    package = _PACKAGE
    if _git(package, "ls-files", "--error-unmatch", "__init__.py") is None:
        # The installation folder of rgss may be inside the repository of another project.
        return _installed_from()
    revision = _git(package, "rev-parse", "HEAD")
    if not revision:
        return ""
    return f"{revision}+changes" if _git(package, "status", "--porcelain", "--", ".") else revision


def machine() -> str:
    """System, processor and Python version in one line, without host and user names."""
    parts = (platform.system(), platform.machine(), _processor(), f"Python {platform.python_version()}")
    return ", ".join(part for part in parts if part)


def file_digests(folder: Path, names: Iterable[str]) -> dict[str, str]:
    """SHA-256 of input files by name.

    Args:
        folder: The project's folder.
        names: Files or folders in it; a folder includes all files below it except hidden ones.

    Raises:
        EvidenceError: A file does not exist or cannot be read.
    """
    paths = {path.relative_to(folder).as_posix(): path for name in names for path in _files(folder / name)}
    return {name: _file_digest(name, path) for name, path in sorted(paths.items())}


def _file_digest(name: str, path: Path) -> str:
    """SHA-256 of a file, read in chunks: a mesh or a point cloud may be larger than the memory."""
    hashed = hashlib.sha256()
    try:
        for chunk in chunks_of(path, largest=LARGEST_FILE_BYTES):
            hashed.update(chunk)
    except OSError as error:
        raise EvidenceError(f"the input file {name} cannot be read: {error.strerror}") from error
    return hashed.hexdigest()


def _files(path: Path) -> list[Path]:
    if not path.is_dir():
        return [path]
    # A notebook reads a study but is not an input of it.
    below = (file for file in sorted(path.rglob("*")) if file.is_file() and file.suffix != ".ipynb")
    return [file for file in below if not any(part.startswith(".") for part in file.relative_to(path).parts)]


def _git(package: Path, *arguments: str) -> str | None:
    """Output of git in a folder; None if git is missing or the folder is not in a repository."""
    program = shutil.which("git")
    if program is None:
        return None
    try:
        # The arguments are constant, and no shell is involved.
        done = subprocess.run(  # noqa: S603
            [program, "--no-optional-locks", "-C", str(package), *arguments],
            capture_output=True,
            text=True,
            check=False,
            timeout=_PATIENCE_S,
        )
    except (OSError, ValueError, subprocess.TimeoutExpired):
        return None
    return done.stdout.strip() if done.returncode == 0 else None


def _installed_from() -> str:
    try:
        text = importlib.metadata.distribution("rgss").read_text("direct_url.json")
        origin = json.loads(text or "{}")
        return str(origin["vcs_info"]["commit_id"])
    except (importlib.metadata.PackageNotFoundError, OSError, ValueError, KeyError, TypeError):
        return ""


def _processor() -> str:
    """Name of the processor from Linux, since Python does not provide it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return platform.processor()
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor())
