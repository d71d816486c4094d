"""Loader of measures files."""

from __future__ import annotations

from pathlib import Path

from rgss.documents import load_document
from rgss.errors import DocumentError
from rgss.measures.building import build_measures
from rgss.measures.definitions import MeasureSet
from rgss.measures.document import MeasuresDocument


def load_measures(path: Path, *, label: str | None = None) -> MeasureSet:
    """Read a measures file.

    Args:
        path: The file, such as ``requirements/measures.yaml``.
        label: Its name in messages; the path itself by default.

    Raises:
        DocumentError: The file is not a consistent set of measures; with every problem in it.
    """
    loaded = load_document(path, MeasuresDocument, label=label)
    built = build_measures(loaded, path.read_text(encoding="utf-8-sig").splitlines())
    if isinstance(built, MeasureSet):
        return built
    raise DocumentError(sorted(built))
