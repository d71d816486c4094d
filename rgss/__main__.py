"""``python -m rgss``."""

from __future__ import annotations

import sys

from rgss.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
