"""A gripper file of each kind, and the gripper that it makes for an object."""

from __future__ import annotations

from pathlib import Path

from rgss.scenes import Cylinder, Gripper, GripperFile, at_opening, at_top, load_gripper_file

FILES = {
    "fingers": """\
gripper: three
azimuths: [0 deg, 120 deg, 240 deg]
base: {radius: 40 mm, height: 80 mm, mass: 500 g}
finger: {thickness: 10 mm, width: 20 mm, length: 60 mm, mass: 100 g, speed: 40 mm/s, force: 10 N, friction: 0.7}
largest_opening: 40 mm
stroke: 35 mm
grasp_depth: 130 mm
""",
    "parallel": """\
gripper: lite6
kind: parallel
base: {radius: 30 mm, height: 60 mm, mass: 350 g}
finger:
  {thickness: 6 mm, width: 15 mm, length: 40 mm, mass: 20 g, speed: 29 mm/s, force: 10 N, friction: 0.7,
   drive_inertia: 0.1 kg}
mountings:
  normal: {closed: 0 mm, open: 16 mm}
  reverse: {closed: 22 mm, open: 38 mm}
mounting: reverse
grasp_depth: 85 mm
firm_grasp: {finger_force: 5 N}
""",
    "open-loop": """\
gripper: lite6
kind: parallel
base: {radius: 30 mm, height: 60 mm, mass: 350 g}
finger: {thickness: 6 mm, width: 15 mm, length: 40 mm, mass: 20 g, force: 10 N, friction: 0.7, drive_inertia: 0.1 kg}
mountings:
  reverse: {closed: 22 mm, open: 38 mm}
grasp_depth: 85 mm
command: {travel_time: 275 ms}
""",
    "vacuum": """\
gripper: cup
kind: vacuum
base: {radius: 30 mm, height: 60 mm, mass: 250 g}
cup: {radius: 10 mm, length: 25 mm, normal_force: 15 N, tangential_force: 8 N, largest_gap: 3 mm, largest_angle: 5 deg,
      leak: 10 %, build_up: 100 ms, release: 150 ms}
""",
    "linkage": """\
gripper: two-finger
kind: linkage
description: two_finger.urdf
pads: [left_tip, right_tip]
grasp_from_tip: 15 mm
speed: 40 mm/s
friction: 0.7
""",
}

TWO_FINGER = Path(__file__).with_name("two_finger.urdf")
"""Two cranks that a joint turns alike, each with a tip that is turned back: parallel pads that move along arcs."""

HELD = Cylinder(radius_m=0.015, height_m=0.04)
"""An object that each of them can hold."""


def linkage_file(folder: Path) -> GripperFile:
    """The gripper of cranks, read from a folder."""
    (folder / TWO_FINGER.name).write_bytes(TWO_FINGER.read_bytes())
    path = folder / "gripper.yaml"
    path.write_text(FILES["linkage"], encoding="utf-8")
    return load_gripper_file(path)


def with_thin_pads(urdf: str) -> str:
    """The cranks with a pad of its own on each tip, 0.3 mm before its face and without a mass."""
    pads = ""
    for side in ("left", "right"):
        pads += f"""
  <link name="{side}_pad">
    <collision><geometry><box size="0.002 0.03 0.03"/></geometry></collision>
  </link>
  <joint name="{side}_pad_joint" type="fixed">
    <origin xyz="0.0007 0 0.033"/><parent link="{side}_tip"/><child link="{side}_pad"/>
  </joint>"""
    return urdf.replace("</robot>", f"{pads}\n</robot>")


UNFIT = {"fingers": 0.004, "parallel": 0.007, "open-loop": 0.007, "vacuum": 0.007, "linkage": 0.006}
"""Radius of an object that each of them can be put over and cannot hold."""


def gripper_of(folder: Path, name: str, shape: Cylinder = HELD) -> Gripper:
    """The gripper of a file for an object."""
    path = folder / f"{name}.yaml"
    path.write_text(FILES[name], encoding="utf-8")
    (folder / TWO_FINGER.name).write_bytes(TWO_FINGER.read_bytes())
    file = load_gripper_file(path)
    values = {key.removeprefix("gripper."): value for key, value in file.settings.items() if isinstance(value, float)}
    geometry = at_top(file.geometry, shape)
    return Gripper(
        geometry=geometry if geometry.linkage is None else at_opening(geometry, shape.radius_m),
        base_mass_kg=values["base.mass"],
        finger_mass_kg=values["finger.mass"],
        finger_velocity_m_s=values["finger.speed"],
        finger_force_n=values["finger.force"],
        friction=values["finger.friction"],
        drive=file.drive,
        suction=file.suction,
    )
