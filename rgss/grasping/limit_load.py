"""Greatest load that fingers of limited force bear, with the turning that their pads resist."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.closure import require_force_limit
from rgss.grasping.contact import ContactPoint, Matrix, Vector3
from rgss.grasping.grasp import Grasp
from rgss.grasping.linear import maximise


def load_factor(
    contacts: Sequence[ContactPoint],
    centre_of_mass_m: Vector3,
    load_n: Vector3,
    *,
    finger_force_limit_n: float,
    cone_edges: int = 32,
) -> float:
    """Greatest multiple of a load in the centre of mass that the contacts bear.

    Other than in `wrench_resistance`, a finger does not choose how its points share its force: its pad is plane and
    evenly elastic, so that the normal forces of its points are even but for what a small rotation of the object in the
    hand adds, the same rotation at every pad. Friction is Coulomb's at each point (limit analysis with a linear
    program). A weight beside the line between two pads then turns the object before it slides.

    Args:
        contacts: The contacts, those of each finger with its index.
        centre_of_mass_m: The object's centre of mass, in the frame of the contacts.
        load_n: The load.
        finger_force_limit_n: Greatest normal force of a finger.
        cone_edges: Edges of the pyramid that replaces each friction cone from inside.

    Returns:
        Below 1 the load is not borne; infinite for a zero load.

    Raises:
        DefinitionError: The load is not finite, the limit is not positive, there is no contact, or the solver failed.
    """
    require_force_limit(finger_force_limit_n)
    if not all(map(math.isfinite, load_n)):
        raise DefinitionError(f"a load of {load_n} N cannot be borne", hint="give finite numbers")
    size_n = math.hypot(*load_n)
    if size_n == 0.0:
        return math.inf
    grasp = Grasp.of(contacts, centre_of_mass_m)
    arms, length_m = grasp.arms_m(), grasp.characteristic_length_m
    axes = np.array([contact.axes() for contact in contacts])
    normals = axes[:, 0]
    angles = 2.0 * math.pi * np.arange(cone_edges) / cone_edges
    edges = np.cos(angles)[:, None, None] * axes[:, 1] + np.sin(angles)[:, None, None] * axes[:, 2]

    shares = _shares(grasp, arms, normals, length_m)
    pressed = np.vstack([normals.T @ shares, np.cross(arms, normals).T @ shares / length_m])
    rubbed = np.concatenate([edges, np.cross(arms, edges) / length_m], axis=2).transpose(2, 1, 0).reshape(6, -1)
    load = np.append(np.array(load_n) / size_n, np.zeros(3))

    count, columns = shares.shape
    fingers = len(grasp.fingers())
    friction = np.array([contact.friction for contact in contacts])
    sums = np.kron(np.eye(count), np.ones(cone_edges))
    # Forces in multiples of the limit, the load in multiples of its size: all numbers are near 1.
    best = maximise(
        np.append(np.zeros(columns + rubbed.shape[1]), 1.0),
        equal=(np.hstack([pressed, rubbed, load[:, None]]), np.zeros(6)),
        at_most=(
            np.vstack(
                [
                    np.hstack([-friction[:, None] * shares, sums, np.zeros((count, 1))]),
                    np.hstack([-shares, np.zeros_like(sums), np.zeros((count, 1))]),
                    np.eye(fingers, columns + rubbed.shape[1] + 1),
                ]
            ),
            np.append(np.zeros(2 * count), np.ones(fingers)),
        ),
    )
    return 0.0 if best is None else float(best[-1]) * finger_force_limit_n / size_n


def _shares(grasp: Grasp, arms: Matrix, normals: Matrix, length_m: float) -> Matrix:
    """Normal force of each contact for unit forces of the fingers and unit rotations to both sides about each axis.

    Shape (contacts, fingers + 6).
    """
    members = grasp.fingers()
    even = np.zeros((len(arms), len(members)))
    turned = np.zeros((len(arms), 3))
    for finger, indices in enumerate(map(list, members)):
        even[indices, finger] = 1.0 / len(indices)
        beside = arms[indices] - arms[indices].mean(axis=0)
        # A rotation v moves a point at r by v x r, of which n . (v x r) = v . (r x n) presses the pad.
        turned[indices] = np.cross(beside, normals[indices]) / length_m
    shares: Matrix = np.hstack([even, turned, -turned])
    return shares
