"""A small scene with its robot and gripper in a folder, and helpers that find where mistakes stand."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import pytest

from rgss.errors import DocumentError
from rgss.scenes import Pose, load_gripper, load_robot, load_scene

MARK = "¦"

SCENE = """\
scene: kitchen
gravity: 9.81 m/s^2
robot:
  description: robots/six.yaml
  base: [1 m, 2 m, 0.5 m]
  yaw: 90 deg
bodies:
  - id: table
    box: [1 m, 600 mm, 0.7 m]
    foot: [0.5 m, 0 m, 0.1 m]
    yaw: 30 deg
    friction: 0.5
    colour: "#ff8000"
  - id: pole
    cylinder: {radius: 50 mm, height: 2 m}
    foot: [-1 m, 0 m, 0 m]
    friction: 40 %
    colour: "#000000"
workpiece:
  id: mug
  radius: 40 mm
  height: 120 mm
  mass: 300 g
  friction: 0.9
  force_limit: 20 N
  stands_on: table
  at: [0.4 m, 0.1 m]
  colour: "#FFFFFF"
place_region:
  stands_on: pole
  at: [-1 m, 0 m]
  radius: 3 cm
  largest_tilt: 5 deg
task:
  approach_height: 150 mm
  lift_height: 50 mm
  departure_height: 180 mm
  place_approach_height: 0.2 m
  place_clearance: 2 mm
  largest_carry_tilt: 45 deg
  grasp_yaw: 0 deg
  place_yaw: 90 deg
"""

ROBOT = """\
robot: six
description: six.urdf
flange: flange
joints:
  - {name: joint_1, range: [-180 deg, 180 deg], speed: 2 rad/s, acceleration: 3 rad/s^2, torque: 300 N*m}
  - {name: joint_2, range: [-170 deg, 180 deg], speed: 2 rad/s, acceleration: 3 rad/s^2, torque: 300 N*m}
  - {name: joint_3, range: [-160 deg, 180 deg], speed: 2 rad/s, acceleration: 3 rad/s^2, torque: 150 N*m}
  - {name: joint_4, range: [-150 deg, 180 deg], speed: 3 rad/s, acceleration: 6 rad/s^2, torque: 50 N*m}
  - {name: joint_5, range: [-140 deg, 180 deg], speed: 3 rad/s, acceleration: 6 rad/s^2, torque: 50 N*m}
  - {name: joint_6, range: [-130 deg, 180 deg], speed: 3 rad/s, acceleration: 6 rad/s^2, torque: 50 N*m}
payload: 10 kg
tool_acceleration: 1.2 m/s^2
home: [0 deg, -90 deg, 90 deg, 0 deg, 0 deg, 45 deg]
"""

GRIPPER = """\
gripper: three
azimuths: [0 deg, 120 deg, 240 deg]
base: {radius: 40 mm, height: 80 mm}
finger: {thickness: 10 mm, width: 20 mm, length: 90 mm}
largest_opening: 60 mm
stroke: 50 mm
grasp_depth: 130 mm
"""


def link(name: str, mass: str = "2.5") -> str:
    return (
        f'  <link name="{name}"><inertial><mass value="{mass}"/>'
        '<inertia ixx="0.02" iyy="0.02" izz="0.03" ixy="0" ixz="0" iyz="0"/></inertial>'
        '<collision><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.04" length="0.2"/></geometry></collision>'
        "</link>\n"
    )


def urdf() -> str:
    links = ["base", *(f"link_{number}" for number in range(1, 6)), "flange"]
    joints = (
        f'  <joint name="joint_{number}" type="revolute"><parent link="{links[number - 1]}"/>'
        f'<child link="{links[number]}"/><origin xyz="0 0 0.2" rpy="0 0 0"/>'
        f'<axis xyz="0 {number % 2} {1 - number % 2}"/>'
        '<limit lower="-3" upper="3" effort="100" velocity="2"/></joint>\n'
        for number in range(1, 7)
    )
    return '<robot name="six">\n' + "".join(map(link, links)) + "".join(joints) + "</robot>\n"


@dataclass
class Kitchen:
    """Files in a folder, with the places of expected findings marked in their texts.

    Attributes:
        folder: Where they are written.
        texts: Content by name; None leaves the file out.
    """

    folder: Path
    texts: dict[str, str | bytes | None] = field(
        default_factory=lambda: {
            "kitchen.yaml": SCENE,
            "robots/six.yaml": ROBOT,
            "robots/six.urdf": urdf(),
            "three.yaml": GRIPPER,
        }
    )

    def change(self, name: str, old: str, new: str) -> Kitchen:
        """Replace a part that stands once in a file; ``¦`` in the new text marks a place."""
        text = self.texts[name]
        assert isinstance(text, str)
        assert text.count(old) == 1, old
        self.texts[name] = text.replace(old, new)
        return self

    def scene(self):
        return load_scene(self._write() / "kitchen.yaml", label="kitchen.yaml")

    def robot(self):
        return load_robot(self._write() / "robots/six.yaml", base=Pose(), label="robots/six.yaml")

    def gripper(self):
        return load_gripper(self._write() / "three.yaml", label="three.yaml")

    def findings(self, what: str) -> list[str]:
        """Each finding as ``file:line:column rule message (hint)``."""
        with pytest.raises(DocumentError) as caught:
            getattr(self, what)()
        assert all("\n" not in str(finding) for finding in caught.value.findings)
        return [
            f"{found.file}:{found.line}:{found.column} {found.rule} {found.message}"
            + (f" ({found.hint})" if found.hint else "")
            for found in caught.value.findings
        ]

    def marks(self) -> list[str]:
        """Every marked place as ``file:line:column``, in the order of the files' names."""
        return [
            f"{name}:{number}:{len(''.join(parts[:index])) + 1}"
            for name, text in sorted(self.texts.items())
            if isinstance(text, str)
            for number, line in enumerate(text.splitlines(), start=1)
            for parts in [line.split(MARK)]
            for index in range(1, len(parts))
        ]

    def _write(self) -> Path:
        for name, text in self.texts.items():
            path = self.folder / name
            path.parent.mkdir(exist_ok=True)
            if text is not None:
                path.write_bytes(text if isinstance(text, bytes) else text.replace(MARK, "").encode())
        return self.folder


@pytest.fixture
def kitchen(tmp_path) -> Kitchen:
    return Kitchen(tmp_path)


@pytest.fixture(scope="session")
def shipped() -> Path:
    """The folder of the scenes that come with the project."""
    return Path(__file__).parents[2] / "scenes"
