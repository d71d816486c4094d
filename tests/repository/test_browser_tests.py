"""The tests that need a browser, on machines without one."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest


@pytest.fixture
def browser_tests(repository, tmp_path):
    """Runs the tests that need a browser where no program is found."""

    def run(**variables):
        environment = {name: value for name, value in os.environ.items() if name != "CI"} | variables
        environment["PATH"] = str(tmp_path)
        return subprocess.run(
            [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/browser"],
            cwd=repository,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )

    return run


def test_they_are_skipped_in_one_line_that_says_what_to_install(browser_tests):
    run = browser_tests()

    assert run.returncode == 0, run.stdout
    assert re.fullmatch(r"\d+ skipped in [\d.]+s", run.stdout.splitlines()[-1])
    skipped = [line for line in run.stdout.splitlines() if line.startswith("SKIPPED")]
    assert len(skipped) == 1
    assert "apt-get install chromium chromium-driver" in skipped[0]


def test_they_must_run_on_a_build_machine(browser_tests):
    run = browser_tests(CI="true")

    assert run.returncode == 1
    assert re.fullmatch(r"\d+ (failed|errors?) in [\d.]+s", run.stdout.splitlines()[-1])
    assert "apt-get install chromium chromium-driver" in run.stdout
