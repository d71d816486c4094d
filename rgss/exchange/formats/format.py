"""A format of another tool."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.studies import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportFormat:
    """A format of another tool.

    Attributes:
        name: Its name on the command line.
        write: Function that writes a project to a file, atomically; the third argument is the name
            of the evidence in messages. Returns the number of written elements of each kind.
            Raises `DefinitionError` for a missing package, `EvidenceError` for missing evidence.
    """

    name: str
    write: Callable[[Project, Path, str], Mapping[str, int]]
