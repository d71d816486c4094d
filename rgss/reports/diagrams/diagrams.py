"""Every diagram of a model, for a page or as files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rgss.documents import replaced_file
from rgss.measures import MeasureSet
from rgss.reports.diagrams.behaviour import activity_diagram, state_diagram, use_case_diagram
from rgss.reports.diagrams.drawing import Drawing
from rgss.reports.diagrams.internal_blocks import internal_block_diagrams
from rgss.reports.diagrams.parametric import parametric_diagrams
from rgss.reports.diagrams.requirements import MOST_IN_GROUP, requirement_diagrams, too_large
from rgss.reports.diagrams.sequence import sequence_diagram
from rgss.reports.diagrams.trees import block_definition_diagrams, containment_map
from rgss.requirements import RequirementSet
from rgss.trace.evidence import success_criterion

MOST_ELEMENTS = 600
"""Most elements of a model that is drawn as a whole; of a larger one only the containment map is drawn."""

_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_.-]")


def diagrams_of(requirements: RequirementSet, measures: MeasureSet | None = None) -> tuple[Drawing, ...]:
    """Draw the containment map, and for a model of moderate size every other kind of diagram.

    These are requirement diagrams, block definition, internal block and parametric
    diagrams, a use-case diagram, activities,
    sequences and state machines.

    Args:
        requirements: The requirements and the architecture.
        measures: The measures, for parametric diagrams; None for none of these.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    return tuple(_all(requirements, measures))


def missing_diagrams(requirements: RequirementSet) -> str:
    """Sentence on the diagrams that are too large to be drawn; empty if everything is drawn."""
    if len(requirements.elements) > MOST_ELEMENTS:
        return (
            f"The model has {len(requirements.elements)} elements. Of more than {MOST_ELEMENTS}, "
            "the containment map alone is drawn."
        )
    groups = too_large(requirements)
    if groups:
        return f"These groups have more than {MOST_IN_GROUP} requirements and no diagram: {', '.join(groups)}."
    return ""


def drawings_for_page(drawings: Sequence[Drawing]) -> list[dict[str, Any]]:
    """Diagrams in the form of the page's template."""
    from markupsafe import Markup

    return [
        {
            "anchor": f"d-{file_stem(drawing)}",
            "title": drawing.title,
            "description": drawing.description,
            "svg": Markup(drawing.to_svg(with_style=False)),  # noqa: S704 - everything in it is escaped
        }
        for drawing in drawings
    ]


def write_diagrams(drawings: Sequence[Drawing], folder: Path) -> tuple[Path, ...]:
    """Write each diagram as an SVG file, atomically.

    Args:
        drawings: The diagrams.
        folder: The folder of the files, which is created if it does not exist.

    Returns:
        The files.

    Raises:
        OSError: The folder cannot be written to.
    """
    texts = {folder / f"{file_stem(drawing)}.svg": drawing.to_svg() for drawing in drawings}
    folder.mkdir(parents=True, exist_ok=True)
    for path, text in texts.items():
        with replaced_file(path) as part:
            part.write_text(text, encoding="utf-8")
    return tuple(texts)


def file_stem(drawing: Drawing) -> str:
    """Name of a diagram's file without its suffix."""
    return _NOT_IN_NAMES.sub("_", drawing.name)


def _all(requirements: RequirementSet, measures: MeasureSet | None) -> Iterator[Drawing]:
    yield containment_map(requirements)
    if len(requirements.elements) > MOST_ELEMENTS:
        return
    architecture = requirements.architecture
    yield from requirement_diagrams(requirements)
    yield from block_definition_diagrams(architecture.blocks)
    yield from internal_block_diagrams(architecture.blocks)
    if measures is not None:
        yield from parametric_diagrams(measures, architecture.blocks)
    use_cases = use_case_diagram(architecture.behaviours, architecture.blocks)
    if use_cases is not None:
        yield use_cases
    names = {block.id: block.name for block in architecture.blocks}
    bounds = {requirement.id: success_criterion(requirement) for requirement in requirements.system}
    behaviours = architecture.behaviours
    drawn = [
        *map(state_diagram, behaviours),
        *(activity_diagram(behaviour, names) for behaviour in behaviours),
        *(sequence_diagram(behaviour, names, bounds) for behaviour in behaviours),
    ]
    yield from (drawing for drawing in drawn if drawing is not None)
