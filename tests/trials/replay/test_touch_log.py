"""The log of touches: contacts that follow each other are one, with the greatest force."""

from __future__ import annotations

from rgss.physics import RobotContact
from rgss.trials.replay.replay_scene import Touch
from rgss.trials.replay.touch_log import TouchLog


def contact(force_n, link="wrist", body=None, z=0.0):
    return RobotContact(link, body, (0.0, 0.0, z), (force_n, 0.0, 0.0))


def test_a_part_that_chatters_touches_once_with_its_greatest_force():
    log = TouchLog()
    for time_s, force_n in ((1.0, 2.0), (1.05, 9.0), (1.12, 3.0)):
        log.add(time_s, [contact(force_n, z=time_s)], workpiece="cup")

    assert log.touches(5.0) == (
        Touch(link="wrist", body="cup", start_s=1.0, end_s=1.12, point_m=(0.0, 0.0, 1.05), force_n=(9.0, 0.0, 0.0)),
    )


def test_contacts_far_apart_are_two_and_other_bodies_are_told_apart():
    log = TouchLog()
    log.add(1.0, [contact(2.0), contact(4.0, body="table")], workpiece="cup")
    log.add(1.1, [contact(1.0)], workpiece="cup")

    found = [(one.body, one.start_s, one.force_n[0]) for one in log.touches(5.0)]
    assert found == [("cup", 1.0, 2.0), ("table", 1.0, 4.0), ("cup", 1.1, 1.0)]


def test_what_comes_after_the_end_of_the_trial_is_left_out():
    log = TouchLog()
    log.add(1.0, [contact(2.0)], workpiece="cup")

    assert log.touches(0.9) == ()
    assert len(log.touches(1.0)) == 1


def test_a_contact_that_ended_the_trial_is_shown_at_its_last_sample():
    touch = Touch(link="a", body="b", start_s=2.004, end_s=2.004, point_m=(0, 0, 0), force_n=(1, 0, 0))

    assert [touch.is_shown_at(time, 2.0) for time in (1.98, 2.0)] == [False, True]
    assert [touch.is_shown_at(time, 9.0) for time in (2.0, 2.004, 2.1, 2.2)] == [False, True, True, False]
