"""Scene of a trial over time, for a three-dimensional viewer."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.physics import SeenSolid

Series = NDArray[np.float64]


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
        lines: Planned paths and graphs of the planner.
        perceived: Error of the perceived pose of each object.
        middle_m: Point between grasp and place in the world, the initial target of the viewer.
    """

    time_s: Series
    nodes: tuple[NodeTrack, ...]
    contacts: tuple[ContactForce, ...]
    lines: tuple[Line, ...]
    perceived: tuple[PerceivedOffset, ...]
    middle_m: tuple[float, float, float]
