"""Projects round arms that nobody here modelled: those that come with the physics engine."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path

import pytest

from rgss.studies.robot_project import write_robot_project
from rgss.studies.robot_project.draft import drafted_robot
from tests.fixtures.made_once import made_once

URDFS = {
    "seven": "kuka_iiwa/model.urdf",
    "seven with a hand": "franka_panda/panda.urdf",
    "six": "xarm/xarm6_robot.urdf",
}


def urdf_of(name: str) -> Path:
    """The URDF of an arm."""
    with contextlib.redirect_stdout(io.StringIO()):
        import pybullet_data
    return Path(pybullet_data.getDataPath()) / URDFS[name]


class Projects(dict):
    """Folder of a project round each arm, written when it is first used; a test that changes one copies it."""

    def __init__(self, tmp_path_factory: pytest.TempPathFactory) -> None:
        super().__init__()
        self._factory = tmp_path_factory

    def __missing__(self, name: str) -> Path:
        with made_once(self._factory, f"project of {name}") as folder:
            if not folder.exists():
                write_robot_project(urdf_of(name), folder)
        self[name] = folder
        return folder


@pytest.fixture(scope="session")
def projects(tmp_path_factory):
    """A project round each arm."""
    return Projects(tmp_path_factory)


@pytest.fixture(params=list(URDFS))
def arm_name(request):
    return request.param


@pytest.fixture
def draft(tmp_path):
    """The robot that is drafted from a text."""

    def drafted(text, **options):
        folder = tmp_path / "package"
        folder.mkdir(exist_ok=True)
        (folder / "arm.urdf").write_text(text, encoding="utf-8")
        return drafted_robot(folder / "arm.urdf", tmp_path / "project", **options)

    return drafted
