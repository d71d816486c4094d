"""A new project: small, sound, and commented for its reader."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from importlib import resources
from pathlib import Path

from rgss.currencies import DOLLAR
from rgss.documents import read_document
from rgss.errors import DefinitionError
from rgss.studies.schemas import (
    DOCUMENT_KINDS,
    SCHEMAS,
    DocumentKind,
    cannot_write,
    kind_of,
    schema_reference,
    with_header,
)


def scaffold_texts() -> Mapping[str, str]:
    """The files of a new project: name relative to its folder, and text."""
    texts = {name.replace("gitignore", ".gitignore"): text for name, text in _packaged()}
    return {**texts, **schema_texts(DOCUMENT_KINDS)}


def in_currency(texts: Mapping[str, str], currency: str) -> Mapping[str, str]:
    """The files of a new project with its amounts of money in a currency."""
    return {name: text if name.startswith(SCHEMAS) else text.replace(DOLLAR, currency) for name, text in texts.items()}


def schema_texts(kinds: Iterable[DocumentKind]) -> Mapping[str, str]:
    """The schemas of kinds of documents in a project: name relative to its folder, and text."""
    return {f"{SCHEMAS}/{kind.schema_file}": kind.schema_text() for kind in kinds}


def write_scaffold(folder: Path, kinds: Sequence[DocumentKind] = (), *, currency: str = DOLLAR) -> tuple[str, ...]:
    """Write a new project into a folder, which is made if it is not there.

    Args:
        folder: The folder; what is in it already stays as it is.
        kinds: Further kinds of documents whose schemas it gets.
        currency: Code of the currency of its amounts, which are the same in each.

    Returns:
        The names of the files that were written, relative to the folder.

    Raises:
        DefinitionError: A file of that name is there already, or the folder cannot be written to; then nothing is
            written.
        StorageError: The disk is full or fails; then nothing is written.
    """
    texts = {**in_currency(scaffold_texts(), currency), **schema_texts(kinds)}
    write_new_files(folder, {name: text.encode("utf-8") for name, text in texts.items()})
    return tuple(texts)


def write_new_files(folder: Path, contents: Mapping[str, bytes]) -> None:
    """Write new files into a folder: all of them, or none.

    Args:
        folder: The folder, which is made if it is not there.
        contents: The content of each file by its name relative to the folder.

    Raises:
        DefinitionError: A file of that name is there already, or the folder cannot be written to.
        StorageError: The disk is full or fails.
    """
    made: list[Path] = []
    try:
        there = [name for name in contents if (folder / name).exists() or (folder / name).is_symlink()]
        if there:
            also = f" and {len(there) - 1} more are" if len(there) > 1 else " is"
            raise DefinitionError(
                f"{folder / there[0]}{also} there already, and nothing is overwritten", hint="name a new folder"
            )
        try:
            for name, content in contents.items():
                path = folder / name
                for parent in reversed([one for one in path.parents if not one.exists()]):
                    parent.mkdir(exist_ok=True)
                    made.append(parent)
                with path.open("xb") as file:
                    made.append(path)
                    file.write(content)
        except BaseException:
            _remove(made)
            raise
    except (OSError, ValueError) as error:  # ValueError: a name with a null character in it
        raise cannot_write(folder, error) from error


def _remove(made: Sequence[Path]) -> None:
    """Remove files and folders that were made, the last first; a folder with other files stays."""
    for path in reversed(made):
        with suppress(OSError):
            if path.is_dir():
                path.rmdir()
            else:
                path.unlink()


def _packaged() -> Iterator[tuple[str, str]]:
    """The packaged files, each YAML document with the line that names its schema."""
    with resources.as_file(resources.files("rgss.studies") / "scaffold") as root:
        for path in sorted(path for path in root.rglob("*") if path.is_file()):
            name = path.relative_to(root).as_posix()
            text = path.read_text(encoding="utf-8")
            kind = kind_of(name, read_document(path, label=name).data) if name.endswith(".yaml") else None
            yield name, text if kind is None else with_header(text, schema_reference(name, kind))
