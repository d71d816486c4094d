"""Files of parallel and vacuum grippers, and what is wrong with them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.errors import DocumentError
from rgss.scenes import Cylinder, load_gripper_file, load_scene, misfit, too_narrow, too_wide
from tests.trials.hands.gripper_files import FILES


@pytest.fixture
def findings(tmp_path):
    """The findings of a file of a kind with one change."""

    def read(name, old, new):
        path = tmp_path / "gripper.yaml"
        assert FILES[name].count(old) == 1
        path.write_text(FILES[name].replace(old, new), encoding="utf-8")
        try:
            load_gripper_file(path, label="g")
        except DocumentError as error:
            return [str(finding) for finding in error.findings]
        return []

    return read


def test_mountings_are_widths_between_the_pads(tmp_path):
    path = tmp_path / "gripper.yaml"
    path.write_text(FILES["parallel"], encoding="utf-8")
    file = load_gripper_file(path)

    assert file.geometry is file.mountings["reverse"]
    normal, reverse = file.mountings["normal"], file.mountings["reverse"]
    assert (normal.least_opening_m, normal.largest_opening_m) == pytest.approx((0.0, 0.008))
    assert (reverse.least_opening_m, reverse.largest_opening_m) == pytest.approx((0.011, 0.019))
    assert file.drive.inertia_kg == 0.1
    assert file.drive.firm_force_n == 5.0
    assert file.settings["gripper.mounting"] == "reverse"


@pytest.mark.parametrize(
    ("radius_m", "wide", "narrow"), [(0.011, False, True), (0.015, False, False), (0.019, True, False)]
)
def test_an_object_fits_between_the_least_and_the_largest_width(shipped, tmp_path, radius_m, wide, narrow):
    path = tmp_path / "gripper.yaml"
    path.write_text(FILES["parallel"], encoding="utf-8")
    geometry, scene = load_gripper_file(path).geometry, load_scene(shipped / "restaurant.yaml")
    scene = replace(scene, workpiece=replace(scene.workpiece, shape=Cylinder(radius_m=radius_m, height_m=0.1)))

    assert (bool(too_wide(geometry, scene)), bool(too_narrow(geometry, scene))) == (wide, narrow)
    assert bool(misfit(geometry, scene)) == (wide or narrow)


def test_the_speed_of_an_open_loop_gripper_follows_from_its_command(tmp_path):
    path = tmp_path / "gripper.yaml"
    path.write_text(FILES["open-loop"], encoding="utf-8")
    file = load_gripper_file(path)

    assert file.settings["gripper.finger.speed"] == pytest.approx(0.008 / 0.275)
    assert file.drive.command_s == 0.275


@pytest.mark.parametrize(
    ("name", "old", "new", "expected"),
    [
        ("parallel", "kind: parallel", "kind: tentacle", "unknown kind of gripper 'tentacle'"),
        ("parallel", "mounting: reverse\n", "mounting: sideways\n", "there is no mounting 'sideways'"),
        ("parallel", "mounting: reverse\n", "", "a gripper with several mountings must name its default"),
        ("parallel", "open: 16 mm", "open: 0 mm", "mounting 'normal' opens to 0 mm and closes to 0 mm"),
        ("parallel", "closed: 0 mm", "closed: -1 mm", "closed must not be less than zero"),
        ("parallel", "drive_inertia: 0.1 kg", "drive_inertia: 0 kg", "drive_inertia must be greater than zero"),
        ("parallel", "finger_force: 5 N", "finger_force: 0 N", "finger_force must be greater than zero"),
        ("open-loop", "force: 10 N", "speed: 1 m/s, force: 10 N", "the speed of the fingers follows from the mounting"),
        (
            "open-loop",
            "  reverse: {closed: 22 mm, open: 38 mm}",
            "  reverse: {closed: 22 mm, open: 38 mm}\n  wide: {closed: 22 mm, open: 40 mm}",
            "the mountings of a gripper with a command must have the same travel",
        ),
        ("open-loop", "travel_time: 275 ms", "travel_time: 0 ms", "travel_time must be greater than zero"),
        ("vacuum", "leak: 10 %", "leak: 100 %", "a leak of 100 % leaves no force"),
        ("vacuum", "normal_force: 15 N", "normal_force: 40 N", "air pressure on a lip of 10 mm, 31.8 N"),
        ("vacuum", "largest_angle: 5 deg", "largest_angle: 90 deg", "a cup does not seal at an angle of 90 deg"),
        (
            "vacuum",
            "largest_gap: 3 mm",
            "largest_gap: 25 mm",
            "a largest gap of 25 mm is not shorter than the cup, 25 mm",
        ),
        ("vacuum", "leak: 10 %", "leak: -1 %", "leak must not be less than zero"),
        ("vacuum", "release: 150 ms", "release: 0 ms", "release must be greater than zero"),
        ("vacuum", "mass: 250 g", "mass: 0 g", "mass must be greater than zero"),
    ],
)
def test_what_is_wrong_is_found_where_it_is(findings, name, old, new, expected):
    found = findings(name, old, new)

    assert any(expected in finding for finding in found), found
    assert all(finding.startswith("g:") for finding in found)
