"""Diagrams as graphs of nodes and edges, before layout."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Shape(str, Enum):
    """The outline of a node."""

    BOX = "box"
    ROUND = "round"
    ELLIPSE = "ellipse"
    DIAMOND = "diamond"
    BAR = "bar"
    INITIAL = "initial"
    FINAL = "final"
    ACTOR = "actor"
    FREE = "free"
    """No outline: its text stands alone."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NodePort:
    """A small square at the left or right border of a node.

    Attributes:
        id: Its id within the node.
        label: What is beside it, within the node.
        right: It is on the right border; otherwise on the left.
        sign: What is in the square: ``right`` or ``left`` for an arrow, ``both``, or nothing.
    """

    id: str
    label: str
    right: bool = False
    sign: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Compartment:
    """Lines of a node below its name, apart from others by a line.

    Attributes:
        title: What they are, in italics above them; may be empty.
        lines: The lines, each broken where it does not fit.
    """

    title: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A node of a diagram.

    Attributes:
        id: Its id within the diagram.
        shape: Its outline.
        name: Its name; may be empty.
        stereotype: Its stereotype, shown in guillemets above the name; may be empty.
        texts: Further texts below the name, each broken into lines where it needs them.
        tint: The kind of element that determines its colour: ``need``, ``requirement``,
            ``behaviour``, ``measure``, ``fail`` or empty.
        cluster: Id of its cluster; empty for none.
        compartments: Compartments behind the texts.
        ports: Squares at its borders.
        rank: ``min`` or ``max`` for a node at the beginning or the end of the diagram; else empty.
    """

    id: str
    shape: Shape
    name: str = ""
    stereotype: str = ""
    texts: tuple[str, ...] = ()
    tint: str = ""
    cluster: str = ""
    compartments: tuple[Compartment, ...] = ()
    ports: tuple[NodePort, ...] = ()
    rank: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """Edge from node to node.

    Attributes:
        source: Id of its first node.
        target: Id of its last node.
        head: The shape at its end: ``open``, ``filled``, ``triangle``, ``diamond``, ``crosshair`` or
            nothing.
        dashed: True if it is dashed.
        labels: The lines of text beside it.
        backwards: True if the target is laid out before the source, as a dependency.
        straight: True if it is to be as short and straight as possible, where others bend.
        source_port: Id of the port of its source where it begins; empty for anywhere.
        target_port: Id of the port of its target where it ends.
        flows: A filled triangle at its middle shows that something flows along it.
    """

    source: str
    target: str
    head: str = "open"
    dashed: bool = False
    labels: tuple[str, ...] = ()
    backwards: bool = False
    straight: bool = False
    source_port: str = ""
    target_port: str = ""
    flows: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Cluster:
    """Frame around nodes.

    Attributes:
        id: Its id within the diagram.
        title: Its text.
    """

    id: str
    title: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Graph:
    """A diagram of nodes and edges.

    Attributes:
        nodes: The nodes.
        edges: The edges; both ends are nodes.
        clusters: The frames.
        lanes: Columns from the top to the bottom, from left to right; with them each node's cluster is a
            lane, edges lead downwards, and there are no frames.
        rightwards: Edges lead to the right; otherwise downwards.
        node_width: The greatest width of a line in a node, in pixels.
    """

    nodes: tuple[Node, ...]
    edges: tuple[Edge, ...]
    clusters: tuple[Cluster, ...] = ()
    lanes: tuple[Cluster, ...] = ()
    rightwards: bool = False
    node_width: float = 220.0
