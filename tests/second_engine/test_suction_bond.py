"""The bond of a suction cup in MuJoCo by itself: a weld whose reaction is known, and no contact beside it."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.physics.mujoco.engine import compiled, mujoco
from rgss.physics.mujoco.suction_bond import MujocoBond

pytestmark = pytest.mark.engine

MASS_KG, GRAVITY, OFFSET_M, OVERLAP_M = 0.8, 9.81, 0.03, 0.002
MODEL = f"""
<mujoco>
  <option timestep="0.0005" gravity="0 0 -{GRAVITY}" jacobian="dense"/>
  <worldbody>
    <body name="hand" pos="0 0 1">
      <joint name="turn" type="hinge" axis="0 1 0" damping="1e6"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <body name="suction_cup">
        <geom name="suction_cup" type="cylinder" size="0.01 0.02" contype="4" conaffinity="0" priority="1"/>
      </body>
    </body>
    <body name="workpiece" pos="{OFFSET_M} 0 {1 - 0.02 - 0.05 + OVERLAP_M}">
      <freejoint/>
      <geom name="workpiece" type="box" size="0.06 0.06 0.05" mass="{MASS_KG}" contype="0" conaffinity="4"/>
    </body>
  </worldbody>
  <equality><weld name="workpiece" body1="suction_cup" body2="workpiece" active="false" solref="0.004 1"/></equality>
</mujoco>
"""
LIP_M = (0.0, 0.0, -0.02)


class NoContacts:
    """The contacts of the object with the scene: none."""

    def scene_force_n(self):
        return 0.0


@pytest.fixture
def world():
    model = compiled(MODEL)
    data = mujoco().MjData(model)
    mujoco().mj_forward(model, data)
    return model, data, MujocoBond(model, data, NoContacts(), body="workpiece", lip_m=LIP_M, friction=0.3)


def run(model, data, steps):
    for _ in range(steps):
        mujoco().mj_step(model, data)


def test_what_is_bonded_hangs_and_its_weight_acts_on_the_cup(world):
    """At rest: the weight downwards, and its moment about the lip by the lever of the centre of mass."""
    model, data, bond = world
    bond.attach()
    assert bond.is_attached
    before_m = data.body("workpiece").xpos.copy()
    run(model, data, 1000)

    assert data.body("workpiece").xpos == pytest.approx(before_m, abs=2e-4)
    lip_m = data.body("suction_cup").xpos + np.array(LIP_M)
    force_n, moment_n_m = bond.reaction(tuple(lip_m))
    weight_n = MASS_KG * GRAVITY
    assert force_n == pytest.approx((0.0, 0.0, -weight_n), abs=1e-3)
    lever = np.array([OFFSET_M, 0.0, -0.05 + OVERLAP_M])
    assert moment_n_m == pytest.approx(np.cross(lever, (0.0, 0.0, -weight_n)), abs=1e-3)


def test_cup_and_object_do_not_collide_while_they_are_bonded(world):
    """They overlap by 2 mm: a contact would push the object out of the cup."""
    model, data, bond = world
    bond.attach()
    run(model, data, 2)
    assert data.ncon == 0
    bond.detach()
    assert not bond.is_attached
    run(model, data, 2)
    assert data.ncon > 0
    assert data.contact[0].friction[0] == 0.3


def test_nothing_holds_an_object_that_is_let_go(world):
    model, data, bond = world
    bond.attach()
    run(model, data, 100)
    bond.detach()
    height_m = data.body("workpiece").xpos[2]
    run(model, data, 400)
    # At least as far as it falls in 0.2 s.
    assert height_m - data.body("workpiece").xpos[2] > 0.95 * GRAVITY * 0.2**2 / 2
    assert not bond.is_borne()
