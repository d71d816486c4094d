"""A URDF on one line, which the engine would break within a number."""

from __future__ import annotations

import random

import pytest

from rgss.physics.engine import ClientOwner, load_urdf_text, pybullet

pytestmark = pytest.mark.engine

_LINKS = 90


def chain(masses_kg, offsets_m):
    """URDF of a chain of links, without a line break."""
    links = "".join(
        f'<link name="link_{index}"><inertial><mass value="{mass!r}"/>'
        '<inertia ixx="1.0" ixy="0" ixz="0" iyy="1.0" iyz="0" izz="1.0"/></inertial></link>'
        for index, mass in enumerate(masses_kg)
    )
    joints = "".join(
        f'<joint name="joint_{index}" type="revolute"><parent link="link_{index}"/><child link="link_{index + 1}"/>'
        f'<origin xyz="{offset!r} 0 0"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>'
        "</joint>"
        for index, offset in enumerate(offsets_m)
    )
    return f'<robot name="chain">{links}{joints}</robot>'


@pytest.mark.parametrize("seed", range(4))
def test_every_number_of_a_description_on_one_line_is_read(seed):
    draw = random.Random(seed)  # noqa: S311 - a test case
    masses_kg = [draw.uniform(1.0, 9.0) for _ in range(_LINKS)]
    offsets_m = [draw.uniform(1.0, 9.0) for _ in range(_LINKS - 1)]
    text = chain(masses_kg, offsets_m)
    assert len(text) > 2 * 8192
    engine = pybullet()

    with ClientOwner() as owner:
        client = owner._client
        body = load_urdf_text(client, text, position=(0, 0, 0), orientation=(0, 0, 0, 1), flags=0)
        assert engine.getNumJoints(body, physicsClientId=client) == _LINKS - 1
        read_kg = [engine.getDynamicsInfo(body, index, physicsClientId=client)[0] for index in range(_LINKS - 1)]
        read_m = [engine.getJointInfo(body, index, physicsClientId=client)[14][0] for index in range(_LINKS - 1)]

    assert read_kg == pytest.approx(masses_kg[1:], rel=1e-12)
    assert read_m == pytest.approx(offsets_m, rel=1e-12)
