"""A world opens one client and always closes it; what the engine refuses is one line."""

from dataclasses import replace

import pytest

from rgss.errors import SimulationError
from rgss.physics.engine import open_client, pybullet
from rgss.scenes import Box, Cylinder

pytestmark = pytest.mark.engine


def open_clients() -> int:
    return sum(pybullet().isConnected(client) for client in range(64))


@pytest.fixture(autouse=True)
def no_client_is_left():
    before = open_clients()
    yield
    assert open_clients() == before


def test_a_world_closes_its_client(three_fingers):
    before = open_clients()
    with three_fingers.world() as world:
        assert open_clients() == before + 1
        world.step()
    assert open_clients() == before


def test_closing_twice_is_allowed_and_spares_a_client_opened_in_between(three_fingers):
    first = three_fingers.world()
    first.close()
    with three_fingers.world() as second:
        first.close()
        second.step()
        assert second.workpiece_pose() == pytest.approx(second.workpiece_pose())


def test_an_exception_in_the_block_closes_the_client(three_fingers):
    before = open_clients()
    with pytest.raises(RuntimeError, match="stop"), three_fingers.world():
        raise RuntimeError("stop")
    assert open_clients() == before


def refused(cell, **scene) -> SimulationError:
    with pytest.raises(SimulationError) as caught:
        cell.world(**scene)
    assert "\n" not in str(caught.value)
    return caught.value


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("</robot>", "", "XML_ERROR"),
        ('<link name="flange">', '<link name="wrist_3_link">', "Link name is not unique"),
        ('<child link="flange"/>', '<child link="hand"/>', "Cannot find child link for joint: flange_joint"),
        ('<cylinder radius="0.075" length="0.038"/>', '<mesh filename="base.stl"/>', "base_link: failed to parse link"),
    ],
)
def test_a_broken_urdf_closes_the_client_and_says_why_in_one_line(three_fingers, capfd, monkeypatch, old, new, reason):
    # The text goes to the engine as it is, past the checks of the loader.
    urdf = three_fingers.scene.robot.urdf
    assert old in urdf
    monkeypatch.setattr("rgss.physics.world_builder.assembled_urdf", lambda robot, gripper, **_: robot.urdf)
    error = refused(three_fingers, robot=replace(three_fingers.scene.robot, urdf=urdf.replace(old, new)))
    assert error.message.startswith("the physics engine cannot load the robot: ")
    assert reason in error.message
    assert error.hint == "check its URDF"
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("shape", "sizes"),
    [
        (Box(size_m=(1.0, -1.0, 1.0)), "(1.0, -1.0, 1.0)"),
        (Cylinder(radius_m=0.0, height_m=1.0), "(0.0, 1.0)"),
        (Cylinder(radius_m=0.1, height_m=float("inf")), "(0.1, inf)"),
    ],
)
def test_a_body_without_extent_is_refused(three_fingers, capfd, shape, sizes):
    floor = replace(three_fingers.scene.bodies[0], shape=shape)
    error = refused(three_fingers, bodies=(floor,))
    assert error.message == f"the sizes of a body must be positive, got {sizes}"
    assert error.hint == "give lengths greater than zero"
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("mass_kg", [0.0, -1.0, float("nan"), float("inf")])
def test_a_workpiece_without_mass_is_refused(three_fingers, mass_kg):
    error = refused(three_fingers, **three_fingers.with_workpiece(mass_kg=mass_kg))
    assert error.message == f"the mass of the workpiece must be positive, got {mass_kg} kg"
    assert error.hint == "give a mass greater than zero"


def test_a_body_that_the_engine_does_not_make_is_refused(three_fingers, monkeypatch):
    monkeypatch.setattr(pybullet(), "createMultiBody", lambda *_, **__: -1)
    error = refused(three_fingers)
    assert (error.message, error.hint) == ("the physics engine rejected a body", "check its sizes")


def test_any_other_refusal_of_the_engine_is_a_simulation_error(three_fingers, monkeypatch):
    def refuse(*_, **__):
        raise pybullet().error("createMultiBody failed.")

    monkeypatch.setattr(pybullet(), "createMultiBody", refuse)
    error = refused(three_fingers)
    assert error.message == "the physics engine rejected the world: createMultiBody failed."
    assert error.hint == "check the scene"


def test_an_interruption_while_building_closes_the_client(three_fingers, monkeypatch):
    def interrupt(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("rgss.physics.world_builder.assembled_urdf", interrupt)
    before = open_clients()
    with pytest.raises(KeyboardInterrupt):
        three_fingers.world()
    assert open_clients() == before


def test_no_client_is_a_simulation_error(monkeypatch):
    monkeypatch.setattr(pybullet(), "connect", lambda *_: -1)
    with pytest.raises(SimulationError) as caught:
        open_client()
    assert (caught.value.message, caught.value.hint) == (
        "the physics engine opened no client",
        "close other worlds first",
    )
