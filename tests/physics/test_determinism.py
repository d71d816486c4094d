"""The same world does the same, to the last bit, in this process and in another."""

import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.engine

SCRIPT = Path(__file__).with_name("grasp_and_lift.py")


@pytest.fixture(scope="module")
def digest():
    return runpy.run_path(str(SCRIPT))["digest"]


def test_fresh_worlds_agree_bit_for_bit(digest):
    assert digest(3) == digest(3)


def test_another_world_in_between_and_beside_changes_nothing(digest, two_fingers):
    alone = digest(3)
    with two_fingers.world() as beside:
        two_fingers.close(beside)
        assert digest(3) == alone
        beside.step()
    assert digest(2) != alone


def test_another_process_agrees_bit_for_bit(digest):
    # Text hashing is seeded differently there, so that the order of a set would show.
    environment = {**os.environ, "PYTHONHASHSEED": "12345", "PYTHONPATH": str(Path(__file__).parents[2])}
    run = subprocess.run([sys.executable, str(SCRIPT)], capture_output=True, text=True, check=True, env=environment)
    assert run.stdout.split() == [digest(2), digest(3)]
