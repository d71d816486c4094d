"""Channels of the three-dimensional scene: transforms, shapes, planned paths, contact forces, poses of the object."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.physics import SeenSolid
from rgss.reports.replay.foxglove.channels import Channel, published_schema
from rgss.reports.replay.foxglove.primitives import (
    colour,
    entity,
    points,
    pose,
    quaternion,
    rotation_from_x,
    scene_update,
    timestamp,
    vector,
)
from rgss.reports.replay.timeline import Timeline
from rgss.reports.replay.viewer_names import LONGEST_ARROW_M, TOUCH_ARROW_M, WORLD, frame_of
from rgss.trials.replay import ContactForce, Line, LineKind, NodeKind, NodeTrack, ReplayScene

START_S = 0.0
"""Time of what never changes: the start of the trial."""

_LINE_COLOURS = {LineKind.PATH: (0.15, 0.64, 0.85, 1.0), LineKind.GRAPH: (0.77, 0.80, 0.84, 0.6)}
_ARROW_COLOUR = (0.84, 0.15, 0.16, 1.0)
_TOUCH_COLOUR = (1.0, 0.05, 0.55, 1.0)
_SHAFT_M, _HEAD_M = 0.006, 0.016
_LINE_STRIP, _LINE_LIST = 0, 2
_LINE_PIXELS = 2.0


def scene_channels(timeline: Timeline, scene: ReplayScene) -> tuple[Channel, ...]:
    """Channels of the scene.

    Everything that does not change is published once, on topics of its own, so that a viewer that seeks finds it.
    """
    perceived = [track for track in scene.nodes if track.kind is NodeKind.PERCEIVED]
    bodies = [track for track in scene.nodes if track.kind is not NodeKind.PERCEIVED]
    fixed = {
        "/scene": [_body(track) for track in bodies],
        "/perceived": [_body(track) for track in perceived],
        "/planned_paths": [_line(line) for line in scene.lines if line.kind is LineKind.PATH],
        "/search_graphs": [_line(line) for line in scene.lines if line.kind is LineKind.GRAPH],
    }
    updates = published_schema("SceneUpdate")
    return (
        *_transform_channels(scene),
        *(
            Channel(topic=topic, schema=updates, messages=[(START_S, scene_update(entities))])
            for topic, entities in fixed.items()
        ),
        Channel(topic="/contact_forces", schema=updates, messages=_forces(timeline, scene)),
        *_object_channels(scene, perceived, bodies),
    )


def _transform_channels(scene: ReplayScene) -> tuple[Channel, ...]:
    schema = published_schema("FrameTransforms")
    moving = [track for track in scene.nodes if len(track.positions_m) > 1]
    still = [track for track in scene.nodes if len(track.positions_m) == 1]
    times = scene.time_s.tolist()
    return (
        Channel(topic="/tf_static", schema=schema, messages=[(START_S, _transforms(still, 0, START_S))]),
        Channel(
            topic="/tf",
            schema=schema,
            messages=[(time_s, _transforms(moving, sample, time_s)) for sample, time_s in enumerate(times)],
        ),
    )


def _transforms(tracks: Iterable[NodeTrack], sample: int, time_s: float) -> dict[str, Any]:
    return {
        "transforms": [
            {
                "timestamp": timestamp(time_s),
                "parent_frame_id": WORLD,
                "child_frame_id": frame_of(track),
                "translation": vector(track.positions_m[sample].tolist()),
                "rotation": quaternion(track.quaternions_xyzw[sample].tolist()),
            }
            for track in tracks
        ]
    }


def _body(track: NodeTrack) -> dict[str, Any]:
    return entity(
        frame_of(track),
        frame=frame_of(track),
        time_s=START_S,
        metadata={"kind": track.kind.value},
        triangles=[_triangles(solid) for solid in track.solids],
    )


def _triangles(solid: SeenSolid) -> dict[str, Any]:
    return {
        "pose": pose(solid.pose.position_m, solid.pose.quaternion_xyzw),
        "points": points(solid.surface.vertices_m),
        "color": colour(solid.colour),
        "colors": [],
        "indices": list(solid.surface.indices),
    }


def _line(line: Line) -> dict[str, Any]:
    drawn = {
        "type": _LINE_STRIP if line.kind is LineKind.PATH else _LINE_LIST,
        "pose": pose(),
        "thickness": _LINE_PIXELS,
        "scale_invariant": True,
        "points": points(line.points_m.tolist()),
        "color": colour(_LINE_COLOURS[line.kind]),
        "colors": [],
        "indices": [],
    }
    return entity(
        f"{line.kind.value} of {line.phase}",
        frame=WORLD,
        time_s=START_S,
        metadata={"kind": line.kind.value, "phase": line.phase},
        lines=[drawn],
    )


def _forces(timeline: Timeline, scene: ReplayScene) -> list[tuple[float, dict[str, Any]]]:
    """One entity with the arrows of all fingers at each sample; it replaces that of the previous sample."""
    return [
        (
            time_s,
            scene_update(
                [
                    entity(
                        "contact forces",
                        frame=WORLD,
                        time_s=time_s,
                        arrows=_arrows(scene.contacts, sample, timeline.greatest_force_n),
                    ),
                    entity("robot contacts", frame=WORLD, time_s=time_s, arrows=_touch_arrows(scene, time_s)),
                ]
            ),
        )
        for sample, time_s in enumerate(scene.time_s.tolist())
    ]


def _arrows(contacts: Sequence[ContactForce], sample: int, greatest_n: float) -> list[dict[str, Any]]:
    arrows = []
    for contact in contacts:
        force_n = float(np.linalg.norm(contact.forces_n[sample]))
        if not force_n > 0.0:  # NaN without contact
            continue
        length_m = LONGEST_ARROW_M * force_n / greatest_n
        head_m = min(_HEAD_M, length_m / 2)
        arrows.append(
            _arrow(
                contact.points_m[sample].tolist(), contact.forces_n[sample], length_m - head_m, head_m, _ARROW_COLOUR
            )
        )
    return arrows


def _touch_arrows(scene: ReplayScene, time_s: float) -> list[dict[str, Any]]:
    """Arrows of one length that end at the link: their forces are not on the scale of those of the fingers."""
    arrows = []
    for touch in scene.touches:
        along = np.array(touch.force_n)
        if touch.is_shown_at(time_s, float(scene.time_s[-1])) and along.any():
            tail = np.array(touch.point_m) - TOUCH_ARROW_M * along / np.linalg.norm(along)
            arrows.append(_arrow(tail.tolist(), along, TOUCH_ARROW_M - _HEAD_M, _HEAD_M, _TOUCH_COLOUR))
    return arrows


def _arrow(
    tail_m: list[float], along: NDArray[np.float64], shaft_m: float, head_m: float, of_colour: tuple[float, ...]
) -> dict[str, Any]:
    return {
        "pose": pose(tail_m, rotation_from_x(along)),
        "shaft_length": shaft_m,
        "shaft_diameter": _SHAFT_M,
        "head_length": head_m,
        "head_diameter": 2 * _SHAFT_M,
        "color": colour(of_colour),
    }


def _object_channels(
    scene: ReplayScene, perceived: Sequence[NodeTrack], bodies: Sequence[NodeTrack]
) -> tuple[Channel, ...]:
    """True pose of each object over time, and its perceived pose; the topics of further objects end with their ids."""
    schema = published_schema("PoseInFrame")
    times = scene.time_s.tolist()
    channels = []
    for place, seen in enumerate(perceived):
        true = next(track for track in bodies if track.kind is NodeKind.OBJECT and track.name == seen.name)
        samples = times if len(true.positions_m) > 1 else [START_S]
        of_object = f"/{seen.name}" if place else ""
        channels += [
            Channel(
                topic=f"/object_pose{of_object}",
                schema=schema,
                messages=[(time_s, _pose_in_frame(true, sample, time_s)) for sample, time_s in enumerate(samples)],
            ),
            Channel(
                topic=f"/perceived_object_pose{of_object}",
                schema=schema,
                messages=[(START_S, _pose_in_frame(seen, 0, START_S))],
            ),
        ]
    return tuple(channels)


def _pose_in_frame(track: NodeTrack, sample: int, time_s: float) -> dict[str, Any]:
    return {
        "timestamp": timestamp(time_s),
        "frame_id": WORLD,
        "pose": pose(track.positions_m[sample].tolist(), track.quaternions_xyzw[sample].tolist()),
    }
