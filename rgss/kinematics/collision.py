"""Collision checking of configurations: arm, gripper and workpiece with the scene and with each other."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.kinematics.collision_context import CollisionContext
from rgss.kinematics.coupling import Coupling
from rgss.kinematics.description import build_model, link_frame
from rgss.kinematics.geometry import Part, collision_parts
from rgss.kinematics.link_contacts import lasting_contacts
from rgss.kinematics.separation_bounds import SeparationBounds
from rgss.scenes import GripperGeometry, Scene

Vector = NDArray[np.float64]

_RANGE_TOLERANCE_RAD = 1e-9
_QUERY_TOLERANCE = 1e-9
# The engine accepts its flag by position only.
_STOP_AT_FIRST, _FIND_ALL = True, False


@dataclass(frozen=True, slots=True, kw_only=True)
class NearestPair:
    """Pair of parts with the least margin, distance minus required clearance.

    Attributes:
        first: Name of the first link, body or workpiece.
        second: Name of the second.
        distance_m: Their distance; minus the penetration depth if they overlap.
        clearance_m: Required distance; 0 if they only must not touch.
    """

    first: str
    second: str
    distance_m: float
    clearance_m: float

    @property
    def room_m(self) -> float:
        """Distance minus clearance in m; negative if the clearance is violated."""
        return self.distance_m - self.clearance_m


class CollisionModel:
    """State validity of the arm in a scene, in one collision context.

    Checked pairs: arm, gripper and carried workpiece with the scene's bodies and the placed workpiece; the links of the
    arm with each other, except neighbours and links that touch in every configuration; gripper and carried workpiece
    with the arm. Parts that cannot move relative to each other are not checked: the gripper and the held workpiece, the
    base and the scene.

    Args:
        scene: The scene with its arm.
        gripper: The gripper at the flange.
        situation: Opening of the gripper, and pose of the workpiece.
        clearance_m: Distance below which a moving part counts as in contact with the scene or the placed workpiece. It
            does not apply between links of the robot, nor between the workpiece and its intended supports.

    Raises:
        DefinitionError: The robot is ill defined, or an allowed pair names an unknown part.
    """

    def __init__(
        self, scene: Scene, gripper: GripperGeometry, situation: CollisionContext, *, clearance_m: float = 0.0
    ) -> None:
        import pinocchio

        self.situation = situation
        self._engine: Any = pinocchio
        self._model = build_model(scene.robot)
        self._coupling = Coupling.of(scene.robot, self._model)
        self._data = self._model.createData()
        # A view of the last joint's placement, which a query updates: the vertical components of its axes.
        self._wrist_vertical = self._data.oMi[self._model.njoints - 1].rotation[2]
        self._lower_rad = tuple(joint.lower_rad - _RANGE_TOLERANCE_RAD for joint in scene.robot.joints)
        self._upper_rad = tuple(joint.upper_rad + _RANGE_TOLERANCE_RAD for joint in scene.robot.joints)
        self._least_upright, self._axis_in_wrist = _uprightness(self._model, scene, gripper, situation)
        self._geometry = pinocchio.GeometryModel()
        parts = collision_parts(self._model, scene, gripper, situation)
        for index, part in enumerate(parts):
            self._geometry.addGeometryObject(
                pinocchio.GeometryObject(f"{part.name}#{index}", part.joint, part.placement, part.shape)
            )
        bearing = {scene.support, scene.place_support}
        margins: list[float] = []
        self._pairs: list[tuple[str, str]] = []
        self._clear: list[int] = []
        allowed = _checked_pairs(situation, scene, parts) | lasting_contacts(scene.robot)
        for first, one in enumerate(parts):
            for second in range(first + 1, len(parts)):
                other = parts[second]
                names = frozenset((one.name, other.name))
                if names in allowed or not one.can_meet(other):
                    continue
                stands = scene.workpiece.id in names and not names.isdisjoint(bearing)
                surroundings = one.chain is None or other.chain is None
                self._geometry.addCollisionPair(pinocchio.CollisionPair(first, second))
                self._pairs.append((one.name, other.name))
                if surroundings and not stands:
                    self._clear.append(len(margins))
                margins.append(clearance_m if surroundings and not stands else 0.0)
        self._margins = tuple(margins)
        self._state = self._geometry.createData()
        for request, margin in zip(self._state.collisionRequests, margins, strict=True):
            request.security_margin = margin
        _forget_history(self._state.collisionRequests)
        _forget_history(self._state.distanceRequests)
        self._bounds = SeparationBounds.of(self._geometry, self._clear)
        # The manager reads the margins at construction and keeps references to its arguments. With a few dozen solids,
        # comparing all boxes takes half the time of maintaining a tree.
        self._manager = pinocchio.BroadPhaseManager_NaiveCollisionManager(self._model, self._geometry, self._state)

    def is_valid(self, q: Sequence[float] | Vector) -> bool:
        """True if a configuration is within the joint ranges, free of collision and carries the workpiece upright.

        Args:
            q: Joint positions, shape (n,).
        """
        # Plain floats compare several times faster than the elements of an array.
        angles: Sequence[float] = q.tolist() if isinstance(q, np.ndarray) else q
        for lower, angle, upper in zip(self._lower_rad, angles, self._upper_rad, strict=True):
            if not lower <= angle <= upper:
                return False
        if self._engine.computeCollisions(
            self._model, self._data, self._manager, self._coupling.positions(q), _STOP_AT_FIRST
        ):
            return False
        # The query above has placed the joints.
        return self._least_upright is None or (
            float(self._wrist_vertical.dot(self._axis_in_wrist)) >= self._least_upright
        )

    def first_invalid_between(self, qs: Vector) -> int | None:
        """Index of the first configuration that is invalid; None if all are valid.

        Args:
            qs: Joint positions, shape (k, n), each between two configurations within the joint ranges, and so within
                them itself.
        """
        collide, model, data, manager = self._engine.computeCollisions, self._model, self._data, self._manager
        least, qs = self._least_upright, self._coupling.positions(qs)
        if least is None:
            for index, q in enumerate(qs):
                if collide(model, data, manager, q, _STOP_AT_FIRST):
                    return index
            return None
        tilt, axis = self._wrist_vertical.dot, self._axis_in_wrist
        for index, q in enumerate(qs):
            if collide(model, data, manager, q, _STOP_AT_FIRST) or tilt(axis) < least:
                return index
        return None

    def contacts(self, q: Sequence[float] | Vector) -> tuple[tuple[str, str], ...]:
        """Pairs of parts that touch or violate the clearance.

        Args:
            q: Joint positions, shape (n,).

        Returns:
            Pairs of names, each pair and all of them in alphabetical order.
        """
        self._engine.computeCollisions(
            self._model, self._data, self._geometry, self._state, self._coupling.positions(q), _FIND_ALL
        )
        touching = {
            (min(names), max(names))
            for names, result in zip(self._pairs, self._state.collisionResults, strict=True)
            if result.isCollision()
        }
        return tuple(sorted(touching))

    def distance(self, q: Sequence[float] | Vector) -> float:
        """Least distance in m of all checked pairs; negative if a pair overlaps.

        Args:
            q: Joint positions, shape (n,).
        """
        self._engine.computeDistances(self._model, self._data, self._geometry, self._state, self._coupling.positions(q))
        return min((float(result.min_distance) for result in self._state.distanceResults), default=float("inf"))

    def clearance_m(self, q: Sequence[float] | Vector) -> float:
        """Least distance in m of the moving parts from the scene and the placed workpiece.

        Infinite if there is no such pair. The clearance is required of these pairs; the workpiece and its intended
        supports are excluded.

        Args:
            q: Joint positions, shape (n,).
        """
        engine, geometry, state = self._engine, self._geometry, self._state
        engine.updateGeometryPlacements(self._model, self._data, geometry, state, self._coupling.positions(q))
        bounds = self._bounds.least_distances_m(state.oMg)
        least = math.inf
        for place in np.argsort(bounds, kind="stable").tolist():
            # The remaining pairs are farther apart than the nearest found.
            if bounds[place] >= least:
                break
            index = self._clear[place]
            least = min(least, float(engine.computeDistance(geometry, state, index).min_distance))
        return least

    def nearest_pair(self, q: Sequence[float] | Vector) -> NearestPair | None:
        """Pair of parts with the least margin, distance minus clearance; None if no pair is checked.

        Args:
            q: Joint positions, shape (n,).
        """
        self._engine.computeDistances(self._model, self._data, self._geometry, self._state, self._coupling.positions(q))
        pairs = [
            NearestPair(first=first, second=second, distance_m=float(result.min_distance), clearance_m=margin)
            for (first, second), result, margin in zip(
                self._pairs, self._state.distanceResults, self._margins, strict=True
            )
        ]
        return min(pairs, key=lambda pair: pair.room_m, default=None)

    def carried_tilt_rad(self, q: Sequence[float] | Vector) -> float | None:
        """Angle in rad between the axis of the carried workpiece and the vertical; None if nothing must stay upright.

        Args:
            q: Joint positions, shape (n,).
        """
        if self._least_upright is None:
            return None
        self._engine.forwardKinematics(self._model, self._data, self._coupling.positions(q))
        return math.acos(min(1.0, max(-1.0, float(self._wrist_vertical.dot(self._axis_in_wrist)))))


def _uprightness(
    model: Any, scene: Scene, gripper: GripperGeometry, situation: CollisionContext
) -> tuple[float | None, Vector]:
    """Least vertical component of the carried workpiece's axis, and that axis in the frame of the last joint."""
    if situation.carried is None or situation.largest_tilt_rad is None:
        return None, np.zeros(3)
    flange = link_frame(model, scene.robot.flange).placement
    held = gripper.grasp_centre @ situation.carried
    axis: Vector = flange.rotation @ np.array(held.rotate((0.0, 0.0, 1.0)))
    return math.cos(situation.largest_tilt_rad), axis


def _forget_history(requests: Iterable[Any]) -> None:
    """Make queries depend on their configuration alone.

    By default each query starts from the result of the previous one, so that a verdict within half a millimetre of
    contact can depend on earlier queries.
    """
    with warnings.catch_warnings():
        # The attribute is deprecated in favour of gjk_initial_guess, but overrides it while it exists.
        warnings.simplefilter("ignore", DeprecationWarning)
        for request in requests:
            request.gjk_tolerance = _QUERY_TOLERANCE
            if hasattr(request, "enable_cached_gjk_guess"):
                request.enable_cached_gjk_guess = False


def _checked_pairs(situation: CollisionContext, scene: Scene, parts: Sequence[Part]) -> set[frozenset[str]]:
    known = {part.name for part in parts} | {scene.workpiece.id}
    unknown = sorted({name for pair in situation.allowed for name in pair} - known)
    if unknown:
        raise DefinitionError(
            f"a contact is allowed with {', '.join(unknown)}, which is not in the scene {scene.id}",
            hint=f"known are {', '.join(sorted(known))}",
        )
    return {frozenset(pair) for pair in situation.allowed}
