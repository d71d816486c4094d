"""Binary buffer of a glTF file, filled accessor by accessor."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

_ALIGNMENT = 4
_KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}


class GltfBuffer:
    """Buffer of a file; added numbers get an accessor in the file."""

    def __init__(self, document: Any) -> None:
        """Create an empty buffer.

        Args:
            document: The file, a `pygltflib.GLTF2`.
        """
        self._document = document
        self._blob = bytearray()

    @property
    def content(self) -> bytes:
        """The bytes added so far."""
        return bytes(self._blob)

    def add_floats(self, values: NDArray[np.float64], *, is_vertex: bool = False) -> int:
        """Add numbers with their least and greatest values, which glTF requires for times and positions.

        Args:
            values: The numbers, shape (n, components) or (n,).
            is_vertex: True if they belong to vertices.

        Returns:
            The accessor's index.
        """
        import pygltflib

        rows = np.asarray(values, dtype="<f4")
        columns = rows if rows.ndim > 1 else rows[:, np.newaxis]
        return self._add(
            rows.tobytes(),
            component=pygltflib.FLOAT,
            count=len(rows),
            kind=_KINDS[columns.shape[1]],
            target=pygltflib.ARRAY_BUFFER if is_vertex else None,
            least=columns.min(axis=0).tolist(),
            greatest=columns.max(axis=0).tolist(),
        )

    def add_indices(self, indices: tuple[int, ...]) -> int:
        """Add the indices of the vertices of triangles.

        Args:
            indices: Three of them for each triangle.

        Returns:
            The accessor's index.
        """
        import pygltflib

        is_short = max(indices) < 2**16 - 1
        return self._add(
            np.asarray(indices, dtype="<u2" if is_short else "<u4").tobytes(),
            component=pygltflib.UNSIGNED_SHORT if is_short else pygltflib.UNSIGNED_INT,
            count=len(indices),
            kind="SCALAR",
            target=pygltflib.ELEMENT_ARRAY_BUFFER,
            least=[min(indices)],
            greatest=[max(indices)],
        )

    def _add(
        self,
        content: bytes,
        *,
        component: int,
        count: int,
        kind: str,
        target: int | None,
        least: list[float],
        greatest: list[float],
    ) -> int:
        import pygltflib

        self._blob.extend(bytes(-len(self._blob) % _ALIGNMENT))
        view = pygltflib.BufferView(buffer=0, byteOffset=len(self._blob), byteLength=len(content), target=target)
        self._blob.extend(content)
        self._document.bufferViews.append(view)
        self._document.accessors.append(
            pygltflib.Accessor(
                bufferView=len(self._document.bufferViews) - 1,
                componentType=component,
                count=count,
                type=kind,
                min=least,
                max=greatest,
            )
        )
        return len(self._document.accessors) - 1
