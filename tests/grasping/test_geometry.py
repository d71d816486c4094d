"""A grasp that is looked at again and again: what is remembered is what would be worked out anew."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.grasping import ContactKind, Grasp, GraspGeometryCache, Wrench, analyse_grasp

CENTRE = (0.0, 0.0, 0.0)
Z = (0.0, 0.0, 1.0)


def looked_at(contacts, memory=None, **asked):
    return analyse_grasp(
        contacts,
        **{"centre_of_mass_m": CENTRE, "finger_force_limit_n": 10.0, "grasp_axis": Z, **asked},
        characteristic_length_m=0.035,
        external_wrench=Wrench(force_n=(0.3, 0.1, -2.4)),
        memory=memory,
    )


def pair(ring):
    """Two fingers, each with a point above and one below the middle."""
    low, high = (
        [
            replace(point, position_m=(*point.position_m[:2], height), finger=index)
            for index, point in enumerate(ring(2))
        ]
        for height in (-0.03, 0.02)
    )
    return [*low, *high]


@pytest.fixture
def analyses(monkeypatch):
    """Counts how often a geometry is worked out."""
    from rgss.grasping import geometry

    made = []
    original = geometry.GraspGeometry
    monkeypatch.setattr(geometry, "GraspGeometry", lambda *given, **asked: made.append(1) or original(*given, **asked))
    return made


def test_what_is_remembered_is_what_would_be_worked_out(ring, analyses):
    """Over a carry: the forces always change, the contacts stay, move, are lost and come back."""
    rng = np.random.default_rng(3)
    memory, contacts, moves = GraspGeometryCache(), pair(ring), 0
    for step in range(60):
        contacts = [
            replace(
                contact, normal_force_n=float(rng.uniform(0.0, 9.0)), friction_force_n=tuple(rng.normal(0.0, 1.0, 3))
            )
            for contact in contacts
        ]
        if step % 10 == 5:
            moves += 1
            contacts = [replace(each, position_m=tuple(np.array(each.position_m) + 1e-5)) for each in contacts]
        elif step == 30:
            moves += 1
            contacts = contacts[:-1]
        before = len(analyses)
        remembered = looked_at(contacts, memory, with_margins=False, with_strength=step % 3 == 0)
        assert len(analyses) - before == (step % 10 == 5 or step in (0, 30))
        assert remembered == looked_at(contacts, with_margins=False, with_strength=step % 3 == 0)
    assert moves == 7


@pytest.mark.parametrize(
    "change",
    [
        {"position_m": (0.03, 0.0, 0.0200001)},
        {"normal": (-np.cos(1e-5), np.sin(1e-5), 0.0)},
        {"friction": 0.69},
        {"kind": ContactKind.FRICTIONLESS},
        {"finger": 7},
        {"tangent": (0.0, 1.0, 1.0)},
    ],
    ids=lambda change: next(iter(change)),
)
def test_a_contact_that_is_another_is_analysed_anew(ring, analyses, change):
    memory, contacts = GraspGeometryCache(), pair(ring)
    looked_at(contacts, memory)
    moved = [replace(contacts[0], **change), *contacts[1:]]

    assert looked_at(moved, memory) == looked_at(moved)
    assert len(analyses) == 3


@pytest.mark.parametrize("asked", [{"cone_edges": 5}, {"with_margins": False}, {"centre_of_mass_m": (0.0, 0.0, 1e-3)}])
def test_what_is_asked_otherwise_is_analysed_anew(ring, asked):
    memory, contacts = GraspGeometryCache(), pair(ring)
    looked_at(contacts, memory)

    assert looked_at(contacts, memory, **asked) == looked_at(contacts, **asked)


def test_rounding_is_no_motion(ring):
    memory, contacts = GraspGeometryCache(), pair(ring)
    shaken = [replace(each, position_m=tuple(value + 1e-12 for value in each.position_m)) for each in contacts]
    grasps = [Grasp.of(points, CENTRE, 0.035) for points in (contacts, shaken)]

    first, second = (memory.geometry(grasp, cone_edges=6, with_margins=False) for grasp in grasps)
    assert first is second
