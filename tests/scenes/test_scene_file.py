"""What a scene file means, and every mistake in one at its place."""

import math

import pytest

from rgss.scenes import LANDING_LIMIT_M_S, Box, Cylinder, Task

TOO_HIGH = (
    "scene.drop a place_clearance of 11 mm drops the object from more than 10 mm "
    "(release it lower, or increase largest_drop of place_region)"
)


def test_how_far_the_object_may_drop_and_be_dragged_is_the_scene_s(kitchen):
    place = kitchen.scene().place
    assert (place.largest_drop_m, place.largest_drag_m) == (0.01, 0.001)
    kitchen.change(
        "kitchen.yaml", "largest_tilt: 5 deg", "largest_tilt: 5 deg\n  largest_drop: 60 mm\n  largest_drag: 4 mm"
    )
    kitchen.change("kitchen.yaml", "place_clearance: 2 mm", "place_clearance: 50 mm")
    place = kitchen.scene().place
    assert (place.largest_drop_m, place.largest_drag_m) == (0.06, 0.004)


def test_a_scene_is_read_in_si_units(kitchen):
    scene = kitchen.scene()
    table, pole = scene.bodies
    assert (scene.id, scene.gravity_m_s2, scene.support, scene.place_support) == ("kitchen", 9.81, "table", "pole")
    assert table.shape == Box(size_m=(1.0, 0.6, 0.7))
    assert table.pose.position_m == pytest.approx((0.5, 0.0, 0.45))  # the foot is the centre of the bottom face
    assert table.pose.rotate((1.0, 0.0, 0.0)) == pytest.approx((math.sqrt(3) / 2, 0.5, 0.0))
    assert table.colour == (1.0, 128 / 255, 0.0, 1.0)
    assert pole.shape == Cylinder(radius_m=0.05, height_m=2.0)
    assert pole.pose.position_m == (-1.0, 0.0, 1.0)
    assert (table.friction, pole.friction) == (0.5, 0.4)


def test_the_robot_stands_where_the_scene_puts_it(kitchen):
    robot = kitchen.scene().robot
    assert robot.base.position_m == (1.0, 2.0, 0.5)
    assert robot.base.rotate((1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0), abs=1e-15)


def test_the_workpiece_stands_on_its_body(kitchen):
    mug = kitchen.scene().workpiece
    assert mug.shape == Cylinder(radius_m=0.04, height_m=0.12)
    assert mug.pose.position_m == pytest.approx((0.4, 0.1, 0.8 + 0.06))
    assert mug.pose.tilt_rad == 0.0
    assert (mug.mass_kg, mug.friction, mug.force_limit_n) == (0.3, 0.9, 20.0)
    assert mug.landing_limit_m_s == LANDING_LIMIT_M_S
    assert mug.colour == (1.0, 1.0, 1.0, 1.0)


def test_what_landing_the_workpiece_bears_is_the_scene_s(kitchen):
    kitchen.change("kitchen.yaml", "force_limit: 20 N", "force_limit: 20 N\n  landing_limit: 60 cm/s")
    assert kitchen.scene().workpiece.landing_limit_m_s == pytest.approx(0.6)


def test_the_place_region_lies_on_top_of_its_body(kitchen):
    place = kitchen.scene().place
    assert place.centre_m == (-1.0, 0.0, 2.0)
    assert (place.radius_m, place.largest_tilt_rad) == (0.03, pytest.approx(math.radians(5)))


def test_the_task_is_read_in_si_units(kitchen):
    assert kitchen.scene().task == Task(
        approach_height_m=0.15,
        lift_height_m=0.05,
        departure_height_m=0.18,
        place_approach_height_m=0.2,
        place_clearance_m=0.002,
        largest_carry_tilt_rad=pytest.approx(math.pi / 4),
        grasp_yaw_rad=0.0,
        place_yaw_rad=pytest.approx(math.pi / 2),
    )


def test_a_body_stands_straight_unless_it_says_otherwise(kitchen):
    scene = kitchen.change("kitchen.yaml", "    yaw: 30 deg\n", "").scene()
    assert scene.bodies[0].pose.quaternion_xyzw == (0.0, 0.0, 0.0, 1.0)


def test_touching_is_allowed_and_so_is_a_body_without_friction(kitchen):
    kitchen.change("kitchen.yaml", "friction: 0.5", "friction: 0")
    kitchen.change("kitchen.yaml", "place_clearance: 2 mm", "place_clearance: 0 mm")
    scene = kitchen.scene()
    assert scene.place_pose.position_m[2] == pytest.approx(2.06)
    assert scene.bodies[0].friction == 0.0


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            "  stands_on: table",
            "  stands_on: ¦desk",
            "scene.unknown-body there is no body 'desk' (known bodies: table, pole)",
        ),
        (
            "  stands_on: pole",
            "  stands_on: ¦tree",
            "scene.unknown-body there is no body 'tree' (known bodies: table, pole)",
        ),
        ("id: mug", "id: ¦table", "scene.duplicate-id id 'table' is taken by a body"),
        (
            "  - id: table\n    box: [1 m, 600 mm, 0.7 m]\n",
            "  - ¦id: table\n",
            "scene.shape body 'table' needs exactly one of 'box' and 'cylinder'",
        ),
        (
            "  - id: pole\n",
            "  - ¦id: pole\n    box: [1 m, 1 m, 1 m]\n",
            "scene.shape body 'pole' needs exactly one of 'box' and 'cylinder'",
        ),
        (
            "  place_yaw: 90 deg\n",
            "  place_yaw: 90 deg\n  grasp: automatic\n  free_yaw: ¦true\n",
            (
                "scene.free-yaw free_yaw requires that every object is an upright cylinder gripped from above "
                "(remove free_yaw, or set grasp to as_stated)"
            ),
        ),
        ("600 mm, 0.7 m", "¦0 mm, 0.7 m", "scene.not-positive box must be greater than zero"),
        ("radius: 50 mm", "radius: ¦-50 mm", "scene.not-positive radius must be greater than zero"),
        ("height: 2 m", "height: ¦0 m", "scene.not-positive height must be greater than zero"),
        ("9.81 m/s^2", "¦-9.81 m/s^2", "scene.not-positive gravity must be greater than zero"),
        ("radius: 40 mm", "radius: ¦0 mm", "scene.not-positive radius must be greater than zero"),
        ("height: 120 mm", "height: ¦0 mm", "scene.not-positive height must be greater than zero"),
        ("mass: 300 g", "mass: ¦0 g", "scene.not-positive mass must be greater than zero"),
        ("force_limit: 20 N", "force_limit: ¦0 N", "scene.not-positive force_limit must be greater than zero"),
        (
            "force_limit: 20 N",
            "force_limit: 20 N\n  landing_limit: ¦0 m/s",
            "scene.not-positive landing_limit must be greater than zero",
        ),
        ("radius: 3 cm", "radius: ¦0 cm", "scene.not-positive radius must be greater than zero"),
        ("largest_tilt: 5 deg", "largest_tilt: ¦0 deg", "scene.not-positive largest_tilt must be greater than zero"),
        ("approach_height: 150 mm", "approach_height: ¦-1 mm", None),
        ("lift_height: 50 mm", "lift_height: ¦0 mm", None),
        ("departure_height: 180 mm", "departure_height: ¦0 mm", None),
        ("place_approach_height: 0.2 m", "place_approach_height: ¦0 m", None),
        ("largest_carry_tilt: 45 deg", "largest_carry_tilt: ¦0 deg", None),
        ("friction: 0.5", "friction: ¦-0.5", "scene.negative friction must not be less than zero"),
        ("friction: 0.9", "friction: ¦-90 %", "scene.not-positive friction must be greater than zero"),
        ("friction: 0.9", "friction: ¦0", "scene.not-positive friction must be greater than zero"),
        ("clearance: 2 mm", "clearance: ¦11 mm", TOO_HIGH),
        (
            "largest_tilt: 5 deg",
            "largest_tilt: 5 deg\n  largest_drag: ¦0 mm",
            "scene.not-positive largest_drag must be greater than zero",
        ),
        (
            "largest_tilt: 5 deg",
            "largest_tilt: 5 deg\n  largest_drop: ¦-1 mm",
            "scene.negative largest_drop must not be less than zero",
        ),
        ("clearance: 2 mm", "clearance: ¦-2 mm", "scene.negative place_clearance must not be less than zero"),
        (
            "robots/six.yaml",
            "¦robots/seven.yaml",
            "scene.missing-file there is no file 'robots/seven.yaml' (file names are relative to this file)",
        ),
        (
            "robots/six.yaml",
            "¦robots",
            "scene.missing-file there is no file 'robots' (file names are relative to this file)",
        ),
    ],
)
def test_each_mistake_is_found_at_its_place(kitchen, old, new, expected):
    if expected is None:
        expected = f"scene.not-positive {old.split(':')[0]} must be greater than zero"
    kitchen.change("kitchen.yaml", old, new)
    assert kitchen.findings("scene") == [f"{kitchen.marks()[0]} {expected}"]


def test_a_drop_that_damages_the_object_is_found(kitchen):
    kitchen.change("kitchen.yaml", "largest_tilt: 5 deg", "largest_tilt: 5 deg\n  largest_drop: 60 mm")
    kitchen.change("kitchen.yaml", "clearance: 2 mm", "clearance: ¦52 mm")
    (finding,) = kitchen.findings("scene")
    assert finding == (
        f"{kitchen.marks()[0]} scene.landing a place_clearance of 52 mm lands the object with 1.01 m/s, "
        "above its limit of 1 m/s "
        "(release it lower, or increase landing_limit of the workpiece)"
    )


def test_an_id_that_is_taken_is_found(kitchen):
    again = "  - {id: ¦table, box: [1 m, 1 m, 1 m], foot: [0 m, 0 m, 0 m], friction: 0.1, colour: '#123456'}\n"
    kitchen.change("kitchen.yaml", "workpiece:\n", again + "workpiece:\n")
    expected = "scene.duplicate-id id 'table' is taken by an earlier body"
    assert kitchen.findings("scene") == [f"{kitchen.marks()[0]} {expected}"]


def test_a_file_name_that_no_file_can_have_is_a_missing_file(kitchen):
    kitchen.change("kitchen.yaml", "robots/six.yaml", "¦" + "x" * 5000)
    (finding,) = kitchen.findings("scene")
    assert finding.startswith(f"{kitchen.marks()[0]} scene.missing-file there is no file 'xxx")
    assert "…" in finding


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("colour: '#000000'", "colour: ¦black", "does not match"),
        ("mass: 300 g", "mass: ¦300", "has no unit"),
        ("lift_height: 50 mm", "lift_height: ¦50 g", "does not measure"),
        ("  stands_on: table", "  ¦stand_on: table", "unknown key 'stand_on'"),
        ("foot: [-1 m, 0 m, 0 m]", "foot: ¦[-1 m, 0 m]", "entry 3 is missing"),
    ],
)
def test_mistakes_of_form_are_found_at_their_places(kitchen, old, new, message):
    kitchen.change("kitchen.yaml", '"#000000"', "'#000000'").change("kitchen.yaml", old, new)
    findings = kitchen.findings("scene")
    assert any(message in finding and finding.startswith(f"{kitchen.marks()[0]} ") for finding in findings), findings


def test_a_scene_needs_a_body(kitchen):
    text = kitchen.texts["kitchen.yaml"]
    bodies = text[text.index("bodies:\n") : text.index("workpiece:")]
    kitchen.change("kitchen.yaml", bodies, "bodies: ¦[]\n")
    assert kitchen.findings("scene") == [f"{kitchen.marks()[0]} document.value bodies: at least 1 entry is expected"]


def test_all_problems_of_scene_robot_and_urdf_come_at_once_and_in_order(kitchen):
    kitchen.change("kitchen.yaml", "600 mm, 0.7 m", "600 mm, ¦0 m")
    kitchen.change("kitchen.yaml", "mass: 300 g", "mass: ¦-1 g")
    kitchen.change("kitchen.yaml", "  stands_on: pole", "  stands_on: ¦nowhere")
    kitchen.change("robots/six.yaml", "flange: flange", "flange: ¦hand")
    kitchen.change("robots/six.yaml", "[-160 deg, 180 deg]", "¦[160 deg, -180 deg]")
    findings = kitchen.findings("scene")
    assert [finding.split()[0] for finding in findings] == kitchen.marks()
    assert [finding.split()[1] for finding in findings] == [
        "scene.not-positive",
        "scene.not-positive",
        "scene.unknown-body",
        "scene.urdf",
        "scene.range",
    ]


def test_a_missing_scene_is_one_finding(kitchen):
    kitchen.texts["kitchen.yaml"] = None
    assert kitchen.findings("scene") == [
        "kitchen.yaml:1:1 document.missing no such file (check the name and --project)"
    ]
