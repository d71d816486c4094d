"""Numbers of things in messages agree with their nouns."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.assessment import FailureDrivers
from rgss.cli.main import main
from rgss.cli.verbs.check import _summary
from rgss.counted import counted
from rgss.evidence import Failure
from rgss.reports.failure_drivers import driver_sentence
from tests.fixtures.serial_arms import FIVE, serial_urdf


@pytest.mark.parametrize(("number", "words"), [(0, "0 trials"), (1, "1 trial"), (2, "2 trials"), (1001, "1001 trials")])
def test_a_noun_is_in_singular_after_1_alone(number, words):
    assert counted(number, "trial") == words


@pytest.mark.engine
def test_an_arm_of_one_joint(tmp_path, capsys):
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(serial_urdf(FIVE[:1]), encoding="utf-8")

    main(["robot", str(urdf)])

    assert "serial: 1 joint to flange, " in capsys.readouterr().out


def test_a_project_of_one_measure_and_one_design():
    project = SimpleNamespace(
        requirements=SimpleNamespace(stakeholder=[1, 2], system=[1, 2, 3]),
        measures=SimpleNamespace(measures=[1]),
        designs=SimpleNamespace(expand=lambda: [1]),
    )

    assert _summary([project], 1, 1) == (
        "2 stakeholder and 3 system requirements, 1 measure, 1 variant: 1 finding, 1 note (--all shows it)"
    )


def test_the_drivers_of_one_failure():
    kind = FailureDrivers(failure=Failure.OBJECT_DROPPED, stage="carry", trials=1, seeds=1, designs=1, drivers=())

    assert "(1 trial, 1 seed)" in driver_sentence(kind)
