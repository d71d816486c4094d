"""Replay of a trial as a binary glTF 2.0 file (GLB) with one animation."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rgss.physics import SeenSolid
from rgss.reports.replay.gltf_buffer import GltfBuffer
from rgss.trials.replay import Line, LineKind, NodeKind, NodeTrack, ReplayScene

ANIMATION = "trial"
"""Name of the animation."""

_TO_Y_UP = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]
_LINE_COLOURS = {LineKind.PATH: (0.02, 0.36, 0.68, 1.0), LineKind.GRAPH: (0.55, 0.60, 0.66, 1.0)}
_METALLIC = {NodeKind.LINK: 0.25}
_ROUGHNESS = 0.65
_LINES, _LINE_STRIP = 1, 3


def replay_to_glb(scene: ReplayScene, *, title: str) -> bytes:
    """A replay as a GLB file.

    Every node is a child of one that rotates the world frame (z up) into that of glTF (y up). The extras of
    a node have its `kind`: body, link, object, perceived, path or graph; those of a line have its `phase`. Times are
    those of the trial.
    """
    import pygltflib

    document = pygltflib.GLTF2(
        asset=pygltflib.Asset(version="2.0", generator="rgss", extras={"title": title}),
        scene=0,
        scenes=[pygltflib.Scene(nodes=[0])],
    )
    return _Writer(document).written(scene)


class _Writer:
    def __init__(self, document: Any) -> None:
        self._document = document
        self._buffer = GltfBuffer(document)
        self._materials: dict[tuple[object, ...], int] = {}

    def written(self, scene: ReplayScene) -> bytes:
        import pygltflib

        root = pygltflib.Node(name="world", rotation=_TO_Y_UP, children=[])
        self._document.nodes.append(root)
        animation = pygltflib.Animation(name=ANIMATION)
        times = self._buffer.add_floats(scene.time_s)
        for track in scene.nodes:
            node = self._add_node(track)
            root.children.append(node)
            if len(track.positions_m) > 1:
                self._animate(animation, track, node=node, times=times)
        for line in scene.lines:
            root.children.append(self._add_line(line))
        if animation.channels:
            self._document.animations.append(animation)
        content = self._buffer.content
        self._document.buffers.append(pygltflib.Buffer(byteLength=len(content)))
        self._document.set_binary_blob(content)
        return b"".join(self._document.save_to_bytes())

    def _add_node(self, track: NodeTrack) -> int:
        import pygltflib

        parts: list[int] = []
        for solid in track.solids:
            parts.append(
                self._append(
                    pygltflib.Node(
                        name=f"{track.name}/{len(parts) + 1}",
                        mesh=self._add_mesh(track, solid),
                        translation=list(solid.pose.position_m),
                        rotation=list(solid.pose.quaternion_xyzw),
                    )
                )
            )
        return self._append(
            pygltflib.Node(
                name=f"perceived {track.name}" if track.kind is NodeKind.PERCEIVED else track.name,
                children=parts,
                translation=track.positions_m[0].tolist(),
                rotation=track.quaternions_xyzw[0].tolist(),
                extras={"kind": track.kind.value},
            )
        )

    def _add_line(self, line: Line) -> int:
        import pygltflib

        attributes = pygltflib.Attributes(POSITION=self._buffer.add_floats(line.points_m, is_vertex=True))
        primitive = pygltflib.Primitive(
            attributes=attributes,
            mode=_LINE_STRIP if line.kind is LineKind.PATH else _LINES,
            material=self._material(_LINE_COLOURS[line.kind], metallic=0.0),
        )
        name = f"{line.kind.value} of {line.phase}"
        self._document.meshes.append(pygltflib.Mesh(name=name, primitives=[primitive]))
        mesh = len(self._document.meshes) - 1
        extras = {"kind": line.kind.value, "phase": line.phase}
        return self._append(pygltflib.Node(name=name, mesh=mesh, extras=extras))

    def _add_mesh(self, track: NodeTrack, solid: SeenSolid) -> int:
        import pygltflib

        surface = solid.surface
        primitive = pygltflib.Primitive(
            attributes=pygltflib.Attributes(
                POSITION=self._buffer.add_floats(np.array(surface.vertices_m), is_vertex=True),
                NORMAL=self._buffer.add_floats(np.array(surface.normals), is_vertex=True),
            ),
            indices=self._buffer.add_indices(surface.indices),
            material=self._material(tuple(solid.colour), metallic=_METALLIC.get(track.kind, 0.0)),
        )
        self._document.meshes.append(pygltflib.Mesh(name=track.name, primitives=[primitive]))
        return len(self._document.meshes) - 1

    def _material(self, colour: tuple[float, ...], *, metallic: float) -> int:
        import pygltflib

        key = (colour, metallic)
        if key not in self._materials:
            red, green, blue = (_linear(value) for value in colour[:3])
            self._document.materials.append(
                pygltflib.Material(
                    pbrMetallicRoughness=pygltflib.PbrMetallicRoughness(
                        baseColorFactor=[red, green, blue, float(colour[3])],
                        metallicFactor=metallic,
                        roughnessFactor=_ROUGHNESS,
                    ),
                    alphaMode=pygltflib.BLEND if colour[3] < 1.0 else pygltflib.OPAQUE,
                    alphaCutoff=None,
                )
            )
            self._materials[key] = len(self._document.materials) - 1
        return self._materials[key]

    def _animate(self, animation: Any, track: NodeTrack, *, node: int, times: int) -> None:
        import pygltflib

        for path, values in (("translation", track.positions_m), ("rotation", track.quaternions_xyzw)):
            sampler = pygltflib.AnimationSampler(
                input=times, output=self._buffer.add_floats(values), interpolation=pygltflib.ANIM_LINEAR
            )
            animation.samplers.append(sampler)
            target = pygltflib.AnimationChannelTarget(node=node, path=path)
            animation.channels.append(pygltflib.AnimationChannel(sampler=len(animation.samplers) - 1, target=target))

    def _append(self, node: Any) -> int:
        self._document.nodes.append(node)
        return len(self._document.nodes) - 1


def _linear(value: float) -> float:
    """Linear value of an sRGB value (IEC 61966-2-1); colours of glTF are linear."""
    return value / 12.92 if value <= 0.04045 else float(((value + 0.055) / 1.055) ** 2.4)
