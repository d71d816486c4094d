"""Interface of a kind of gripper: document model, findings, and the gripper of a document."""

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

    @property
    def document(self) -> str:
        """Name of its files as a kind of document, such as ``vacuum-gripper``."""

    @property
    def title(self) -> str:
        """Title of its files, in a few words."""

    @property
    def own_key(self) -> str:
        """Required key that only its files have, by which the schema of a file is chosen."""

    def findings(self, entry: Any, document: Document) -> Iterable[Finding]:
        """Findings about a file that satisfies the model.

        Args:
            entry: The content of the file, of this kind's model.
            document: The file, for positions.
        """

    def gripper_file(self, entry: Any) -> GripperFile:
        """Gripper described by a valid file.

        Args:
            entry: The content of the file, of this kind's model.
        """
