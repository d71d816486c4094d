"""The GLB file of a replay, read by libraries of other hands."""

from __future__ import annotations

import io
import json
import struct

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation, Slerp

from rgss.reports.replay.gltf_scene import ANIMATION, replay_to_glb
from tests.fixtures.made_replay import made_scene

_TYPES = {5126: "<f4", 5123: "<u2", 5125: "<u4"}
_COMPONENTS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


@pytest.fixture(scope="module")
def scene():
    return made_scene()


@pytest.fixture(scope="module")
def glb(scene):
    return replay_to_glb(scene, title="Variant 5")


@pytest.fixture(scope="module")
def parts(glb):
    """The JSON and the buffer of the file, by the layout of the standard."""
    magic, version, length = struct.unpack_from("<4sII", glb)
    assert (magic, version, length) == (b"glTF", 2, len(glb))
    size, kind = struct.unpack_from("<I4s", glb, 12)
    assert kind == b"JSON"
    buffer_size, buffer_kind = struct.unpack_from("<I4s", glb, 20 + size)
    assert (buffer_kind, size % 4, buffer_size % 4) == (b"BIN\0", 0, 0)
    return json.loads(glb[20 : 20 + size]), glb[28 + size :]


def values(parts, accessor):
    document, buffer = parts
    entry = document["accessors"][accessor]
    view = document["bufferViews"][entry["bufferView"]]
    count = entry["count"] * _COMPONENTS[entry["type"]]
    start = view.get("byteOffset", 0)
    assert start % 4 == 0
    found = np.frombuffer(buffer, _TYPES[entry["componentType"]], count, start).reshape(entry["count"], -1)
    assert entry["min"] == pytest.approx(found.min(axis=0).tolist())
    assert entry["max"] == pytest.approx(found.max(axis=0).tolist())
    return found


def node_of(parts, name):
    (found,) = (index for index, node in enumerate(parts[0]["nodes"]) if node.get("name") == name)
    return found


def channel(parts, name, path):
    (animation,) = parts[0]["animations"]
    target = {"node": node_of(parts, name), "path": path}
    (found,) = (one for one in animation["channels"] if one["target"] == target)
    sampler = animation["samplers"][found["sampler"]]
    assert sampler["interpolation"] == "LINEAR"
    return values(parts, sampler["input"])[:, 0], values(parts, sampler["output"])


def test_the_same_replay_gives_the_same_bytes(scene, glb):
    assert replay_to_glb(scene, title="Variant 5") == glb


def test_what_moves_is_animated_and_nothing_else(scene, parts):
    (animation,) = parts[0]["animations"]
    animated = {parts[0]["nodes"][one["target"]["node"]]["name"] for one in animation["channels"]}

    assert animation["name"] == ANIMATION
    assert animated == {"link/1", "gripper_base", "red cup"}


@pytest.mark.parametrize(("place", "name"), [(1, "link/1"), (2, "gripper_base"), (3, "red cup")])
def test_poses_are_those_of_the_scene_also_between_samples(scene, parts, place, name):
    track = scene.nodes[place]
    times, translations = channel(parts, name, "translation")
    _, rotations = channel(parts, name, "rotation")

    assert times == pytest.approx(scene.time_s, abs=1e-6)
    assert translations == pytest.approx(track.positions_m, abs=1e-6)
    between = (scene.time_s[1:] + scene.time_s[:-1]) / 2
    read = Slerp(times, Rotation.from_quat(rotations))(between)
    true = Slerp(scene.time_s, Rotation.from_quat(track.quaternions_xyzw))(between)
    assert (read * true.inv()).magnitude().max() < 1e-5


def test_trimesh_reads_every_solid_where_it_is(scene, glb):
    loaded = trimesh.load(io.BytesIO(glb), file_type="glb")
    to_y_up = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
    for node in scene.nodes:
        name = f"{'perceived ' if node.kind.value == 'perceived' else ''}{node.name}"
        placed = np.eye(4)
        placed[:3, 3] = node.positions_m[0]
        placed[:3, :3] = Rotation.from_quat(node.quaternions_xyzw[0]).as_matrix()
        assert loaded.graph[name][0] == pytest.approx(to_y_up @ placed, abs=1e-6)
        assert f"{node.name}/1" in loaded.graph.nodes_geometry
    floor = loaded.geometry[loaded.graph["the floor/1"][1]]
    assert floor.extents == pytest.approx((3.0, 3.0, 0.1), abs=1e-6)
    assert floor.is_winding_consistent


def test_lines_and_kinds_are_told_apart(scene, parts):
    document = parts[0]
    kinds = [node["extras"]["kind"] for node in document["nodes"] if node.get("extras")]
    assert kinds == [node.kind.value for node in scene.nodes] + [line.kind.value for line in scene.lines]
    for line in scene.lines:
        node = document["nodes"][node_of(parts, f"{line.kind.value} of {line.phase}")]
        (primitive,) = document["meshes"][node["mesh"]]["primitives"]
        assert primitive["mode"] == (3 if line.kind.value == "path" else 1)
        assert values(parts, primitive["attributes"]["POSITION"]) == pytest.approx(line.points_m, abs=1e-6)


def test_colours_are_linear_and_what_is_perceived_is_transparent(scene, parts):
    document = parts[0]
    factors = {
        tuple(round(value, 4) for value in one["pbrMetallicRoughness"]["baseColorFactor"]): one["alphaMode"]
        for one in document["materials"]
    }
    assert {alpha for colour, alpha in factors.items() if colour[3] < 1.0} == {"BLEND"}
    # IEC 61966-2-1: sRGB 0.8, 0.3 and 0.2 as linear light.
    assert (0.6038, 0.0732, 0.0331, 1.0) in factors
