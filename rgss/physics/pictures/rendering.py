"""Rendering with the engine's software renderer: colours, depths, projection and unprojection."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.physics.engine import pybullet

Array = NDArray[np.float32]
Picture = NDArray[np.uint8]
"""An image of shape (height, width, 3): red, green and blue from 0 to 255, the first row on top."""

Vector = tuple[float, float, float]

TOWARDS_LIGHT: Vector = (-2.0, -1.2, 4.0)
AMBIENT, DIFFUSE = 0.56, 0.46
"""Ambient share of a colour, and diffuse share at perpendicular incidence."""

_SPECULAR = 0.03


@dataclass(frozen=True, slots=True, kw_only=True)
class Window:
    """Rectangle of a picture in pixels; its end row and column are exclusive.

    Attributes:
        top: First row.
        bottom: Row after the last.
        left: First column.
        right: Column after the last.
    """

    top: int
    bottom: int
    left: int
    right: int

    def scaled(self, factor: int) -> Window:
        """The same window at a multiple of the resolution."""
        return Window(
            top=self.top * factor, bottom=self.bottom * factor, left=self.left * factor, right=self.right * factor
        )

    @property
    def slices(self) -> tuple[slice, slice]:
        """Slices of the window in an array of rows and columns."""
        return slice(self.top, self.bottom), slice(self.left, self.right)


@dataclass(frozen=True, slots=True, kw_only=True)
class Lens:
    """A perspective projection.

    Attributes:
        eye_m: Position of the camera.
        target_m: Point at the centre of the picture.
        field_of_view_rad: Angle between the picture's upper and lower edge.
        width: Width of the picture in pixels.
        height: Height of the picture in pixels.
        near_m: Distance of the near plane.
        far_m: Distance of the far plane.
        up: Upward direction of the picture.
    """

    eye_m: Vector
    target_m: Vector
    field_of_view_rad: float
    width: int
    height: int
    near_m: float
    far_m: float
    up: Vector = (0.0, 0.0, 1.0)

    def enlarged(self, factor: int) -> Lens:
        """The same view at a multiple of the resolution."""
        return replace(self, width=self.width * factor, height=self.height * factor)

    def matrices(self, window: Window | None = None) -> tuple[Any, Any]:
        """View and projection matrix in column-major order, as the engine expects them.

        Args:
            window: The part of the picture to project; the whole by default.
        """
        engine = pybullet()
        part = window or Window(top=0, bottom=self.height, left=0, right=self.width)
        upper = self.near_m * math.tan(self.field_of_view_rad / 2)
        pixel = 2 * upper / self.height
        return (
            engine.computeViewMatrix(self.eye_m, self.target_m, self.up),
            engine.computeProjectionMatrix(
                (part.left - self.width / 2) * pixel,
                (part.right - self.width / 2) * pixel,
                (self.height / 2 - part.bottom) * pixel,
                (self.height / 2 - part.top) * pixel,
                self.near_m,
                self.far_m,
            ),
        )

    def project(self, points_m: Array) -> tuple[Array, Array, Array]:
        """Project points (..., 3) of the world to columns, rows and depths, each of shape (...).

        Depths go from 0 at the near plane to 1 at the far plane; those of points behind the camera are NaN, as are
        their columns and rows.
        """
        x, y, z, w = (points_m @ row[:3] + row[3] for row in self._matrix().astype(np.float32))
        w = np.where(w > 0.0, w, np.float32(np.nan))
        return (x / w + 1) * (self.width / 2), (1 - y / w) * (self.height / 2), (z / w + 1) / 2

    def unproject(self, depths: Array) -> Array:
        """Points (height, width, 3) of the world from the depths of the pixels."""
        inverse = np.linalg.inv(self._matrix()).astype(np.float32)
        x = (2 * np.arange(self.width, dtype=np.float32) + 1) / self.width - 1
        y = 1 - (2 * np.arange(self.height, dtype=np.float32) + 1) / self.height
        z = 2 * depths - 1
        *rows, weight = (
            (row[0] * x)[np.newaxis, :] + (row[1] * y)[:, np.newaxis] + row[2] * z + row[3] for row in inverse
        )
        points: Array = np.stack(rows, axis=-1) / weight[:, :, np.newaxis]
        return points

    def _matrix(self) -> NDArray[np.float64]:
        view, projection = (np.array(matrix).reshape(4, 4).T for matrix in self.matrices())
        product: NDArray[np.float64] = projection @ view
        return product


def draw(client: int, lens: Lens, window: Window | None = None) -> tuple[Picture, Array]:
    """Render all bodies of a client, lit but without shadows, on white.

    Args:
        client: The physics client.
        lens: The projection.
        window: The part of the picture to render; the whole by default.

    Returns:
        The colours, and the depths (height, width) from 0 at the near plane to 1 where there is nothing.
    """
    engine = pybullet()
    part = window or Window(top=0, bottom=lens.height, left=0, right=lens.width)
    width, height, colours, depths, _ = engine.getCameraImage(
        part.right - part.left,
        part.bottom - part.top,
        *lens.matrices(part),
        lightDirection=TOWARDS_LIGHT,
        lightAmbientCoeff=AMBIENT,
        lightDiffuseCoeff=DIFFUSE,
        lightSpecularCoeff=_SPECULAR,
        shadow=0,
        renderer=engine.ER_TINY_RENDERER,
        flags=engine.ER_NO_SEGMENTATION_MASK,
        physicsClientId=client,
    )
    picture = np.asarray(colours, dtype=np.uint8).reshape(height, width, 4)[:, :, :3]
    return picture, np.asarray(depths, dtype=np.float32).reshape(height, width)
