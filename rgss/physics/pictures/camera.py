"""Rendering of a scene with shadows."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType, TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.physics.pictures.framing import Framing, corners_of, framed_corners, framing
from rgss.physics.pictures.rendering import Array, Lens, Picture, Vector, Window, draw
from rgss.physics.pictures.shadows import Light, Receiver, darkness
from rgss.physics.stage import Posture, Stage
from rgss.scenes import Gripper, PlaceRegion, Scene

_SUPERSAMPLING = 2
_FIELD_OF_VIEW_RAD = math.radians(36)
_NEAR_M, _FAR_M = 0.15, 12.0
_ABOVE_M = 0.14
_ARM_REACH_M, _SCENE_REACH_M = 2.0, 2.6
_SKY = np.array([233, 238, 243], dtype=np.float32)
_SKY_DEPTH = 0.9999


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """Viewpoint of a camera.

    Attributes:
        azimuth_rad: Azimuth of the camera seen from its target, from the world's x towards its y.
        elevation_rad: Elevation of the camera above the horizontal, seen from its target.
        distance_m: Distance of the camera from its target.
        follows_tool: True if the target is the grasp centre; else it is just above the middle of the task.
        is_fitted: True if target and distance are those at which a trial is in the picture, where the trial is known.
    """

    azimuth_rad: float
    elevation_rad: float
    distance_m: float
    follows_tool: bool = False
    is_fitted: bool = False


VIEWS: Mapping[str, View] = MappingProxyType(
    {
        "overview": View(
            azimuth_rad=math.radians(215), elevation_rad=math.radians(25), distance_m=2.85, is_fitted=True
        ),
        "hand": View(azimuth_rad=math.radians(235), elevation_rad=math.radians(14), distance_m=0.85, follows_tool=True),
        "side": View(azimuth_rad=math.radians(230), elevation_rad=math.radians(8), distance_m=2.8, is_fitted=True),
    }
)
"""Predefined views by name, for scenes of the size of an arm's reach."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Background:
    """Image of the fixed bodies from the camera.

    Attributes:
        picture: Its colours (height, width, 3), with the shadows of the fixed bodies.
        depths: Its depths at the finer resolution.
        darkness: Share (height, width) of the colour that is lost in full shadow.
        receiver: Its points as seen from the light that follows the moving bodies.
    """

    picture: Array
    depths: Array
    darkness: Array
    receiver: Receiver


class Camera:
    """Camera of a scene; a context manager that closes its stage."""

    def __init__(
        self,
        scene: Scene,
        gripper: Gripper,
        view: View,
        *,
        width: int,
        height: int,
        places: Iterable[PlaceRegion] = (),
    ) -> None:
        """Build the stage and the light.

        Args:
            scene: The scene to render.
            gripper: The gripper on the robot's flange.
            view: The viewpoint.
            width: Width of the pictures in pixels.
            height: Height of the pictures in pixels.
            places: The places to mark, on fixed bodies.

        Raises:
            SimulationError: The engine cannot build the stage.
        """
        self._view = view
        self._width, self._height = width, height
        grasp, place = scene.grasp.position_m, scene.place_pose.position_m
        x, y, z = ((a + b) / 2 for a, b in zip(grasp, place, strict=True))
        self._middle = (x, y, z + _ABOVE_M)
        self._framing: Framing | None = None
        self._reach_m = min(_ARM_REACH_M, 1.2 * view.distance_m)
        self._background: _Background | None = None
        self._sun = Light(self._middle, reach_m=_SCENE_REACH_M, resolution=1024, tolerance_m=0.045)
        self._sun_depths: Array | None = None
        self._stage = Stage(scene, gripper, places)

    def __enter__(self) -> Camera:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the stage; closing twice is allowed."""
        self._stage.close()

    def fit(self, postures: Iterable[Posture]) -> None:
        """Fit the camera's position to the moving bodies in these postures and the fixed ones near them; see `View`."""
        if not self._view.is_fitted:
            return
        moving: list[Vector] = []
        for posture in postures:
            self._stage.take(posture)
            moving += self._stage.corners()
        points = np.array(moving, dtype=float)
        self._framing = framing(
            framed_corners(points, [corners_of(solid) for solid in self._stage.solids() if not solid.link]),
            azimuth_rad=self._view.azimuth_rad,
            elevation_rad=self._view.elevation_rad,
            field_of_view_rad=_FIELD_OF_VIEW_RAD,
            aspect=self._width / self._height,
        )
        # The light that follows the moving bodies covers all of them.
        self._reach_m = min(_ARM_REACH_M, float(np.linalg.norm(np.ptp(points, axis=0))))
        self._background = None

    def picture(self, posture: Posture) -> Picture:
        """Render the scene.

        Args:
            posture: Posture of everything that moves.
        """
        stage = self._stage
        stage.take(posture)
        target = stage.tool_position() if self._view.follows_tool else self._middle
        lens = self._lens(target)
        light = Light(target, reach_m=self._reach_m, resolution=640, tolerance_m=0.005)
        # Fixed bodies are drawn once, if the camera is fixed too.
        if self._background is None or self._view.follows_tool:
            self._background = self._draw_background(lens, light)
        background = self._background
        shadow = light.shadow(light.depths_of(stage.moving), background.receiver)
        picture: Array = background.picture * (1 - background.darkness * shadow)[:, :, np.newaxis]
        window = self._window(lens)
        if window is not None:
            fine = window.scaled(_SUPERSAMPLING)
            colours, depths = draw(stage.moving, lens.enlarged(_SUPERSAMPLING), fine)
            in_front = (depths < background.depths[fine.slices])[:, :, np.newaxis]
            seen = picture[window.slices]
            picture[window.slices] = seen * (1 - _coarse(in_front)) + _coarse(colours * in_front)
        return np.rint(picture).astype(np.uint8)

    def _draw_background(self, lens: Lens, light: Light) -> _Background:
        fine = lens.enlarged(_SUPERSAMPLING)
        colours, depths = draw(self._stage.still, fine)
        sky = depths >= _SKY_DEPTH
        picture = _coarse(np.where(sky[:, :, np.newaxis], _SKY, colours))
        points = lens.unproject(np.ascontiguousarray(depths[::_SUPERSAMPLING, ::_SUPERSAMPLING]))
        loss = np.where(sky[::_SUPERSAMPLING, ::_SUPERSAMPLING], np.float32(0.0), darkness(points))
        if self._sun_depths is None:
            self._sun_depths = self._sun.depths_of(self._stage.still)
        shadow = loss * self._sun.shadow(self._sun_depths, self._sun.receiver(points))
        return _Background(
            picture=picture * (1 - shadow)[:, :, np.newaxis],
            depths=depths,
            # Points already in shadow do not get darker.
            darkness=(loss - shadow) / (1 - shadow),
            receiver=light.receiver(points),
        )

    def _window(self, lens: Lens) -> Window | None:
        """Window of the picture that the moving bodies can cover; None if they are out of view."""
        columns, rows, _ = lens.project(np.array(self._stage.corners(), dtype=np.float32))
        if np.isnan(columns).any():  # some of the points are behind the camera
            return Window(top=0, bottom=lens.height, left=0, right=lens.width)
        left, top = (max(0, math.floor(values.min()) - 1) for values in (columns, rows))
        right, bottom = (
            min(size, math.ceil(values.max()) + 1) for size, values in ((lens.width, columns), (lens.height, rows))
        )
        return Window(top=top, bottom=bottom, left=left, right=right) if top < bottom and left < right else None

    def _lens(self, target: Vector) -> Lens:
        view = self._view
        across = view.distance_m * math.cos(view.elevation_rad)
        along = (math.cos(view.azimuth_rad), math.sin(view.azimuth_rad))
        straight_down = across < 1e-3 * view.distance_m
        eye = (
            target[0] + across * along[0],
            target[1] + across * along[1],
            target[2] + view.distance_m * math.sin(view.elevation_rad),
        )
        fitted = self._framing
        return Lens(
            eye_m=eye if fitted is None else fitted.eye_m,
            target_m=target if fitted is None else fitted.target_m,
            up=(-along[0], -along[1], 0.0) if straight_down else (0.0, 0.0, 1.0),
            field_of_view_rad=_FIELD_OF_VIEW_RAD,
            width=self._width,
            height=self._height,
            near_m=_NEAR_M,
            far_m=_FAR_M,
        )


def _coarse(values: NDArray[Any]) -> Array:
    """Mean of each block of pixels (box filter)."""
    n = _SUPERSAMPLING
    total: Array = values[0::n, 0::n].astype(np.float32)
    for row in range(n):
        for column in range(n):
            if row or column:
                total += values[row::n, column::n]
    mean: Array = total / np.float32(n**2)
    return mean
