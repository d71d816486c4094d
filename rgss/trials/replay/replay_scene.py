"""Scene of a trial over time, for a three-dimensional viewer."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.physics import SeenSolid

Series = NDArray[np.float64]

LEAST_SHOWN_S = 0.1
"""Least time for which a viewer shows a contact; most that end a trial last one step."""


class NodeKind(str, Enum):
    """Kind of a node."""

    BODY = "body"
    LINK = "link"
    OBJECT = "object"
    PERCEIVED = "perceived"


class LineKind(str, Enum):
    """Kind of a line."""

    PATH = "path"
    GRAPH = "graph"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NodeTrack:
    """Rigid body over time.

    Attributes:
        name: Name of the link, the object or the body.
        kind: Its kind.
        solids: Its solids; their poses are transforms to this node.
        positions_m: Positions of its frame in the world, shape (n, 3), or (1, 3) if it never moves.
        quaternions_xyzw: Its orientations, shape (n, 4) or (1, 4), scalar last, with continuous signs.
    """

    name: str
    kind: NodeKind
    solids: tuple[SeenSolid, ...]
    positions_m: Series
    quaternions_xyzw: Series


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactForce:
    """Force of one finger on the object over time.

    Attributes:
        finger: Index of the finger.
        points_m: Centre of its contact points weighted by their normal forces, in the world, shape (n, 3); NaN without
            contact.
        forces_n: Sum of their normal and friction forces, in the world, shape (n, 3); NaN without contact.
    """

    finger: int
    points_m: Series
    forces_n: Series


@dataclass(frozen=True, slots=True, kw_only=True)
class Touch:
    """Contact of a part of the robot that is not meant to touch, with the greatest force in it.

    Attributes:
        link: The link, or the finger.
        body: The body of the scene or the object that it touches.
        start_s: Time after the first step with this contact.
        end_s: Time after the last one.
        point_m: Point of the greatest force in the world, shape (3,).
        force_n: Normal force on the link there, in the world, shape (3,).
    """

    link: str
    body: str
    start_s: float
    end_s: float
    point_m: tuple[float, float, float]
    force_n: tuple[float, float, float]

    def is_shown_at(self, time_s: float, end_s: float) -> bool:
        """True if a viewer shows the contact: while it lasts, and for 0.1 s at least.

        Args:
            time_s: Time in the viewer.
            end_s: Its last time; a contact that begins later ended the trial, and is shown then.
        """
        return min(self.start_s, end_s) - 1e-9 <= time_s <= max(self.end_s, self.start_s + LEAST_SHOWN_S)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Line:
    """Line of tool positions of a move.

    Attributes:
        phase: The move.
        kind: A path, through all its points; or a graph, of which each pair of points is an edge.
        points_m: The points in the world, shape (k, 3).
    """

    phase: str
    kind: LineKind
    points_m: Series


@dataclass(frozen=True, slots=True, kw_only=True)
class PerceivedOffset:
    """Error of the perceived pose of an object.

    Attributes:
        object: The object's id.
        distance_m: Distance of its perceived from its true position.
        angle_rad: Angle between its perceived and its true orientation.
    """

    object: str
    distance_m: float
    angle_rad: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ReplayScene:
    """Scene of a replay; n samples in simulated time without planning.

    Attributes:
        time_s: Times of the samples, shape (n,).
        nodes: The rendered bodies.
        contacts: The force of each finger, or of the suction cup.
        touches: What else of the robot touched, by start; contacts of less than 0.1 s apart are one.
        lines: Planned paths and graphs of the planner.
        perceived: Error of the perceived pose of each object.
    """

    time_s: Series
    nodes: tuple[NodeTrack, ...]
    contacts: tuple[ContactForce, ...]
    touches: tuple[Touch, ...]
    lines: tuple[Line, ...]
    perceived: tuple[PerceivedOffset, ...]
