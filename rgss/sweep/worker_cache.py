"""Folders for the settings and fonts of a worker's plotting library: never in a folder of the worker's own.

matplotlib, which plots of an engine import, makes a temporary folder where the home folder cannot be written, as in
many containers, and removes it when the process ends by itself. Workers do not: they are killed.

This module imports nothing heavy, for worker processes load it before they set their limits.
"""

from __future__ import annotations

import os
import stat
import tempfile
from pathlib import Path

_SETTING = "MPLCONFIGDIR"


def share_plot_cache() -> None:
    """Name one folder of the user for all workers where there would be a temporary one for each."""
    if _SETTING in os.environ or _are_writable():
        return
    try:
        folder = Path(tempfile.gettempdir()) / f"rgss-matplotlib-{os.geteuid()}"
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError:
        return
    # Others may write in the folder around it: what is under this name must be ours, and ours alone.
    if stat.S_ISDIR(found.st_mode) and found.st_uid == os.geteuid() and not found.st_mode & 0o077:
        os.environ[_SETTING] = str(folder)


def _are_writable() -> bool:
    """True if the default folders can be written."""
    for setting, usual in (("XDG_CONFIG_HOME", ".config"), ("XDG_CACHE_HOME", ".cache")):
        try:
            folder = Path(os.environ.get(setting) or Path.home() / usual) / "matplotlib"
            folder.mkdir(parents=True, exist_ok=True)
        except (OSError, RuntimeError):
            return False
        if not os.access(folder, os.W_OK):
            return False
    return True
