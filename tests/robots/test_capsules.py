"""Capsules of a URDF, and collision shapes that no engine of planning knows."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from rgss.errors import DocumentError
from rgss.kinematics import touching_links
from rgss.scenes import Pose, load_robot
from tests.fixtures.palletizer import PALLETIZER_YAML, palletizer_urdf
from tests.fixtures.serial_arms import SIX_WITHOUT_DECOMPOSITION as SIX
from tests.fixtures.serial_arms import serial_urdf

CAPSULE = (
    '<collision name="c"><origin xyz="0.1 0 0" rpy="0 1.5707963267948966 0"/>'
    '<geometry><capsule radius="0.05" length="0.3"/></geometry></collision></link>'
)


def test_a_capsule_is_a_cylinder_with_a_sphere_at_each_end(draft):
    drafted = draft(serial_urdf(SIX).replace("</link>", CAPSULE, 1))
    link = next(one for one in ET.fromstring(drafted.robot.urdf).findall("link") if one.find("collision") is not None)  # noqa: S314
    kinds = sorted(shape.find("geometry")[0].tag for shape in link.findall("collision"))
    assert kinds == ["cylinder", "sphere", "sphere"]
    ends = [
        tuple(round(float(word), 6) + 0.0 for word in shape.find("origin").get("xyz").split())
        for shape in link.findall("collision")
        if shape.find("geometry/sphere") is not None
    ]
    assert sorted(ends) == [(-0.05, 0.0, 0.0), (0.25, 0.0, 0.0)]
    assert "Capsules are written as a cylinder with a sphere at each end, of link_1." in " ".join(
        note.rationale for note in drafted.arm.notes
    )


def test_a_capsule_is_an_obstacle(draft):
    """The first link is in a ball of the fourth at the home, which no one sees where capsules are left out."""
    ball = '<collision><geometry><sphere radius="2"/></geometry></collision></link>'
    text = serial_urdf(SIX).replace("</link>", CAPSULE, 1)
    fourth = text.index('<link name="link_4">')
    text = text[:fourth] + text[fourth:].replace("</link>", ball, 1)
    robot = draft(text).robot
    assert ("link_1", "link_4") in [tuple(sorted(pair)) for pair in touching_links(robot, robot.home_rad)]


def test_a_shape_that_planning_does_not_know_is_refused_in_a_project(tmp_path):
    box = '<box size="0.06 0.06 0.3"/>'
    text = palletizer_urdf((box, '<ellipsoid radii="0.1 0.1 0.2"/>'))
    (tmp_path / "palletizer.urdf").write_text(text, encoding="utf-8")
    (tmp_path / "palletizer.yaml").write_text(PALLETIZER_YAML, encoding="utf-8")
    with pytest.raises(DocumentError) as error:
        load_robot(tmp_path / "palletizer.yaml", base=Pose(), label="palletizer.yaml", project=tmp_path)
    (one,) = error.value.findings
    assert one.message == "'palletizer.urdf' has a collision shape 'ellipsoid' for link 'upper'"
    assert one.hint == "write box, cylinder, sphere or mesh; a capsule is a cylinder with a sphere at each end"
