"""Lazy import of PyBullet and management of its clients; no other module imports it."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from types import TracebackType
from typing import Any, BinaryIO, TypeVar

from rgss.errors import SimulationError
from rgss.physics.hulls import mesh_text
from rgss.scenes import with_mesh_files

_Owner = TypeVar("_Owner", bound="ClientOwner")

_STANDARD_OUTPUT, _STANDARD_ERROR = 1, 2
_BETWEEN_TAGS = re.compile(r">\s*<")
_MESSAGE = re.compile(r"b3(Error|Warning)\[[^\]]*\]:\s*")


@lru_cache(maxsize=1)
def pybullet() -> Any:
    """The engine's module, imported on first use so that start-up stays light."""
    with _engine_output():  # it prints its build time on import
        import pybullet as module

    return module


def open_client() -> int:
    """Open a headless physics client and return its id.

    Raises:
        SimulationError: The engine refused.
    """
    module = pybullet()
    client = int(module.connect(module.DIRECT))
    if client < 0:
        raise SimulationError("the physics engine opened no client", hint="close other worlds first")
    return client


class ClientOwner:
    """Owner of a physics client; a context manager that always closes it."""

    def __init__(self) -> None:
        """Open a client.

        Raises:
            SimulationError: The engine refused.
        """
        self._engine = pybullet()
        self._client = open_client()

    def __enter__(self: _Owner) -> _Owner:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the physics client; closing twice is allowed."""
        if self._client >= 0:
            self._engine.disconnect(physicsClientId=self._client)
            self._client = -1


def load_urdf_text(
    client: int, text: str, *, position: Any, orientation: Any, flags: int, is_fixed: bool = True
) -> int:
    """Load a URDF from its text, with a fixed base by default; the engine itself reads only files.

    Raises:
        SimulationError: The engine could not read the description.
    """
    module = pybullet()
    with tempfile.TemporaryDirectory() as folder:

        def write_mesh(number: int, corners: Sequence[tuple[float, float, float]]) -> str:
            path = Path(folder) / f"{number}.obj"
            path.write_text(mesh_text(corners), encoding="ascii")
            return str(path)

        name = str(Path(folder) / "robot.urdf")
        Path(name).write_text(_tags_on_lines(with_mesh_files(text, write_mesh)), encoding="utf-8")
        with _engine_output() as output:
            try:
                body = module.loadURDF(
                    name, position, orientation, useFixedBase=is_fixed, flags=flags, physicsClientId=client
                )
            except module.error as error:
                reasons = _reported_errors(output) or str(error)
                raise SimulationError(
                    f"the physics engine cannot load the robot: {reasons}", hint="check its URDF"
                ) from error
    return int(body)


def _tags_on_lines(urdf: str) -> str:
    """URDF with each tag on a line of its own: the engine breaks lines after 8191 bytes, also within a number."""
    return _BETWEEN_TAGS.sub(">\n<", urdf)


@contextmanager
def _engine_output() -> Iterator[BinaryIO]:
    """Redirect the output of the engine's C code from standard output and error to a file.

    It bypasses Python's streams, so the file descriptors are redirected; otherwise it would mix with a result on
    standard output.
    """
    with tempfile.TemporaryFile() as caught:
        saved = {}
        try:
            for descriptor in (_STANDARD_OUTPUT, _STANDARD_ERROR):
                try:
                    saved[descriptor] = os.dup(descriptor)
                except OSError:  # closed, as it may be in a background process
                    continue
                os.dup2(caught.fileno(), descriptor)
            yield caught
        finally:
            for descriptor, copy in saved.items():
                os.dup2(copy, descriptor)
                os.close(copy)


def _reported_errors(output: BinaryIO) -> str:
    """Error messages of the engine on one line, from the cause to its consequences."""
    output.seek(0)
    parts = _MESSAGE.split(output.read().decode("utf-8", errors="replace"))
    errors = [text for kind, text in zip(parts[1::2], parts[2::2], strict=True) if kind == "Error"]
    return ": ".join(" ".join(text.split()).rstrip(":") for text in errors)
