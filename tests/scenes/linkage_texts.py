"""URDFs of jaws that slide, for tests: one is driven, the other follows."""

from __future__ import annotations

JAWS = """\
<robot name="jaws">
  <link name="palm">
    <inertial><mass value="0.4"/><inertia ixx="4e-4" iyy="4e-4" izz="3e-4" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.03"/><geometry><cylinder radius="0.03" length="0.06"/></geometry></collision>
  </link>
  <link name="left">
    <inertial><mass value="0.05"/><inertia ixx="1e-5" iyy="1e-5" izz="1e-5" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0.005 0.02"/><geometry><box size="0.02 0.01 0.04"/></geometry></collision>
  </link>
  <link name="right">
    <inertial><mass value="0.05"/><inertia ixx="1e-5" iyy="1e-5" izz="1e-5" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 -0.005 0.02"/><geometry><box size="0.02 0.01 0.04"/></geometry></collision>
  </link>
  <link name="camera"/>
  <joint name="left_joint" type="prismatic">
    <origin xyz="0 0 0.06"/><parent link="palm"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="-0.01" upper="0.03" effort="30" velocity="0.1"/>
  </joint>
  <joint name="right_joint" type="prismatic">
    <origin xyz="0 0 0.06"/><parent link="palm"/><child link="right"/><axis xyz="0 -1 0"/>
    <mimic joint="left_joint"/>
  </joint>
  <joint name="camera_joint" type="fixed"><parent link="palm"/><child link="camera"/></joint>
</robot>
"""

FILE = """\
gripper: jaws
kind: linkage
description: jaws.urdf
pads: [left, right]
"""
