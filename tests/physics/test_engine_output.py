"""The engine prints nothing: a result on standard output must not be mixed with its messages."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.engine

ROOT = Path(__file__).parents[2]


def run(code: str, **streams) -> subprocess.CompletedProcess:
    streams = streams or {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run([sys.executable, "-c", code], check=False, env=environment, text=True, cwd=ROOT, **streams)


def test_the_engine_announces_itself_unless_it_is_kept_quiet():
    """If it no longer does, the redirection can go."""
    assert "build time" in run("import pybullet").stderr


def test_importing_the_engine_prints_nothing():
    done = run("from rgss.physics.engine import pybullet; pybullet(); pybullet()")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_what_is_printed_before_and_after_is_kept_in_order():
    done = run(
        "import os, sys\n"
        "from rgss.physics.engine import pybullet\n"
        "print('one', flush=False)\n"
        "print('first', file=sys.stderr)\n"
        "pybullet()\n"
        "print('two')\n"
        "sys.stdout.flush()\n"
        "os.write(1, b'three')\n"
        "os.write(2, b'last')\n"
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "one\ntwo\nthree", "first\nlast")


def test_importing_rgss_physics_does_not_import_the_engine():
    done = run("import sys, rgss.physics; print('pybullet' in sys.modules)")
    assert done.stdout == "False\n"


WORLD = """
from pathlib import Path
from rgss.physics import PhysicsSettings, World
from rgss.scenes import Gripper, load_gripper, load_scene
scene = load_scene(Path("scenes/restaurant.yaml"))
gripper = Gripper(geometry=load_gripper(Path("scenes/grippers/kg-2.yaml")), base_mass_kg=0.5, finger_mass_kg=0.3,
                  finger_velocity_m_s=0.04, finger_force_n=10.0, friction=0.7)
with World(scene, gripper, PhysicsSettings()) as world:
    world.reset_arm(scene.robot.home_rad)
    for _ in range(10):
        world.step()
        world.contacts()
"""


def test_the_life_of_a_world_prints_nothing():
    done = run(WORLD)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_closed_standard_streams_do_not_matter():
    done = run("import os\nos.close(1)\nos.close(2)\n" + WORLD + "os._exit(7)\n")
    assert (done.returncode, done.stdout, done.stderr) == (7, "", "")
