"""What a camera sees: the right thing, at the right place, in a colour of its own."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import SimulationError
from rgss.physics.engine import pybullet
from rgss.physics.pictures.camera import VIEWS, Camera, View
from rgss.physics.pictures.rendering import Lens, Window, draw
from rgss.physics.pictures.shadows import darkness
from rgss.physics.stage import FINGER_COLOUR, GRIPPER_BASE_COLOUR, Posture
from rgss.scenes import Pose

pytestmark = pytest.mark.engine

WIDTH, HEIGHT = 240, 180
FIELD_OF_VIEW = math.radians(36)
TOP = View(azimuth_rad=math.radians(-90), elevation_rad=math.radians(90), distance_m=2.5)


def seen_at(point, view, target):
    """Column and row of a point of the world, by a pinhole camera written down anew."""
    ce, se, ca, sa = (f(a) for a in (view.elevation_rad, view.azimuth_rad) for f in (math.cos, math.sin))
    back = np.array([ce * ca, ce * sa, se])
    right = np.array([-sa, ca, 0.0])
    up = np.cross(back, right)
    offset = np.array(point) - (np.array(target) + view.distance_m * back)
    scale = HEIGHT / 2 / math.tan(FIELD_OF_VIEW / 2) / -(offset @ back)
    return WIDTH / 2 + scale * (offset @ right), HEIGHT / 2 - scale * (offset @ up)


def red(picture):
    """Where the picture has the cup's hue, which nothing else in the scene has."""
    r, g, b = np.moveaxis(picture.astype(int), -1, 0)
    return (r > 90) & (r > 2 * g) & (r > 2 * b)


def yellow(picture):
    """Where the picture has the fingers' hue."""
    r, g, b = np.moveaxis(picture.astype(int), -1, 0)
    return (r > 120) & (g > 0.6 * r) & (b < 0.4 * r)


def centre(mask):
    rows, columns = np.nonzero(mask)
    return columns.mean() + 0.5, rows.mean() + 0.5


@pytest.fixture(scope="module")
def camera(two_fingers):
    """Makes pictures of the cell with the two-finger gripper."""
    opened = {}

    def make(view, width=WIDTH, height=HEIGHT):
        key = (view, width, height)
        if key not in opened:
            opened[key] = Camera(two_fingers.scene, two_fingers.gripper, view, width=width, height=height)
        return opened[key]

    yield make
    for each in opened.values():
        each.close()


@pytest.fixture(scope="module")
def postures(two_fingers):
    """The arm away from the cup at pick and at place, and around it."""
    scene = two_fingers.scene
    home = list(scene.robot.home_rad)
    high = scene.grasp.raised(0.25)
    away = two_fingers.near(high).tolist()
    x, y, z = scene.place.centre_m
    placed = Pose(position_m=(x, y, z + scene.workpiece.shape.half_height_m))
    still = (0.0, 0.0)
    return {
        "pick": Posture(joints_rad=away, finger_travel_m=still, workpiece=scene.workpiece.pose),
        "place": Posture(joints_rad=away, finger_travel_m=still, workpiece=placed),
        "home": Posture(joints_rad=home, finger_travel_m=still, workpiece=scene.workpiece.pose),
        "grasp": Posture(
            joints_rad=two_fingers.grasp_rad.tolist(), finger_travel_m=still, workpiece=scene.workpiece.pose
        ),
    }


@pytest.mark.parametrize(("width", "height"), [(64, 64), (161, 90)])
def test_pictures_have_the_size_that_was_asked_for(camera, postures, width, height):
    picture = camera(VIEWS["overview"], width, height).picture(postures["pick"])

    assert picture.shape == (height, width, 3)
    assert picture.dtype == np.uint8


@pytest.mark.parametrize("place", ["pick", "place"])
def test_overview_shows_the_cup_where_it_stands(camera, postures, two_fingers, place):
    view = VIEWS["overview"]
    mask = red(camera(view).picture(postures[place]))
    scene = two_fingers.scene
    target = (np.array(scene.grasp.position_m) + np.array(scene.place_pose.position_m)) / 2 + (0.0, 0.0, 0.14)
    expected = seen_at(postures[place].workpiece.position_m, view, target)

    assert mask.sum() > 40
    assert math.dist(centre(mask), expected) < 3.0


def test_side_view_shows_the_cup_at_both_places(camera, postures):
    view = camera(VIEWS["side"])

    assert red(view.picture(postures["pick"])).sum() > 40
    assert red(view.picture(postures["place"])).sum() > 40


def test_hand_view_looks_at_the_grasp(camera, postures):
    picture = camera(VIEWS["hand"]).picture(postures["grasp"])

    assert math.dist(centre(red(picture)), (WIDTH / 2, HEIGHT / 2)) < 8.0
    assert red(picture).sum() > 300
    assert yellow(picture).sum() > 100


def test_fingers_close_in_the_picture(camera, postures):
    view = camera(VIEWS["hand"])
    apart = yellow(view.picture(postures["grasp"])).nonzero()[1]
    closed = yellow(view.picture(replace(postures["grasp"], finger_travel_m=(0.035, 0.035)))).nonzero()[1]

    assert np.ptp(closed) < 0.75 * np.ptp(apart)


def test_a_camera_above_has_the_direction_away_from_it_upward(camera, postures):
    view = camera(TOP)
    picked, placed = (centre(red(view.picture(postures[place]))) for place in ("pick", "place"))

    # The place lies at greater y and smaller x than the pick.
    assert placed[1] < picked[1] - 20
    assert placed[0] < picked[0] - 20


def test_something_in_front_hides_what_is_behind(camera, postures, two_fingers):
    machine = next(body for body in two_fingers.scene.bodies if body.id == "coffee_machine")
    inside = replace(postures["pick"], workpiece=machine.pose)

    assert red(camera(VIEWS["overview"]).picture(inside)).sum() == 0


def test_the_same_posture_gives_the_same_picture(camera, postures, two_fingers):
    first = camera(VIEWS["overview"]).picture(postures["pick"])
    camera(VIEWS["overview"]).picture(postures["place"])
    again = camera(VIEWS["overview"]).picture(postures["pick"])
    with Camera(two_fingers.scene, two_fingers.gripper, VIEWS["overview"], width=WIDTH, height=HEIGHT) as other:
        elsewhere = other.picture(postures["pick"])

    assert (first == again).all()
    assert (first == elsewhere).all()


def test_what_hovers_casts_a_shadow_on_the_counter(camera, postures):
    far = replace(postures["home"], workpiece=Pose(position_m=(0.0, 0.0, -5.0)))
    above = replace(postures["home"], workpiece=Pose(position_m=(-0.4, 0.75, 1.05)))
    view = camera(VIEWS["overview"])
    without, shaded = (view.picture(posture).astype(float) for posture in (far, above))
    darker = (shaded.sum(axis=2) < 0.9 * without.sum(axis=2)) & ~red(shaded)

    assert darker.sum() > 20
    assert (shaded[darker] / without[darker]).mean() == pytest.approx(0.7, abs=0.15)


def test_what_is_out_of_sight_is_not_drawn(two_fingers, postures):
    away = View(azimuth_rad=math.radians(215), elevation_rad=math.radians(89), distance_m=0.3)
    gone = replace(two_fingers.scene, robot=replace(two_fingers.scene.robot, base=Pose(position_m=(4.0, 4.0, -3.0))))
    posture = replace(postures["home"], workpiece=Pose(position_m=(4.0, 4.0, -3.0)))
    with Camera(gone, two_fingers.gripper, away, width=64, height=64) as view:
        picture = view.picture(posture)

    assert red(picture).sum() == 0
    assert yellow(picture).sum() == 0


def test_colours_tell_cup_fingers_gripper_and_counters_apart(two_fingers):
    bodies = {body.id: body.colour for body in two_fingers.scene.bodies}
    colours = [two_fingers.scene.workpiece.colour, FINGER_COLOUR, GRIPPER_BASE_COLOUR, bodies["counter_pick"]]

    for index, one in enumerate(colours):
        for other in colours[index + 1 :]:
            assert math.dist(one[:3], other[:3]) > 0.25


def test_every_client_is_closed(two_fingers):
    view = Camera(two_fingers.scene, two_fingers.gripper, VIEWS["overview"], width=64, height=64)
    clients = list(view._stage._clients)
    view.close()
    view.close()

    assert len(clients) == 3
    assert not any(pybullet().getConnectionInfo(client)["isConnected"] for client in clients)


def test_a_body_that_the_engine_refuses(two_fingers, monkeypatch):
    engine = pybullet()
    before = connected(engine)
    monkeypatch.setattr(engine, "createMultiBody", lambda *_, **__: -1)

    with pytest.raises(SimulationError, match=r"rejected a rendered body \(check its sizes\)"):
        Camera(two_fingers.scene, two_fingers.gripper, VIEWS["overview"], width=64, height=64)
    assert connected(engine) == before


def connected(engine):
    return [client for client in range(64) if engine.getConnectionInfo(client)["isConnected"]]


def test_points_go_through_the_lens_and_back():
    lens = Lens(
        eye_m=(1.0, -2.0, 1.5),
        target_m=(0.0, 0.0, 0.5),
        field_of_view_rad=0.7,
        width=20,
        height=14,
        near_m=0.2,
        far_m=9.0,
    )
    depths = np.linspace(0.3, 0.98, 20 * 14, dtype=np.float32).reshape(14, 20)
    columns, rows, again = lens.project(lens.unproject(depths))

    assert np.broadcast_to(np.arange(20) + 0.5, (14, 20)) == pytest.approx(columns, abs=1e-3)
    assert np.broadcast_to(np.arange(14)[:, None] + 0.5, (14, 20)) == pytest.approx(rows, abs=1e-3)
    assert depths == pytest.approx(again, abs=1e-5)


def test_points_behind_the_lens_are_nowhere():
    lens = Lens(
        eye_m=(0.0, -1.0, 0.0), target_m=(0.0, 0.0, 0.0), field_of_view_rad=0.7, width=9, height=9, near_m=0.1, far_m=9
    )
    columns, rows, depths = lens.project(np.array([[0.0, -3.0, 0.0]], dtype=np.float32))

    assert np.isnan([columns, rows, depths]).all()


def test_a_window_is_a_part_of_the_whole(camera, postures):
    view = camera(VIEWS["overview"])
    view.picture(postures["pick"])
    lens = view._lens(view._middle)
    window = Window(top=40, bottom=120, left=100, right=200)
    whole, _ = draw(view._stage.still, lens)
    part, _ = draw(view._stage.still, lens, window)

    assert part.shape == (80, 100, 3)
    differing = (np.abs(whole[window.slices].astype(int) - part) > 3).any(axis=2)
    assert differing.mean() < 0.01


def test_surfaces_lose_in_the_shadow_what_the_light_gives_them():
    rows, columns = np.mgrid[0:4, 0:5].astype(np.float32)
    facing_up = np.stack([columns, -rows, np.zeros_like(rows)], axis=-1)
    facing_down = np.stack([columns, rows, np.zeros_like(rows)], axis=-1)

    assert darkness(facing_up) == pytest.approx(np.full((4, 5), 0.46 * 0.864 / (0.56 + 0.46 * 0.864)), abs=1e-3)
    assert (darkness(facing_down) == 0.0).all()
