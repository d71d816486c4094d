"""Interface of a kind of gripper: its document, what is wrong with one, and the gripper that it describes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Protocol

from rgss.documents import Document, DocumentModel
from rgss.findings import Finding
from rgss.scenes.gripper import GripperFile


class GripperKind(Protocol):
    """A kind of gripper, named by ``kind:`` in a gripper file."""

    @property
    def name(self) -> str:
        """Its name in files."""

    @property
    def model(self) -> type[DocumentModel]:
        """Model of its files."""

    def findings(self, entry: Any, document: Document) -> Iterable[Finding]:
        """Problems of a file that the model accepts.

        Args:
            entry: The content of the file, of this kind's model.
            document: The file, for positions.
        """

    def gripper_file(self, entry: Any) -> GripperFile:
        """The gripper that a file without problems describes.

        Args:
            entry: The content of the file, of this kind's model.
        """
