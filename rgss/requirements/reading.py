"""Reader of the requirements folder: each part is one file, or a folder of files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from rgss.documents import DocumentModel, LoadedDocument, load_document
from rgss.errors import DocumentError
from rgss.findings import Finding, Severity

_Model = TypeVar("_Model", bound=DocumentModel)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedPart(Generic[_Model]):
    """One part of the requirements, as far as readable.

    Attributes:
        documents: The readable files, in the order of their names.
        complete: True if every file of the part is readable.
    """

    documents: tuple[LoadedDocument[_Model], ...]
    complete: bool


class FolderReader:
    """Reader of the files of one folder, which collects findings."""

    def __init__(self, folder: Path, label_root: str, findings: list[Finding]) -> None:
        """Reader of a folder.

        Args:
            folder: The folder.
            label_root: Its name in messages.
            findings: List to which findings are added.
        """
        self._folder = folder
        self._label_root = label_root
        self._findings = findings

    def part(self, name: str, model: type[_Model]) -> LoadedPart[_Model]:
        """Read a part: the file ``name.yaml``, or every ``.yaml`` file below the folder ``name``."""
        inner, file = self._folder / name, f"{name}.yaml"
        if not inner.is_dir():
            found = self._load(file, model)
            return LoadedPart(documents=() if found is None else (found,), complete=found is not None)
        if (self._folder / file).exists():
            message = f"{name!r} is both a file and a folder"
            self._report(file, "both", message, f"move {file} into the folder, under another name")
            return LoadedPart(documents=(), complete=False)
        names = sorted(path.relative_to(self._folder).as_posix() for path in inner.rglob("*") if _is_ours(path))
        if not names:
            self._report(name, "missing", "the folder has no .yaml file", "add one")
        for each in names:
            if not each.endswith(".yaml"):
                # If the file were skipped silently, its requirements would be lost.
                self._report(each, "name", "the name of a requirements file must end in .yaml", "rename it")
        loaded = [self._load(each, model) for each in names if each.endswith(".yaml")]
        documents = tuple(document for document in loaded if document is not None)
        return LoadedPart(documents=documents, complete=bool(names) and len(documents) == len(names))

    def optional(self, name: str, model: type[_Model]) -> LoadedDocument[_Model] | None:
        """Read an optional file; None if it is missing or invalid."""
        return self._load(name, model) if (self._folder / name).exists() else None

    def _load(self, name: str, model: type[_Model]) -> LoadedDocument[_Model] | None:
        try:
            return load_document(self._folder / name, model, label=f"{self._label_root}/{name}")
        except DocumentError as error:
            self._findings.extend(error.findings)
            return None

    def _report(self, name: str, rule: str, message: str, hint: str) -> None:
        self._findings.append(
            Finding(
                file=f"{self._label_root}/{name}",
                line=1,
                column=1,
                rule=f"document.{rule}",
                severity=Severity.ERROR,
                message=message,
                hint=hint,
            )
        )


def _is_ours(path: Path) -> bool:
    name = path.name.lower()
    return name.endswith((".yaml", ".yml", ".yaml.txt", ".yml.txt")) and not name.startswith(".")
