"""Grasps whose answers are known, and ways to turn them about."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.grasping import ContactKind, ContactPoint, Grasp

CENTRE = (0.0, 0.0, 0.0)
# Seven frictionless contacts on the faces of a cube with edges of 2 m, as (position, inward normal). Pressed with
# 1, 1, 1, 1, 2, 1, 1 N they balance, and no six of them can.
CUBE = [
    ((-1.0, -0.5, 0.0), (1.0, 0.0, 0.0)),
    ((1.0, 0.0, -0.5), (-1.0, 0.0, 0.0)),
    ((0.0, -1.0, 0.0), (0.0, 1.0, 0.0)),
    ((0.5, 1.0, 0.5), (0.0, -1.0, 0.0)),
    ((0.0, 0.0, -1.0), (0.0, 0.0, 1.0)),
    ((0.0, 0.5, 1.0), (0.0, 0.0, -1.0)),
    ((-0.5, 0.0, 1.0), (0.0, 0.0, -1.0)),
]


def _triple(vector):
    return tuple(float(value) for value in vector)


def _turned(vector, rotation):
    return None if vector is None else _triple(rotation @ np.array(vector))


@pytest.fixture(scope="session")
def triple():
    """An array as three floats."""
    return _triple


@pytest.fixture(scope="session")
def ring():
    """Contacts evenly round a vertical cylinder about the origin, pressing inward."""

    def make(count, *, radius_m=0.03, height_m=0.0, **details):
        contacts = []
        for index in range(count):
            angle = 2 * math.pi * index / count
            outward = (math.cos(angle), math.sin(angle), 0.0)
            contacts.append(
                ContactPoint(
                    position_m=(radius_m * outward[0], radius_m * outward[1], height_m),
                    normal=_triple(-np.array(outward)),
                    **{"friction": 0.5, **details},
                )
            )
        return contacts

    return make


@pytest.fixture(scope="session")
def cube():
    """Seven frictionless contacts that immobilise a cube."""
    return [
        ContactPoint(position_m=position, normal=normal, kind=ContactKind.FRICTIONLESS) for position, normal in CUBE
    ]


@pytest.fixture(scope="session")
def random_rotation():
    """A rotation matrix of a random generator."""

    def make(rng):
        matrix, triangular = np.linalg.qr(rng.normal(size=(3, 3)))
        matrix = matrix * np.sign(np.diag(triangular))
        return matrix * np.linalg.det(matrix)

    return make


@pytest.fixture(scope="session")
def moved():
    """Contacts turned about the origin and then shifted."""

    def move(contacts, rotation, shift):
        return [
            replace(
                contact,
                position_m=_triple(rotation @ np.array(contact.position_m) + shift),
                normal=_turned(contact.normal, rotation),
                friction_force_n=_turned(contact.friction_force_n, rotation),
                relative_velocity_m_s=_turned(contact.relative_velocity_m_s, rotation),
                tangent=_turned(contact.tangent, rotation),
            )
            for contact in contacts
        ]

    return move


@pytest.fixture(scope="session")
def random_contacts():
    """Contacts on an ellipsoid with normals some way off its own, of every kind."""

    def make(rng, count, *, kinds=tuple(ContactKind), half_axes_m=(0.03, 0.04, 0.06)):
        axes, contacts = np.array(half_axes_m), []
        for index in range(count):
            direction = rng.normal(size=3)
            direction /= np.linalg.norm(direction)
            normal = -direction / axes + rng.normal(size=3) * 3.0
            normal /= np.linalg.norm(normal)
            tangent = np.cross(normal, rng.normal(size=3))
            contacts.append(
                ContactPoint(
                    position_m=_triple(axes * direction),
                    normal=_triple(normal),
                    kind=kinds[int(rng.integers(len(kinds)))],
                    friction=float(rng.uniform(0.2, 1.0)),
                    torsional_friction_m=float(rng.uniform(0.002, 0.02)),
                    normal_force_n=float(rng.uniform(1.0, 10.0)),
                    friction_force_n=_triple(rng.normal(size=3)),
                    finger=index,
                    tangent=_triple(tangent),
                )
            )
        return contacts

    return make


@pytest.fixture(scope="session")
def grasp_of():
    """A grasp about the origin."""

    def make(contacts, length_m=None):
        return Grasp.of(contacts, CENTRE, length_m)

    return make
