"""Trials of an arm whose URDF states its axes with another length."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.evidence import Fidelity
from rgss.scenes import load_robot
from rgss.studies.expansion import trial_specs
from rgss.trials.pieces import run_trial

SCENES = Path(__file__).parents[2] / "scenes"


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", [Fidelity.CONTACT, Fidelity.DYNAMIC])
def test_the_record_of_a_trial_does_not_depend_on_the_length_of_the_axes(shipped, tmp_path, fidelity):
    (spec,) = trial_specs(shipped, variants=[shipped.designs.variant(65)], seeds=[1])
    spec = replace(spec, fidelity=fidelity)
    robots = shutil.copytree(SCENES / "robots", tmp_path / "robots")
    text = (robots / "ur10.urdf").read_text(encoding="utf-8")
    lengths = iter(("2", "0.5", "30", "1e-3", "7", "1.001"))
    scaled = re.sub(r'<axis xyz="0 0 1"/>', lambda _: f'<axis xyz="0 0 {next(lengths)}"/>', text)
    assert next(lengths, None) is None
    (robots / "ur10.urdf").write_text(scaled, encoding="utf-8")
    robot = load_robot(robots / "ur10.yaml", base=spec.scene.robot.base, label="ur10.yaml", project=tmp_path)
    record = run_trial(spec)
    assert record.success
    assert run_trial(replace(spec, scene=replace(spec.scene, robot=robot))) == record
