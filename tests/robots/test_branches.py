"""URDFs in which the arm divides: a head or a camera that turns, a hand, or two arms."""

from __future__ import annotations

import re

import pytest

from rgss.errors import DefinitionError
from tests.robots.test_foreign_urdfs import CLEAN, rationales, tool


def branch(parent, count, name):
    """Links that turn one on the other, the first on a link of the arm."""
    inertial = (
        '<inertial><mass value="0.1"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial>'
    )
    parts = []
    for number in range(1, count + 1):
        parts.append(
            f'<link name="{name}_{number}">{inertial}</link><joint name="{name}_joint_{number}" type="revolute">'
            f'<origin xyz="0 0 0.05"/><axis xyz="0 0 1"/><parent link="{parent}"/><child link="{name}_{number}"/>'
            '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        )
        parent = f"{name}_{number}"
    return "".join(parts)


@pytest.mark.parametrize(("at", "count"), [("link_1", 1), ("link_1", 2), ("link_2", 1)])
def test_what_turns_beside_the_arm_is_not_the_arm(draft, at, count):
    clean = draft(CLEAN)
    foreign = draft(CLEAN.replace("</robot>", f"{branch(at, count, 'head')}</robot>"))
    assert foreign.arm.flange == clean.arm.flange == "flange"
    assert [joint.name for joint in foreign.robot.joints] == [joint.name for joint in clean.robot.joints]
    q = [0.3, -0.4, 0.5, 0.6, -0.7, 0.8]
    assert tool(foreign, q) == pytest.approx(tool(clean, q), abs=1e-12)


def test_an_arm_ends_where_fingers_begin_however_many_joints_they_have(draft):
    fingers = "".join(branch("flange", count, name) for count, name in [(4, "thumb"), (4, "index"), (2, "little")])
    drafted = draft(CLEAN.replace("</robot>", f"{fingers}</robot>"))
    assert [joint.name for joint in drafted.robot.joints] == [f"joint_{number}" for number in range(1, 7)]


def test_two_ways_of_like_length_end_the_arm_with_a_note_that_names_the_end_of_the_longer(draft):
    drafted = draft(CLEAN.replace("</robot>", f"{branch('link_3', 2, 'other')}</robot>"))
    assert [joint.name for joint in drafted.robot.joints] == ["joint_1", "joint_2", "joint_3"]
    note = "The URDF divides at link_3, into branches of 3 and 2 joints in a row"
    assert note in rationales(drafted)
    assert "With --flange flange it goes on" in rationales(drafted)


@pytest.mark.parametrize("lengths", [(1, 1), (1, 0), (2, 2, 1)])
def test_a_hand_with_fingers_of_the_same_length_is_no_division(draft, lengths):
    fingers = "".join(branch("flange", count, f"finger_{at}") for at, count in enumerate(lengths))
    assert "divides" not in rationales(draft(CLEAN.replace("</robot>", f"{fingers}</robot>")))


def follower(parent, name, joint):
    """A link that turns with a joint of the arm."""
    first = branch(parent, 1, name)
    return first.replace("</joint>", f'<mimic joint="{joint}" multiplier="-1"/></joint>')


@pytest.mark.parametrize(("at", "follows"), [("link_2", 1), ("link_3", 2), ("link_5", 2), ("link_3", 4), ("link_4", 5)])
def test_the_rods_of_a_parallelogram_are_not_where_the_arm_ends(draft, at, follows):
    """A rod that follows a joint before its link or the one on it, and a triangle on it, as palletisers have them."""
    clean = draft(CLEAN)
    rods = follower(at, "rod", f"joint_{follows}") + follower("rod_1", "triangle", "joint_2")
    drafted = draft(CLEAN.replace("</robot>", f"{rods}</robot>"))
    assert drafted.arm.flange == clean.arm.flange == "flange"
    assert [joint.name for joint in drafted.robot.joints] == [joint.name for joint in clean.robot.joints]
    assert drafted.arm.rods == ("rod_1",)
    assert drafted.arm.hands == ()
    assert "as the rods of a parallelogram do, is left out: rod_1." in drafted.file.read_text(encoding="utf-8")
    q = [0.3, -0.4, 0.5, 0.6, -0.7, 0.8]
    assert tool(drafted, q) == pytest.approx(tool(clean, q), abs=1e-12)


def test_fingers_that_follow_each_other_are_a_hand(draft):
    fingers = branch("flange", 1, "left") + follower("flange", "right", "left_joint_1")
    drafted = draft(CLEAN.replace("</robot>", f"{fingers}</robot>"))
    assert [joint.name for joint in drafted.robot.joints] == [f"joint_{number}" for number in range(1, 7)]
    assert (drafted.arm.hands, drafted.arm.rods) == (("flange_palm",), ())


def test_a_finger_that_follows_one_with_two_joints_is_a_hand(draft):
    fingers = branch("flange", 2, "finger") + follower("flange", "other", "finger_joint_1")
    drafted = draft(CLEAN.replace("</robot>", f"{fingers}</robot>"))
    assert [joint.name for joint in drafted.robot.joints] == [f"joint_{number}" for number in range(1, 7)]
    assert drafted.arm.rods == ()


def test_a_finger_that_follows_both_joints_of_another_is_a_hand_whatever_its_name(draft):
    other = follower("flange", "left", "right_joint_1") + follower("left_1", "tip", "right_joint_2")
    drafted = draft(CLEAN.replace("</robot>", f"{branch('flange', 2, 'right')}{other}</robot>"))
    assert [joint.name for joint in drafted.robot.joints] == [f"joint_{number}" for number in range(1, 7)]
    assert (drafted.arm.hands, drafted.arm.rods) == (("flange_palm",), ())


def frame(parent, name):
    return (
        f'<link name="{name}"/><joint name="{name}_mount" type="fixed"><origin xyz="0.05 0 0.01"/>'
        f'<parent link="{parent}"/><child link="{name}"/></joint>'
    )


@pytest.mark.parametrize(
    ("frames", "end"),
    [
        (("camera_link", "Camera_Depth_frame"), "flange"),
        (("probe", "camera_link"), "probe"),
        (("ft_frame", "tool0"), "tool0"),
        (("ft_frame", "other_frame"), "ft_frame"),
    ],
)
def test_an_arm_does_not_end_at_its_camera_and_at_the_frame_of_the_tool_if_one_is_named(draft, frames, end):
    text = "".join(frame("flange", name) for name in frames)
    assert draft(CLEAN.replace("</robot>", f"{text}</robot>")).arm.flange == end


def test_a_choice_among_frames_without_a_flange_s_name_is_noted(draft):
    text = frame("flange", "ft_frame") + frame("flange", "other_frame").replace("0.05 0 0.01", "0 0 0.1")
    (note,) = [one.rationale for one in draft(CLEAN.replace("</robot>", f"{text}</robot>")).arm.notes]
    assert note == (
        "The gripper is mounted at ft_frame, the first of 2 frames on flange of which none is named for a flange or a "
        "tool: with --flange other_frame it is mounted at another."
    )


@pytest.mark.parametrize("frames", [("ft_frame", "other_frame"), ("ft_frame", "tool0"), ("ft_frame", "camera_link")])
def test_frames_at_the_same_pose_and_those_beside_a_tool_or_of_a_camera_need_no_note(draft, frames):
    text = "".join(frame("flange", name) for name in frames)
    assert draft(CLEAN.replace("</robot>", f"{text}</robot>")).arm.notes == ()


@pytest.mark.parametrize(
    ("asked", "hint"),
    [("Flange", "did you mean flange?"), ("zz", "its last links are")],
)
def test_an_unknown_end_is_answered_with_the_nearest_links(draft, asked, hint):
    with pytest.raises(DefinitionError, match=f"the URDF has no link {asked} .{re.escape(hint)}") as caught:
        draft(CLEAN, flange=asked)
    assert str(caught.value).count(",") <= 2
