"""Default task of studies: the packaged eight states."""

from __future__ import annotations

from functools import lru_cache
from importlib import resources

from rgss.tasks.program import TaskProgram
from rgss.tasks.reading import load_task


@lru_cache(maxsize=1)
def default_task() -> TaskProgram:
    """Default task of studies."""
    with resources.as_file(resources.files("rgss.tasks") / "pick_and_place.yaml") as path:
        return load_task(path, label="pick_and_place.yaml").program
