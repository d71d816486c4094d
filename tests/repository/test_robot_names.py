"""No robot has its name in the code: what is known of one is data."""

from __future__ import annotations

import re
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "rgss"
NAMES = re.compile(r"ur10|kuka|iiwa|panda(?!s)|yumi|lite6|xarm|kinova", re.IGNORECASE)


def test_no_robot_is_named_in_the_code():
    # Sentences of requirements name products, and their grammar is tried on such names; a driver is named as the
    # vendor's SDK that it calls.
    named = {"sentences", "wording", "drivers", "driven"}
    files = [path for path in PACKAGE.rglob("*.py") if not named & {*path.parts}]
    found = {
        f"{path.relative_to(PACKAGE)}:{number}"
        for path in files
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
        if NAMES.search(line)
    }
    assert len(files) > 500
    assert found == set()
