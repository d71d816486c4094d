"""Schema header of a YAML file: the first line, from which an editor finds the schema."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from rgss.documents import is_disk_failure, read_document, replaced_file, unwritable
from rgss.errors import DefinitionError, DocumentError, RgssError
from rgss.findings import Finding
from rgss.studies.project_folders import FOLDERS
from rgss.studies.schemas.document_kinds import DOCUMENT_KINDS, DocumentKind, kind_of

SCHEMAS = "schemas"
"""The folder of a project that has its schemas."""

_HEADER = re.compile(r"# yaml-language-server: \$schema=[^\r\n]*(\r?\n|$)")
_BYTE_ORDER_MARK = "\ufeff"


def with_header(text: str, schema: str) -> str:
    """The text of a YAML file with the line that names its schema; one that is there is replaced.

    Args:
        text: The file's text.
        schema: The schema's file, relative to the YAML file.
    """
    mark = _BYTE_ORDER_MARK if text.startswith(_BYTE_ORDER_MARK) else ""
    rest = text.removeprefix(_BYTE_ORDER_MARK)
    end = "\r\n" if rest.partition("\n")[0].endswith("\r") else "\n"
    old = _HEADER.match(rest)
    return f"{mark}# yaml-language-server: $schema={schema}{end}{rest[old.end() :] if old else rest}"


def schema_reference(name: str, kind: DocumentKind) -> str:
    """The path from a project's file to its schema, as the header has it.

    Args:
        name: The file relative to the project, such as ``scenes/kitchen.yaml``.
        kind: What it is.
    """
    return "../" * name.count("/") + f"{SCHEMAS}/{kind.schema_file}"


def write_schemas(folder: Path, kinds: tuple[DocumentKind, ...] = DOCUMENT_KINDS) -> tuple[Path, ...]:
    """Write schemas into a folder, which is made if it is not there; older ones are replaced.

    Raises:
        DefinitionError: The folder cannot be written to.
    """
    files = tuple(folder / kind.schema_file for kind in kinds)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for path, kind in zip(files, kinds, strict=True):
            with replaced_file(path) as part:
                part.write_text(kind.schema_text(), encoding="utf-8", newline="\n")
    except (OSError, ValueError) as error:
        raise cannot_write(folder, error) from error
    return files


def write_headers(project: Path, schemas: Path) -> tuple[Path, ...]:
    """Put the line that names its schema at the head of every YAML document of a project.

    Args:
        project: The project's folder.
        schemas: The folder that has the schemas.

    Returns:
        The files that were changed; a file that has the line already is not changed.

    Raises:
        DocumentError: A file cannot be read as YAML; then none is changed.
        DefinitionError: A file cannot be written.
    """
    changed = []
    for path, kind in [*_documents(project)]:
        text = path.read_bytes().decode("utf-8")
        reference = Path(os.path.relpath(schemas / kind.schema_file, path.parent)).as_posix()
        headed = with_header(text, reference)
        if headed != text:
            try:
                with replaced_file(path, replace_source=True) as part:
                    part.write_bytes(headed.encode("utf-8"))
            except OSError as error:
                raise cannot_write(path, error) from error
            changed.append(path)
    return tuple(changed)


def cannot_write(path: Path, error: OSError | ValueError) -> RgssError:
    """Error for a file or folder that cannot be written."""
    if isinstance(error, OSError) and is_disk_failure(error):
        return unwritable(path, error)
    reason = getattr(error, "strerror", None) or str(error)
    return DefinitionError(f"cannot write {str(path)!r}: {reason}", hint="choose another place")


def _documents(project: Path) -> Iterator[tuple[Path, DocumentKind]]:
    """Every YAML document of a project with its kind."""
    findings: list[Finding] = []
    found: list[tuple[Path, DocumentKind]] = []
    for path in sorted(path for name in FOLDERS for path in (project / name).rglob("*.yaml")):
        name = path.relative_to(project).as_posix()
        try:
            kind = kind_of(name, read_document(path, label=name).data)
        except DocumentError as error:
            findings += error.findings
            continue
        if kind is not None:
            found.append((path, kind))
    if findings:
        raise DocumentError(findings)
    yield from found
