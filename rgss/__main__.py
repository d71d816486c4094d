"""``python -m rgss``: the command line."""

from __future__ import annotations

import runpy

if __name__ == "__main__":
    runpy.run_module("rgss.cli.main", run_name="__main__")
