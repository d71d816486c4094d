"""Reader of MuJoCo's contacts of the last step."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rgss.physics.contacts import Contacts, FingerContact, RobotContact
from rgss.physics.mujoco.model import WorldModel
from rgss.scenes import Pose

Vector3 = tuple[float, float, float]
_NO_FORCE = 0.0


class PointContacts(Contacts):
    """Contacts whose finger points carry their friction forces (N) on the workpiece, in the world."""

    __slots__ = ()

    @property
    def friction_n(self) -> Vector3:
        """Vector sum of the fingers' friction forces on the workpiece, in the world."""
        x, y, z = (math.fsum(friction[axis] for _, friction in self.pressed) for axis in range(3))
        return x, y, z

    @property
    def robot_contacts(self) -> tuple[RobotContact, ...]:
        """Contacts of the robot's parts with the scene, and of what is no finger with the workpiece."""
        return tuple(one for *_, one in self.struck)


class _Point(NamedTuple):
    """One contact of the workpiece, or of the robot with the scene.

    Attributes:
        number: Its index among the engine's contacts.
        partner: The other shape: of the workpiece's partner, or of the scene.
        sign: 1 if the engine's normal points into the workpiece, or into the robot's link; -1 otherwise.
        row: Its first row among the constraint forces; negative if it is not part of the constraint problem.
    """

    number: int
    partner: int
    sign: float
    row: int


class MujocoContactReader:
    """Reader of the engine's contacts of one world, grouped by the bodies in contact."""

    def __init__(self, compiled: Any, data: Any, model: WorldModel) -> None:
        """Look up the shapes of the model.

        Args:
            compiled: The engine's model.
            data: The engine's state, read after each step.
            model: The model with the names of its parts.
        """
        self._data = data
        self._object_of = {int(compiled.geom(name).id): one for name, one in model.object_shapes.items()}
        self._finger_of = {int(compiled.geom(name).id): index for name, index in model.finger_shapes.items()}
        self._fingers = model.pressing
        self._scene_body_of = {int(compiled.geom(name).id): body for name, body in model.scene_bodies.items()}
        links = {**model.links, **{name: f"finger_{index}" for name, index in model.finger_shapes.items()}}
        self._link_of = {int(compiled.geom(name).id): link for name, link in links.items()}
        self.select(next(iter(model.object_bodies)))

    def select(self, name: str) -> None:
        """Make an object the workpiece; the others count as bodies of the scene."""
        self._workpiece = frozenset(shape for shape, one in self._object_of.items() if one == name)
        others = {shape: one for shape, one in self._object_of.items() if one != name}
        self._body_of = {**self._scene_body_of, **others}

    def contacts(self, standing: Contacts | None) -> Contacts:
        """Contacts of the last step; see `ContactWorld.contacts`."""
        robot_points, points = self._sorted()
        robot_bodies = dict.fromkeys((link, body) for link, body, _ in robot_points)
        if standing is not None and not robot_bodies and all(one.partner in self._body_of for one in points):
            return standing
        forces, other_n = [0.0] * self._fingers, 0.0
        # Lists of the whole step: to read single numbers of the engine's arrays takes longer.
        efforts, frames = (self._data.efc_force.tolist(), self._data.contact.frame.tolist()) if points else ([], [])
        pressed: list[tuple[float, Vector3]] = []
        workpiece_bodies: dict[str, None] = {}
        pressing_links: dict[str, None] = {}
        struck = [self._robot_contact(*one) for one in robot_points]
        for point in points:
            body = self._body_of.get(point.partner)
            if body is not None:
                workpiece_bodies[body] = None
                continue
            normal_n = efforts[point.row] if point.row >= 0 else _NO_FORCE
            finger = self._finger_of.get(point.partner)
            if finger is None:
                other_n += normal_n
                link = self._link_of[point.partner]
                pressing_links[link] = None
                struck.append(self._robot_contact(link, None, point._replace(sign=-point.sign)))
            elif normal_n > _NO_FORCE:
                forces[finger] += normal_n
                pressed.append((1.0, _friction_n(point, efforts, frames[point.number])))
        return PointContacts(
            tuple(forces),
            other_n,
            tuple(pressed),
            tuple(robot_bodies),
            tuple(workpiece_bodies),
            tuple(pressing_links),
            tuple((one.link, one.body, 1.0, one) for one in struck),
        )

    def scene_force_n(self) -> float:
        """Sum of the normal forces of the scene's bodies on the workpiece in the last step."""
        _, points = self._sorted()
        return math.fsum(self._normal_n(one) for one in points if one.partner in self._body_of)

    def finger_contacts(self, transform_workpiece_to_world: Pose) -> tuple[FingerContact, ...]:
        """Contact points of the fingers on the workpiece, by finger and ascending height.

        Args:
            transform_workpiece_to_world: Pose at the start of the step, at which the engine detected the contacts.
        """
        inverse = transform_workpiece_to_world.inverse()
        efforts, frames = self._data.efc_force.tolist(), self._data.contact.frame.tolist()
        found = []
        for point in self._sorted()[1]:
            finger = self._finger_of.get(point.partner)
            normal_n = self._normal_n(point)
            if finger is None or normal_n <= _NO_FORCE:
                continue
            normal = _triple(point.sign * self._frame(point)[0])
            gap_m = float(self._data.contact.dist[point.number])
            # The engine's point lies between the surfaces.
            middle = self._data.contact.pos[point.number]
            at = _triple(middle + np.array(normal) * gap_m / 2)
            found.append(
                FingerContact(
                    finger,
                    (inverse @ Pose(position_m=at)).position_m,
                    inverse.rotate(normal),
                    gap_m,
                    normal_n,
                    inverse.rotate(_friction_n(point, efforts, frames[point.number])),
                )
            )
        return tuple(sorted(found, key=lambda contact: (contact.finger, contact.position_m[2])))

    def _sorted(self) -> tuple[Sequence[tuple[str, str, _Point]], Sequence[_Point]]:
        """Contacts (link, body, point) of the robot with the scene, and those of the workpiece."""
        contact = self._data.contact
        robot_points = []
        points = []
        pairs, rows = contact.geom.tolist(), contact.efc_address.tolist()
        for index, ((one, other), row) in enumerate(zip(pairs, rows, strict=True)):
            # The engine's normal points from the first shape to the second.
            if other in self._workpiece:
                points.append(_Point(index, one, 1.0, row))
            elif one in self._workpiece:
                points.append(_Point(index, other, -1.0, row))
            elif one in self._link_of or other in self._link_of:
                link, body = (one, other) if one in self._link_of else (other, one)
                into_link = 1.0 if link == other else -1.0
                robot_points.append((self._link_of[link], self._body_of[body], _Point(index, body, into_link, row)))
        return robot_points, points

    def _robot_contact(self, link: str, body: str | None, point: _Point) -> RobotContact:
        """Contact with the normal force on the link."""
        force = self._normal_n(point) * point.sign * self._frame(point)[0]
        return RobotContact(link, body, _triple(self._data.contact.pos[point.number]), _triple(force))

    def _normal_n(self, point: _Point) -> float:
        # With elliptic cones the first row of a contact is its normal force, the next two are its friction.
        return float(self._data.efc_force[point.row]) if point.row >= 0 else _NO_FORCE

    def _frame(self, point: _Point) -> NDArray[np.float64]:
        """Normal and two tangents of a contact as rows (3, 3), in the world."""
        frame: NDArray[np.float64] = self._data.contact.frame[point.number].reshape(3, 3)
        return frame


def _friction_n(point: _Point, efforts: Sequence[float], frame: Sequence[float]) -> Vector3:
    """Friction force on the workpiece, in the world, from the forces of all constraints and the frame by rows."""
    first, second = efforts[point.row + 1], efforts[point.row + 2]
    x, y, z = (point.sign * (first * frame[3 + axis] + second * frame[6 + axis]) for axis in range(3))
    return x, y, z


def _triple(vector: NDArray[np.float64]) -> Vector3:
    x, y, z = vector.tolist()
    return x, y, z
