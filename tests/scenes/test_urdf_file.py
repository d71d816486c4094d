"""Every URDF that no engine should be given is found where the robot file names it."""

import errno
from pathlib import Path

import pytest

URDF = "robots/six.urdf"


@pytest.fixture
def robot(kitchen):
    return kitchen.change("robots/six.yaml", "six.urdf", "¦six.urdf")


def only_finding(robot) -> str:
    (finding,) = robot.findings("robot")
    place, rule, message = finding.split(" ", 2)
    assert (place, rule) == (robot.marks()[0], "scene.urdf")
    return message


def test_too_large(robot):
    robot.texts[URDF] += "<!--" + "x" * 1024 * 1024 + "-->"
    assert only_finding(robot) == "'six.urdf' is larger than 1 MiB (a robot of primitive shapes needs a few KiB)"


def test_not_utf_8(robot):
    robot.texts[URDF] = robot.texts[URDF].replace("six", "söx").encode("latin-1")
    assert only_finding(robot) == "'six.urdf' is not UTF-8 (save the file as UTF-8)"


def test_unreadable(robot, monkeypatch):
    opened = Path.open

    def refuse(path, *arguments, **options):
        if path.suffix == ".urdf":
            raise PermissionError(errno.EACCES, "Permission denied")
        return opened(path, *arguments, **options)

    robot.robot()
    monkeypatch.setattr(Path, "open", refuse)
    robot.texts[URDF] = None
    assert only_finding(robot) == "'six.urdf' cannot be read: Permission denied"


@pytest.mark.parametrize("declaration", ['<!DOCTYPE robot [<!ENTITY a "aaaa">]>', "<!DOCTYPE robot>"])
def test_document_types_and_entities_are_refused(robot, declaration):
    robot.texts[URDF] = declaration + robot.texts[URDF]
    assert only_finding(robot) == "'six.urdf' declares a document type or an entity (remove the declaration)"


@pytest.mark.parametrize(
    ("text", "problem"), [("", "no element found"), ("<robot>", "no element found"), ("robot: 6", "syntax error")]
)
def test_not_xml(robot, text, problem):
    robot.texts[URDF] = text
    assert only_finding(robot).startswith(f"'six.urdf' is not XML: {problem}: line ")


def test_another_kind_of_xml(robot):
    robot.texts[URDF] = '<sdf version="1.6"/>'
    assert only_finding(robot) == "'six.urdf' has the root element 'sdf' (a URDF's root element is 'robot')"


@pytest.mark.parametrize("depth", [41, 100_000])
def test_nested_too_deep(robot, depth):
    robot.texts[URDF] = "<robot>" + "<a>" * depth + "</a>" * depth + "</robot>"
    assert only_finding(robot) == "'six.urdf' is nested more than 40 deep (a URDF nests a handful of elements)"


def test_no_flange(kitchen):
    kitchen.change("robots/six.yaml", "flange: flange", "flange: ¦hand")
    expected = "scene.urdf 'six.urdf' has no link 'hand' (name the link that carries the gripper)"
    assert kitchen.findings("robot") == [f"{kitchen.marks()[0]} {expected}"]


def test_no_such_joint(kitchen):
    kitchen.change("robots/six.yaml", "name: joint_5", "name: ¦wrist")
    expected = "scene.urdf 'six.urdf' has no joint 'wrist' (name the joints as the URDF does)"
    assert kitchen.findings("robot") == [f"{kitchen.marks()[0]} {expected}"]


def test_a_transmission_that_names_a_joint_is_no_joint(kitchen):
    kitchen.change("robots/six.yaml", "name: joint_5", "name: ¦wrist")
    kitchen.change(URDF, "</robot>", '<transmission name="t"><joint name="wrist"/></transmission></robot>')
    (finding,) = kitchen.findings("robot")
    assert "has no joint 'wrist'" in finding


@pytest.mark.parametrize("kept", ["", '<inertial><mass value="1"/></inertial>'])
def test_a_moving_link_needs_mass_and_inertia(robot, kept):
    text = robot.texts[URDF]
    start = text.index("<inertial>", text.index('name="link_3"'))
    end = text.index("</inertial>", start) + len("</inertial>")
    robot.texts[URDF] = text[:start] + kept + text[end:]
    assert only_finding(robot) == (
        "'six.urdf' has no mass or no inertia for link 'link_3' "
        "(give it an <inertial> with both; a frame that is fixed and has no collision shape needs none)"
    )


def test_the_base_needs_no_mass(robot):
    text = robot.texts[URDF]
    start, end = text.index("<inertial>"), text.index("</inertial>") + len("</inertial>")
    robot.texts[URDF] = text[:start] + text[end:]
    assert robot.robot().id == "six"


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('<mass value="2.5"/>', '<mass value="heavy"/>', "value='heavy' in <mass> of 'base' (write a number {})"),
        ('<mass value="2.5"/>', '<mass value="-1"/>', "value='-1' in <mass> of 'base' (write a number {})"),
        ('<mass value="2.5"/>', "<mass/>", "no value in <mass> of 'base' (write a number {})"),
        ('radius="0.04"', 'radius="-0.04"', "radius='-0.04' in <cylinder> of 'base' (write a number {})"),
        ('length="0.2"', 'length="1e999"', "length='1e999' in <cylinder> of 'base' (write a number {})"),
        (
            '<cylinder radius="0.04" length="0.2"/>',
            '<box size="1 2"/>',
            "size='1 2' in <box> of 'base' (write 3 numbers {})",
        ),
        (
            '<cylinder radius="0.04" length="0.2"/>',
            "<sphere/>",
            "no radius in <sphere> of 'base' (write a number {})",
        ),
        ('ixx="0.02"', 'ixx="nan"', "ixx='nan' in <inertia> of 'base' (write a number)"),
        ('<origin xyz="0 0 0.1"/>', '<origin xyz="0 0 0,1"/>', "xyz='0 0 0,1' in <origin> of 'base' (write 3 numbers)"),
        ('rpy="0 0 0"', 'rpy="0 0"', "rpy='0 0' in <origin> of 'joint_1' (write 3 numbers)"),
        ('<axis xyz="0 1 0"/>', '<axis xyz=""/>', "xyz='' in <axis> of 'joint_1' (write 3 numbers)"),
        ('effort="100"', 'effort="1_0"', "effort='1_0' in <limit> of 'joint_1' (write a number)"),
    ],
)
def test_what_is_no_number_is_found_since_engines_read_it_as_zero(robot, old, new, expected):
    text = robot.texts[URDF]
    assert old in text
    robot.texts[URDF] = text.replace(old, new, 1)
    assert only_finding(robot) == "'six.urdf' has " + expected.format("greater than zero")


def test_all_problems_come_at_once(robot):
    text = robot.texts[URDF].replace('radius="0.04"', 'radius="?"').replace('effort="100"', 'effort="?"')
    robot.texts[URDF] = text
    assert len(robot.findings("robot")) == 7 + 6


def test_a_byte_order_mark_is_no_part_of_the_text(robot):
    text = robot.texts[URDF]
    robot.texts[URDF] = text.encode("utf-8-sig")
    assert robot.robot().urdf == text
