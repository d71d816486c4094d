"""Projects round arms that nobody here modelled: those that come with the physics engine."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path

import pytest

from rgss.studies.robot_project import write_robot_project
from rgss.studies.robot_project.draft import drafted_robot

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


@pytest.fixture(scope="session")
def projects(tmp_path_factory):
    """A project round each arm."""
    made = {}
    for name in URDFS:
        made[name] = tmp_path_factory.mktemp("project") / "project"
        write_robot_project(urdf_of(name), made[name])
    return made


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
