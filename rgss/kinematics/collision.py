"""Collision checking of configurations: arm, gripper and workpiece against the scene and themselves."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.kinematics.collision_context import CollisionContext
from rgss.kinematics.description import build_model
from rgss.kinematics.geometry import Part, collision_parts
from rgss.kinematics.link_contacts import lasting_contacts
from rgss.kinematics.separation_bounds import SeparationBounds
from rgss.scenes import GripperGeometry, Scene

Vector = NDArray[np.float64]

_RANGE_TOLERANCE_RAD = 1e-9
_QUERY_TOLERANCE = 1e-9
# The engine takes its flag by position alone.
_STOP_AT_FIRST, _FIND_ALL = True, False


@dataclass(frozen=True, slots=True, kw_only=True)
class NearestPair:
    """Pair of parts with the least distance beyond its clearance.

    Attributes:
        first: The link, body or workpiece of the one.
        second: That of the other.
        distance_m: Their distance; negative where they overlap, by the depth.
        clearance_m: The distance that they must keep; 0 where they must not touch.
    """

    first: str
    second: str
    distance_m: float
    clearance_m: float

    @property
    def room_m(self) -> float:
        """Distance less the clearance; negative where the clearance is violated."""
        return self.distance_m - self.clearance_m


class CollisionModel:
    """State validity of the arm in a scene, for one situation.

    Checked are arm, gripper and carried workpiece against the scene's bodies and the standing
    workpiece; the links of the arm against each other unless they are neighbours or touch however the arm
    stands; gripper and carried
    workpiece against the arm. Parts that cannot move relative to each other are not checked: the
    gripper and what it holds, the base and the scene.

    Args:
        scene: The scene with its arm.
        gripper: The gripper at the flange.
        situation: Opening of the gripper, and where the workpiece is.
        clearance_m: Distance below which a moving part counts as touching the scene or the standing
            workpiece. It does not hold between links of the robot, nor between the workpiece and the
            bodies that it stands on by intention.

    Raises:
        DefinitionError: The robot is ill defined, or an allowed pair names what is not there.
    """

    def __init__(
        self, scene: Scene, gripper: GripperGeometry, situation: CollisionContext, *, clearance_m: float = 0.0
    ) -> None:
        import pinocchio

        self.situation = situation
        self._engine: Any = pinocchio
        self._model = build_model(scene.robot)
        self._data = self._model.createData()
        # A view of where a query puts the last joint, which carries the gripper: what of its axes is vertical.
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
            _forget_history(request)
        for request in self._state.distanceRequests:
            _forget_history(request)
        self._bounds = SeparationBounds.of(self._geometry, self._clear)
        # The manager reads the margins when it is made and keeps references to what it is made from. With a
        # few dozen solids, comparing all boxes takes half the time of keeping a tree of them in order.
        self._manager = pinocchio.BroadPhaseManager_NaiveCollisionManager(self._model, self._geometry, self._state)

    def is_valid(self, q: Sequence[float] | Vector) -> bool:
        """True if a configuration keeps the joint ranges, touches nothing and keeps what it carries upright.

        Args:
            q: Joint positions, shape (n,).
        """
        # Plain floats compare several times faster than the elements of an array.
        angles: Sequence[float] = q.tolist() if isinstance(q, np.ndarray) else q
        for lower, angle, upper in zip(self._lower_rad, angles, self._upper_rad, strict=True):
            if not lower <= angle <= upper:
                return False
        if self._engine.computeCollisions(
            self._model, self._data, self._manager, np.asarray(q, dtype=float), _STOP_AT_FIRST
        ):
            return False
        # The query above has placed the joints.
        return self._least_upright is None or (
            float(self._wrist_vertical.dot(self._axis_in_wrist)) >= self._least_upright
        )

    def first_invalid_between(self, qs: Vector) -> int | None:
        """Index of the first configuration that is invalid; None if all are valid.

        Args:
            qs: Joint positions, shape (k, n), each between two configurations that keep the joint ranges and so
                within these itself.
        """
        collide, model, data, manager = self._engine.computeCollisions, self._model, self._data, self._manager
        least = self._least_upright
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
        """Name all pairs of parts that touch, or are nearer than the clearance.

        Args:
            q: Joint positions, shape (n,).

        Returns:
            Pairs of names, each pair and all of them in alphabetical order.
        """
        self._engine.computeCollisions(
            self._model, self._data, self._geometry, self._state, np.asarray(q, dtype=float), _FIND_ALL
        )
        touching = {
            (min(names), max(names))
            for names, result in zip(self._pairs, self._state.collisionResults, strict=True)
            if result.isCollision()
        }
        return tuple(sorted(touching))

    def distance(self, q: Sequence[float] | Vector) -> float:
        """Distance in m between the two parts that are nearest to touching; negative when they overlap.

        Args:
            q: Joint positions, shape (n,).
        """
        self._engine.computeDistances(self._model, self._data, self._geometry, self._state, np.asarray(q, dtype=float))
        return min((float(result.min_distance) for result in self._state.distanceResults), default=float("inf"))

    def clearance_m(self, q: Sequence[float] | Vector) -> float:
        """Least distance in m of what moves from the scene and the standing workpiece; infinite where nothing is.

        Of these pairs the clearance is demanded. The workpiece and the bodies that it stands on by intention are none.

        Args:
            q: Joint positions, shape (n,).
        """
        engine, geometry, state = self._engine, self._geometry, self._state
        engine.updateGeometryPlacements(self._model, self._data, geometry, state, np.asarray(q, dtype=float))
        bounds = self._bounds.least_distances_m(state.oMg)
        least = math.inf
        for place in np.argsort(bounds, kind="stable").tolist():
            # What is left is farther away than what was found.
            if bounds[place] >= least:
                break
            index = self._clear[place]
            least = min(least, float(engine.computeDistance(geometry, state, index).min_distance))
        return least

    def nearest_pair(self, q: Sequence[float] | Vector) -> NearestPair | None:
        """The pair of parts with the least distance beyond its clearance; None where no pair is checked.

        Args:
            q: Joint positions, shape (n,).
        """
        self._engine.computeDistances(self._model, self._data, self._geometry, self._state, np.asarray(q, dtype=float))
        pairs = [
            NearestPair(first=first, second=second, distance_m=float(result.min_distance), clearance_m=margin)
            for (first, second), result, margin in zip(
                self._pairs, self._state.distanceResults, self._margins, strict=True
            )
        ]
        return min(pairs, key=lambda pair: pair.room_m, default=None)

    def carried_tilt_rad(self, q: Sequence[float] | Vector) -> float | None:
        """Angle between the axis of what is carried and the vertical; None where nothing has to stay upright.

        Args:
            q: Joint positions, shape (n,).
        """
        if self._least_upright is None:
            return None
        self._engine.forwardKinematics(self._model, self._data, np.asarray(q, dtype=float))
        return math.acos(min(1.0, max(-1.0, float(self._wrist_vertical.dot(self._axis_in_wrist)))))


def _uprightness(
    model: Any, scene: Scene, gripper: GripperGeometry, situation: CollisionContext
) -> tuple[float | None, Vector]:
    """Least vertical part of the carried workpiece's axis, and that axis in the frame of the last joint."""
    if situation.carried is None or situation.largest_tilt_rad is None:
        return None, np.zeros(3)
    flange = model.frames[model.getFrameId(scene.robot.flange)].placement
    held = gripper.grasp_centre @ situation.carried
    axis: Vector = flange.rotation @ np.array(held.rotate((0.0, 0.0, 1.0)))
    return math.cos(situation.largest_tilt_rad), axis


def _forget_history(request: Any) -> None:
    """Make a query depend on its configuration alone.

    By default each query starts from the result of the one before, so that a verdict within half a
    millimetre of touching can depend on what was asked earlier.
    """
    request.gjk_tolerance = _QUERY_TOLERANCE
    with warnings.catch_warnings():
        # The attribute is deprecated in favour of gjk_initial_guess, yet overrules it while it is there.
        warnings.simplefilter("ignore", DeprecationWarning)
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
