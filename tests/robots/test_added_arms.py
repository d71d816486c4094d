"""A second arm in a project, for its designs to choose."""

from __future__ import annotations

import shutil
from dataclasses import replace

import pytest

from rgss.cli.main import main
from rgss.evidence import Fidelity
from rgss.studies import load_project, trial_specs
from rgss.studies.robot_project import adding
from rgss.studies.robot_project.writing import RobotProject
from rgss.trials.pieces import run_trial
from tests.fixtures.edited_files import edit
from tests.robots.conftest import urdf_of

CATALOGUE, SPACE = "designs/catalogue.yaml", "designs/design_space.yaml"
ARM = "  - {id: arm, name: arm, symbol: a, kind: name, sets: catalogue.manipulator, description: The arm.}\n"


@pytest.fixture
def both(projects, tmp_path, monkeypatch):
    """A project round an arm of seven joints, to which one of six may be added as the session made it."""

    def written(urdf, folder, **options):
        assert urdf == urdf_of("six")
        assert options.pop("on_stage") is not None
        shutil.copytree(projects["six"], folder)
        names = (path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
        return RobotProject(files=tuple(sorted(names)), notes=())

    monkeypatch.setattr(adding, "write_robot_project", written)
    folder = tmp_path / "both"
    shutil.copytree(projects["seven"], folder)
    return folder


def test_what_is_printed_lets_the_designs_choose_it(both, capsys):
    before = {path: path.read_bytes() for path in both.rglob("*") if path.is_file()}
    assert main(["init", "--robot", str(urdf_of("six")), "--add", str(both)]) == 0
    printed = capsys.readouterr().out
    assert {path: path.read_bytes() for path in before} == before
    component = printed[printed.index("  - id: ") : printed.index("A design parameter")]
    assert ARM in printed
    edit(both, CATALOGUE, "\n  - id: kg-2\n", f"\n{component}\n  - id: kg-2\n")
    edit(both, SPACE, "\nconstants:\n", f"{ARM}\nconstants:\n")
    factor = "  - {id: arm, name: Arm, levels: [{id: a, sets: {arm: lbr_iiwa}}, {id: b, sets: {arm: xarm6}}]}\n"
    edit(both, SPACE, "factors:\n", f"factors:\n{factor}")

    assert main(["check", "--project", str(both)]) == 2
    assert "cost: 'PRICE' is not a quantity" in capsys.readouterr().out
    edit(both, CATALOGUE, "{value: PRICE, source: OFFER}", "{value: 9000 USD, source: Offer 1}")
    specs = trial_specs(load_project(both), seeds=[1])
    assert [spec.scene.robot.id for spec in specs] == ["lbr_iiwa"] * 4 + ["xarm6"] * 4
    # Arms whose meshes have the same names keep their own.
    assert all(one.name.startswith("xarm_description/") for one in specs[4].scene.robot.files)
    assert run_trial(replace(specs[4], fidelity=Fidelity.KINEMATIC)).success


def test_an_arm_is_added_once(both, capsys):
    arguments = ["init", "--robot", str(urdf_of("six")), "--add", str(both)]
    assert main(arguments) == 0
    before = {path: path.read_bytes() for path in both.rglob("*") if path.is_file()}
    capsys.readouterr()
    assert main(arguments) == 2
    error = " ".join(capsys.readouterr().err.split())
    assert "scenes/robots/xarm6 is there already, and nothing is overwritten (remove it, or give the robot" in error
    assert {path: path.read_bytes() for path in both.rglob("*") if path.is_file()} == before


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["--add"], "--add adds the arm of a URDF (give the URDF with --robot)"),
        (
            ["--robot", "a.urdf", "--add", "--gripper", "b.urdf"],
            "--gripper is not for an arm that is added (make a project with both, and copy its gripper file)",
        ),
        (["--robot", "a.urdf", "--add", "no/project"], "no/project is not a project: it has no folder 'scenes'"),
    ],
)
def test_what_cannot_be_added_is_refused(arguments, expected, capsys):
    assert main(["init", *arguments]) == 2
    assert expected in " ".join(capsys.readouterr().err.split())
