"""PDF of a page, printed by an installed browser."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from rgss.errors import DefinitionError

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
"""Names of browsers that print a page; the first one found is used."""

_LIMIT_S = 180.0


def printing_browser() -> str:
    """Path of the browser that prints.

    Raises:
        DefinitionError: None is installed.
    """
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        raise DefinitionError(
            "--pdf needs Chromium, which is not installed",
            hint="apt-get install chromium, or print the page in a browser",
        )
    return found


def print_page(page: Path, browser: str) -> bytes:
    """A page as PDF.

    Args:
        page: The file of the self-contained HTML page.
        browser: The browser, from `printing_browser`.

    Raises:
        DefinitionError: The browser printed nothing.
    """
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "page.pdf"
        words = [browser, "--headless", "--disable-gpu", "--no-pdf-header-footer", f"--user-data-dir={folder}/profile"]
        # As root, as in a container, the browser's own sandbox cannot start; the page is ours and runs no other script.
        words += ["--no-sandbox"] if os.name == "posix" and os.geteuid() == 0 else []
        with contextlib.suppress(OSError, subprocess.TimeoutExpired):
            subprocess.run(  # noqa: S603 - a browser that was looked for, with a page of this package
                [*words, f"--print-to-pdf={target}", page.resolve().as_uri()],
                capture_output=True,
                timeout=_LIMIT_S,
                check=False,
            )
        if not target.exists():
            raise DefinitionError(
                f"{Path(browser).name} did not print the page", hint="omit --pdf and print the page in a browser"
            )
        return target.read_bytes()
