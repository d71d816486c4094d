"""Bodies of a scene for rendering, in clients that are never stepped.

A simulated world contains no bodies for rendering, so that rendering cannot change results. The rendered bodies are the
simulated ones, with two additions: a mat marks the place, and each finger has a rail, so that an open finger does not
seem to float.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any

from rgss.errors import SimulationError
from rgss.physics.engine import load_urdf_text, open_client, pybullet
from rgss.physics.hands import finger_joint_names, finger_joint_positions
from rgss.physics.shape_surfaces import half_extent, half_size, object_surfaces, shape_surface
from rgss.physics.solids import Surface, box_surface, cylinder_surface, hull_surface, mesh_surface
from rgss.scenes import (
    CUP_LINK,
    GRIPPER_BASE_LINK,
    Box,
    Cylinder,
    Gripper,
    PlaceRegion,
    Pose,
    Scene,
    Shape,
    Workpiece,
    assembled_urdf,
    convex_parts,
    drawn_mesh,
    finger_link,
    link_names_of,
)

Colour = Sequence[float]


@dataclass(frozen=True, slots=True, kw_only=True)
class SeenSolid:
    """A rendered solid.

    Attributes:
        link: Its link; empty for a fixed body.
        surface: Its surface in its own frame.
        pose: Transform of its frame to the link, or to the world.
        colour: Red, green, blue and opacity, each from 0 to 1.
    """

    link: str
    surface: Surface
    pose: Pose
    colour: Colour


ARM_COLOUR = (0.78, 0.79, 0.81, 1.0)
GRIPPER_BASE_COLOUR = (0.22, 0.23, 0.26, 1.0)
FINGER_COLOUR = (0.96, 0.74, 0.15, 1.0)
RAIL_COLOUR = (0.45, 0.47, 0.50, 1.0)
PLACE_COLOUR = (0.93, 0.93, 0.90, 1.0)
_MAT_THICKNESS_M = 0.002
_RAIL_HEIGHT_M = 0.012


@dataclass(frozen=True, slots=True, kw_only=True)
class Posture:
    """Posture of everything that moves.

    Attributes:
        joints_rad: Joint positions of the arm.
        finger_travel_m: Travel of each finger from open.
        workpiece: Transform of the workpiece to the world.
        others: Those of the other objects, by name.
    """

    joints_rad: Sequence[float]
    finger_travel_m: Sequence[float]
    workpiece: Pose
    others: Mapping[str, Pose] = field(default_factory=dict)


class Stage:
    """Fixed bodies in one client and moving ones in another, so that each can be rendered separately.

    Attributes:
        still: Client of the scene's bodies and of a mat on each marked place.
        moving: Client of the arm, the gripper and the objects.
    """

    def __init__(self, scene: Scene, gripper: Gripper, places: Iterable[PlaceRegion] = ()) -> None:
        """Build the stage.

        Args:
            scene: The scene to render.
            gripper: The gripper on the robot's flange.
            places: The places to mark, on fixed bodies.

        Raises:
            SimulationError: The engine cannot build it.
        """
        self._engine = pybullet()
        self._scene, self._gripper = scene, gripper
        self._clients: list[int] = []
        self._looks: dict[tuple[int, int], tuple[Surface, Colour]] = {}
        self._fixed: list[SeenSolid] = []
        try:
            self.still, self.moving, self._machine = self._open(), self._open(), self._open()
            for body in scene.bodies:
                self._add(self.still, shape_surface(body.primitive), body.pose, body.colour)
            for place in places:
                mat = Cylinder(radius_m=place.radius_m, height_m=_MAT_THICKNESS_M)
                centre = Pose(position_m=place.centre_m).raised(_MAT_THICKNESS_M / 2)
                self._add(self.still, cylinder_surface(mat), centre, PLACE_COLOUR)
            self._half_sizes: dict[int, tuple[float, float, float]] = {}
            self._poses: dict[int, Pose] = {}
            self._objects: list[tuple[int, str, Pose]] = []
            for one in scene.objects:
                self._add_object(one.workpiece)
            self._add_robot()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the clients; closing twice is allowed."""
        while self._clients:
            self._engine.disconnect(physicsClientId=self._clients.pop())

    def take(self, posture: Posture) -> None:
        """Set the pose of everything that moves."""
        engine = self._engine
        joints = (*self._arm_joints, *self._followers, *self._finger_joints)
        fingers = finger_joint_positions(self._gripper.geometry, posture.finger_travel_m)
        followers = self._scene.robot.follower_positions(posture.joints_rad)
        for joint, position in zip(joints, (*posture.joints_rad, *followers, *fingers), strict=True):
            engine.resetJointState(self._robot, joint, position, physicsClientId=self._machine)
        poses = {**posture.others, self._scene.workpiece.id: posture.workpiece}
        for part, name, at in self._objects:
            if name in poses:
                self._place(part, poses[name] @ at)
        for part, link, pose in self._parts:
            self._place(part, self._link_pose(link) @ pose)

    def solids(self) -> tuple[SeenSolid, ...]:
        """The fixed bodies, and the solids of the links of arm and gripper, without objects."""
        moving = []
        for part, link, pose in self._parts:
            surface, colour = self._looks[self.moving, part]
            moving.append(SeenSolid(link=self._link_names[link], surface=surface, pose=pose, colour=colour))
        return (*self._fixed, *moving)

    def link_poses(self) -> dict[str, Pose]:
        """Transforms to the world of the links with solids, as set by `take`."""
        return {self._link_names[link]: self._link_pose(link) for link in sorted({link for _, link, _ in self._parts})}

    def tool_position(self) -> tuple[float, float, float]:
        """Position of the grasp centre in the world."""
        return (self._link_pose(self._flange) @ self._gripper.geometry.grasp_centre).position_m

    def corners(self) -> list[tuple[float, float, float]]:
        """Points of the world whose convex hull contains everything that moves."""
        corners = []
        for body, half in self._half_sizes.items():
            for signs in product((-1, 1), repeat=3):
                x, y, z = (sign * size for sign, size in zip(signs, half, strict=True))
                corners.append((self._poses[body] @ Pose(position_m=(x, y, z))).position_m)
        return corners

    def _add_object(self, workpiece: Workpiece) -> None:
        for surface, at, half in object_surfaces(workpiece.shape):
            part = self._add(self.moving, surface, workpiece.pose @ at, workpiece.colour)
            self._objects.append((part, workpiece.id, at))
            self._half_sizes[part] = half

    def _open(self) -> int:
        client = open_client()
        self._clients.append(client)
        return client

    def _add(self, client: int, surface: Surface, pose: Pose, colour: Colour) -> int:
        visual = self._engine.createVisualShape(
            self._engine.GEOM_MESH,
            vertices=surface.vertices_m,
            normals=surface.normals,
            indices=surface.indices,
            rgbaColor=colour,
            physicsClientId=client,
        )
        body = int(
            self._engine.createMultiBody(0.0, -1, visual, pose.position_m, pose.quaternion_xyzw, physicsClientId=client)
        )
        if visual < 0 or body < 0:
            raise SimulationError("the physics engine rejected a rendered body", hint="check its sizes")
        self._looks[client, body] = surface, colour
        if client == self.still:
            self._fixed.append(SeenSolid(link="", surface=surface, pose=pose, colour=colour))
        return body

    def _place(self, body: int, pose: Pose) -> None:
        self._poses[body] = pose
        self._engine.resetBasePositionAndOrientation(
            body, pose.position_m, pose.quaternion_xyzw, physicsClientId=self.moving
        )

    def _add_robot(self) -> None:
        """Load the machine for the poses of its links, and a rendered part for each solid of a link."""
        engine, client, base = self._engine, self._machine, self._scene.robot.base
        assembled = assembled_urdf(self._scene.robot, self._gripper)
        self._robot = load_urdf_text(
            client,
            assembled,
            position=base.position_m,
            orientation=base.quaternion_xyzw,
            flags=0,
        )
        info: list[Any] = [
            engine.getJointInfo(self._robot, index, physicsClientId=client)
            for index in range(engine.getNumJoints(self._robot, physicsClientId=client))
        ]
        joints = {entry[1].decode(): entry[0] for entry in info}
        links = {entry[12].decode(): entry[0] for entry in info}
        fingers = range(self._gripper.geometry.fingers)
        self._arm_joints = [joints[joint.name] for joint in self._scene.robot.joints]
        self._followers = [joints[one.name] for one in self._scene.robot.followers]
        self._finger_joints = [joints[name] for name in finger_joint_names(self._gripper.geometry)]
        self._flange = links[self._scene.robot.flange]
        colours = {links[finger_link(finger)]: FINGER_COLOUR for finger in fingers}
        colours[links[GRIPPER_BASE_LINK]] = GRIPPER_BASE_COLOUR
        if CUP_LINK in links:
            colours[links[CUP_LINK]] = FINGER_COLOUR
        self._parts = []
        self._seen = self._add_looks(links, colours)
        for _, link, kind, size, _, position, orientation, colour, *_ in engine.getVisualShapeData(
            self._robot, physicsClientId=client
        ):
            if kind == engine.GEOM_MESH or link in self._seen:
                continue
            shape: Shape = (
                Box(size_m=tuple(size)) if kind == engine.GEOM_BOX else Cylinder(radius_m=size[1], height_m=size[0])
            )
            pose = Pose(position_m=tuple(position), quaternion_xyzw=tuple(orientation))
            part = self._add(self.moving, shape_surface(shape), Pose(), colours.get(link, colour))
            self._half_sizes[part] = half_size(shape)
            self._parts.append((part, link, pose))
        links[engine.getBodyInfo(self._robot, physicsClientId=client)[0].decode()] = -1
        for convex in convex_parts(assembled)[1]:
            if links[convex.link] in self._seen:
                continue
            colour = colours.get(links[convex.link], ARM_COLOUR)
            part = self._add(self.moving, hull_surface(convex.vertices_m), Pose(), colour)
            self._half_sizes[part] = half_extent(convex.vertices_m)
            self._parts.append((part, links[convex.link], convex.pose))
        self._link_names = {index: name for name, index in links.items()}
        if self._gripper.geometry.linkage is None:
            self._add_rails(links[GRIPPER_BASE_LINK])

    def _add_looks(self, links: Mapping[str, int], colours: Mapping[int, Colour]) -> frozenset[int]:
        """Add a rendered part for each visual mesh that can be read; the links that are seen by these alone."""
        gripper = self._gripper.geometry.linkage
        looks = [(links.get(look.link), look) for look in self._scene.robot.looks]
        if gripper is not None:
            names = dict(zip((link.name for link in gripper.links), link_names_of(gripper), strict=True))
            looks += [(links[names[look.link]], look) for look in gripper.looks]
        seen = set()
        for link, look in looks:
            mesh = None if link is None else drawn_mesh(look)
            if link is None or mesh is None:
                continue
            surface = mesh_surface(mesh)
            part = self._add(self.moving, surface, Pose(), colours.get(link, look.colour or ARM_COLOUR))
            self._half_sizes[part] = half_extent(surface.vertices_m)
            self._parts.append((part, link, look.pose))
            seen.add(link)
        return frozenset(seen)

    def _add_rails(self, base_link: int) -> None:
        geometry = self._gripper.geometry
        thickness, width, _ = geometry.finger.size_m
        length = geometry.largest_opening_m + thickness
        rail = Box(size_m=(length, 0.6 * width, _RAIL_HEIGHT_M))
        for azimuth in geometry.azimuths_rad:
            centre = (
                length / 2 * math.cos(azimuth),
                length / 2 * math.sin(azimuth),
                geometry.base.height_m - _RAIL_HEIGHT_M / 2,
            )
            pose = Pose.from_roll_pitch_yaw(centre, (0.0, 0.0, azimuth))
            part = self._add(self.moving, box_surface(rail), Pose(), RAIL_COLOUR)
            self._half_sizes[part] = half_size(rail)
            self._parts.append((part, base_link, pose))

    def _link_pose(self, link: int) -> Pose:
        if link < 0:
            return self._scene.robot.base
        state = self._engine.getLinkState(self._robot, link, computeForwardKinematics=1, physicsClientId=self._machine)
        return Pose(position_m=tuple(state[4]), quaternion_xyzw=tuple(state[5]))
